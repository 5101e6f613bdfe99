// What a mentor who looks in on an attempt lets happen to the patient: asked by one program, taken up by the one
// that makes the attempt.
#pragma once

#include <optional>
#include <string>

#include "casedb/database/library.h"
#include "sim/base/result.h"
#include "sim/case/event.h"

namespace seldinger::casedb {

// By whoever acts. Refused: `bad_event` (no mentor's), `no_attempt` (it is not being made).
base::Result<void> ask_event(Library& library, const std::string& attempt_id, cases::EventKind kind);
// The oldest that is not taken yet, which it then is; nothing: there is none.
std::optional<cases::EventKind> take_asked_event(Library& library, const std::string& attempt_id);

}  // namespace seldinger::casedb
