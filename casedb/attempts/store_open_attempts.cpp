#include "casedb/attempts/attempt_columns.h"
#include "casedb/database/question.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {

base::Result<std::string> open_attempt(Library& library, const AttemptHead& head) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  if (const auto known = check_head(database, head); !known) return known.error();
  std::string attempt_id = new_uuid();
  Statement insert = question(database, "add_open_attempt");
  bind_head(insert, attempt_id, head).run();
  transaction.commit();
  return attempt_id;
}

base::Result<void> add_chunk(Library& library, const std::string& attempt_id, const cases::RecordingChunk& chunk) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement size = question(database, "open_recording_size");
  if (!size.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such open attempt in the library"};
  if (size.integer("chunks") != std::int64_t{chunk.sequence})
    return base::Error{"incomplete", "a piece of the recording is missing"};
  size.rewind();
  Statement insert = question(database, "add_open_chunk");
  bind_chunk(insert, attempt_id, chunk).bind("stored_us", now_us()).run();
  transaction.commit();
  return {};
}

base::Result<void> note_resumption(Library& library, const std::string& attempt_id) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement left = question(database, "open_attempt_left");
  if (!left.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such open attempt in the library"};
  if (left.is_null("stored_us")) return {};
  const double away_s = 1e-6 * static_cast<double>(now_us() - left.integer("stored_us"));
  if (away_s < 0.0) return {};  // somebody has set the clock back
  const double before_s = left.is_null("away_s") ? 0.0 : left.real("away_s");
  left.rewind();
  question(database, "set_open_attempt_away")
      .bind("attempt_id", attempt_id)
      .bind("away_s", before_s + away_s)
      .run();
  transaction.commit();
  return {};
}

base::Result<void> note_conditions(Library& library, const std::string& attempt_id, const Conditions& conditions) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement open = question(database, "open_recording_size");
  if (!open.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such open attempt in the library"};
  open.rewind();
  insert_conditions(database, "set_open_attempt_condition", attempt_id, conditions);
  transaction.commit();
  return {};
}

base::Result<cases::Recording> load_open_recording(Library& library, const std::string& attempt_id) {
  auto chunks = read_chunks(question(library.database(), "open_chunks"), attempt_id);
  if (chunks.empty()) {
    Statement open = question(library.database(), "open_attempt");
    if (!open.bind("attempt_id", attempt_id).step())
      return base::Error{"no_attempt", "there is no such open attempt in the library"};
    return cases::Recording{};
  }
  return cases::recording_from_chunks(chunks);
}

std::vector<OpenAttempt> list_open_attempts(Library& library) {
  std::vector<OpenAttempt> found;
  for (Statement rows = question(library.database(), "open_attempts"); rows.step();) {
    OpenAttempt& one = found.emplace_back();
    static_cast<AttemptHead&>(one) = read_head(rows);
    one.attempt_id = rows.text("attempt_id");
    one.chunks = rows.small_integer("chunks");
  }
  return found;
}

}  // namespace seldinger::casedb
