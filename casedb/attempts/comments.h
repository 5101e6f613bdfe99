// What mentors say of an attempt, each at a moment of it: read where the attempt is, by whom it belongs to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct AttemptComment {
  std::string comment_id;
  double at_s = 0.0;  // since the attempt began
  std::string body;
  std::optional<std::string> person_id;  // who wrote it; none: the operator
  std::int64_t written_us = 0;
};

inline constexpr std::size_t kMostAttemptComment = 1'000;

// By whom the library acts for. `no_attempt`, `bad_text` (1 to 1,000 bytes of text), `bad_moment` (before the
// attempt began or after it ended).
base::Result<void> add_comment(Library& library, const std::string& attempt_id, double at_s,
                               const std::string& body);
std::vector<AttemptComment> list_comments(Library& library, const std::string& attempt_id);  // by their moments

}  // namespace seldinger::casedb
