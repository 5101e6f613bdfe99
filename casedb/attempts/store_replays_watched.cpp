#include "casedb/attempts/attempts.h"
#include "casedb/database/question.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {

base::Result<void> note_replay_watched(Library& library, const std::string& person_id,
                                       const std::string& attempt_id) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  Statement attempt = question(database, "recording_size");
  if (!attempt.bind("attempt_id", attempt_id).step())
    return base::Error{"no_attempt", "there is no such attempt in the library"};
  attempt.rewind();
  Statement person = question(database, "person_exists");
  CHECK(person.bind("person_id", person_id).step());
  if (person.integer("found") == 0) return base::Error{"no_person", "there is no such person in the library"};
  person.rewind();
  question(database, "add_replay_watched")
      .bind("person_id", person_id)
      .bind("attempt_id", attempt_id)
      .bind("watched_us", now_us())
      .run();
  transaction.commit();
  return {};
}

ReplaysWatched count_replays_watched(Library& library, const std::string& person_id, const std::string& case_id) {
  Statement counted = question(library.database(), "replays_watched");
  counted.bind("person_id", person_id)
      .bind("case_id", case_id)
      .bind("person_operator", std::string(kPersonOperator));
  CHECK(counted.step());
  return {counted.small_integer("others"), counted.small_integer("own")};
}

}  // namespace seldinger::casedb
