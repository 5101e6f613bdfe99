#include "casedb/attempts/attempts.h"
#include "casedb/database/question.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"
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
  if (const auto known = check_person(library, person_id); !known) return known.error();
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
