#include "casedb/studies/lock.h"

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/studies/study_data.h"
#include "sim/base/check.h"

namespace seldinger::casedb {

std::optional<StudyLock> find_lock(Library& library, const std::string& study_id) {
  Statement row = question(library.database(), "study_lock");
  if (!row.bind("study_id", study_id).step()) return std::nullopt;
  StudyLock lock{
      row.integer("locked_us"), row.text("actor"), {}, row.text("data_hash"), row.small_integer("people")};
  if (!row.is_null("person_id")) lock.pseudonym = row.text("pseudonym");
  return lock;
}

base::Result<StudyLock> lock_data(Library& library, const StoredPlan& stored) {
  Transaction transaction(library.database());
  if (!stored.frozen())
    return base::Error{"plan_not_frozen", "data are locked when the plan is frozen (`seldinger study freeze`)"};
  if (find_lock(library, stored.study_id)) return base::Error{"data_locked", "the study's data are locked already"};
  const auto result = assessment::study::analyse(stored.plan, study_data(library, stored).people);
  question(library.database(), "add_study_lock")
      .bind("study_id", stored.study_id)
      .bind("now_us", now_us())
      .bind("actor", name_of(library.actor().kind))
      .bind("person_id", library.actor().person_id)
      .bind("data_hash", data_hash(result))
      .bind("people", static_cast<std::int64_t>(people_with_outcome(result)))
      .run();
  audit(library, Act::lock_study_data, {"study", stored.study_id});
  transaction.commit();
  auto lock = find_lock(library, stored.study_id);
  CHECK(lock.has_value());
  return std::move(*lock);
}

}  // namespace seldinger::casedb
