// A case that came in a bundle, and what its sender says of it: kept as the sender's, beside what is known here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "casedb/cases/case_state.h"
#include "casedb/cases/privacy.h"
#include "casedb/database/library.h"

namespace seldinger::casedb {

struct Received {
  std::int64_t received_us = 0;                        // since 1970 UTC
  CaseState state = CaseState::draft;                  // what it was there
  FaceState face_state = FaceState::unchecked;         // what was done there
  std::optional<std::int64_t> burned_in_checked_us;    // when somebody there looked for text
  std::optional<std::string> signing_key, trusted_as;  // the key, and its label while it is trusted here
};

// Nothing for a case that was made here.
std::optional<Received> find_received(Library& library, const std::string& case_id);

// The state in which a case arrives: what was published there is to be reviewed here.
CaseState arriving(CaseState there) noexcept;

}  // namespace seldinger::casedb
