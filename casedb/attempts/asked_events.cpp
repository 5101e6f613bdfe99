#include "casedb/attempts/asked_events.h"

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

base::Result<void> ask_event(Library& library, const std::string& attempt_id, cases::EventKind kind) {
  const cases::EventInfo* info = cases::find_event(kind);
  if (info == nullptr || info->source != cases::EventSource::mentor)
    return base::Error{"bad_event", "a mentor lets the patient cough, bleed or lose pressure"};
  Transaction transaction(library.database());
  Statement open = question(library.database(), "open_recording_size");
  if (!open.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such open attempt in the library"};
  open.rewind();
  question(library.database(), "ask_event").bind("attempt_id", attempt_id).bind("kind", info->name).run();
  audit(library, Act::cause_event, {"attempt", attempt_id});
  transaction.commit();
  return {};
}

std::optional<cases::EventKind> take_asked_event(Library& library, const std::string& attempt_id) {
  Transaction transaction(library.database());
  Statement take = question(library.database(), "take_asked_event");
  if (!take.bind("attempt_id", attempt_id).step()) return std::nullopt;
  const auto kind = cases::event_from(take.text("kind"));
  take.rewind();
  transaction.commit();
  return kind;
}

}  // namespace seldinger::casedb
