#include "casedb/grading/learner_records.h"

#include <algorithm>
#include <optional>

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/grading/grading.h"
#include "casedb/people/relations.h"
#include "casedb/people/simulated_people.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

assessment::GradedAttempt graded_attempt(const AttemptRow& attempt, const assessment::Grade& grade) {
  assessment::GradedAttempt made{attempt.attempt_id, attempt.started_us, attempt.duration_s, grade.verdict, {}};
  if (grade.verdict == assessment::Verdict::failed)
    for (const assessment::CriterionResult& one : grade.criteria)
      if (one.outcome != assessment::Outcome::met) made.missed.push_back(one.criterion.metric);
  return made;
}

// What a person did, for all curricula.
struct Past {
  Past(Library& library, const std::optional<std::string>& person) : person_id(person), grader(library) {
    if (!person_id) return;
    attempts = list_attempts_of(library, *person_id);
    std::reverse(attempts.begin(), attempts.end());
    if (!is_simulated(library, *person_id))
      std::erase_if(attempts, [](const AttemptRow& attempt) { return !by_a_person(attempt); });
  }
  std::optional<std::string> person_id;
  std::vector<AttemptRow> attempts;  // that count, oldest first
  Grader grader;
};

std::vector<ItemState> states(Library& library, const Curriculum& curriculum, Past& person) {
  const std::optional<std::string>& person_id = person.person_id;
  std::vector<ItemState> all;
  std::vector<assessment::ItemPast> pasts;
  for (const CurriculumItem& item : curriculum.items) {
    ItemState& state = all.emplace_back();
    assessment::ItemPast& past = pasts.emplace_back();
    past.gates = item.gates;
    past.limit = item.attempt_limit;
    past.available = false;
    const std::vector<FamilyVersion> versions = versions_of(library, item.family_id);
    for (const FamilyVersion& version : versions) {
      // Of a version for another cohort this person is not even told the title.
      if (person_id && version.own_cohort_only && !reaches_own_cohort(library, version.case_id, *person_id))
        continue;
      if (state.title.empty()) state.title = version.title;
      if (past.available || version.state != CaseState::published) continue;
      past.available = true;
      state.case_id = version.case_id;
      state.title = version.title;
      state.version = version.version;
      const auto row = find_case(library, version.case_id);
      CHECK(row.has_value());
      if (!past.limit) past.limit = row->attempt_limit;
    }
    if (state.title.empty()) state.title = "Not published for you";
    for (const AttemptRow& attempt : person.attempts) {
      const bool of_item = std::any_of(versions.begin(), versions.end(), [&](const FamilyVersion& version) {
        return version.case_id == attempt.case_id;
      });
      if (!of_item) continue;
      state.graded.push_back(graded_attempt(attempt, person.grader.grade(attempt)));
      past.verdicts.push_back(state.graded.back().verdict);
      ++state.attempts;
      state.passes += past.verdicts.back() == assessment::Verdict::passed ? 1 : 0;
    }
    if (person_id && past.available) {
      Statement begun = question(library.database(), "attempts_begun");
      CHECK(begun.bind("case_id", state.case_id).bind("person_id", *person_id).step());
      past.begun = begun.small_integer("begun");
    }
  }
  const auto progress = assessment::progress_of(pasts);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].progress = progress[i];
  return all;
}

}  // namespace

std::vector<ItemState> states_of(Library& library, const Curriculum& curriculum, const std::string& person_id) {
  Past past(library, person_id);
  return states(library, curriculum, past);
}

std::vector<ItemState> states_of(Library& library, const Curriculum& curriculum) {
  Past past(library, std::nullopt);
  return states(library, curriculum, past);
}

std::vector<CurriculumRecord> records_of(Library& library, const std::string& person_id) {
  std::vector<CurriculumRecord> records;
  Past past(library, person_id);
  for (Curriculum& one : list_curricula(library)) {
    if (one.state != CurriculumState::published) continue;
    auto items = states(library, one, past);
    records.push_back({std::move(one), std::move(items)});
  }
  return records;
}

std::string records_mark(Library& library, const std::string& person_id) {
  Statement mark = question(library.database(), "records_mark");
  CHECK(mark.bind("person_id", person_id).step());
  return std::to_string(mark.integer("everybodys")) + " " + std::to_string(mark.integer("ones")) + " " +
         std::to_string(mark.integer("attempts")) + " " + mark.text("newest") + " " +
         std::to_string(mark.integer("running"));
}

assessment::StandingFound standing_in(const CurriculumRecord& record, std::int64_t now_us) {
  const std::vector<assessment::ItemRecord> items(record.items.begin(), record.items.end());
  return assessment::standing_of(items, now_us);
}

}  // namespace seldinger::casedb
