// The list of attempts, newest first.
#pragma once

#include <span>
#include <string>

#include "reports/pages/page.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {

// Which part of a long list is shown.
struct ListPart {
  std::size_t page = 1;  // from 1
  std::size_t pages = 1;
  std::size_t total = 0;
  bool own_only = false;  // the reader sees only what is theirs
};

std::string attempts_page(const Visitor& visitor, std::span<const AttemptView> attempts, const ListPart& part);
// For a role that sees none of them.
std::string no_attempts_page(const Visitor& visitor);

}  // namespace seldinger::reports
