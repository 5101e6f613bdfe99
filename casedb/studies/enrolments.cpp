#include "casedb/studies/enrolments.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "assessment/study/randomisation.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "casedb/people/simulated_people.h"
#include "casedb/studies/lock.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

using assessment::study::PlannedGroup;
using Answers = std::map<std::string, FactGiven>;

// The sequence's seed: the first 64 bits of what was drawn.
std::uint64_t seed_of(const StoredPlan& stored) {
  std::uint64_t seed = 0;
  const auto read = std::from_chars(stored.seed.data(), stored.seed.data() + 16, seed, 16);
  CHECK(stored.seed.size() == 64 && read.ec == std::errc());
  return seed;
}

bool holds(const PlannedGroup& group, const Answers& answers) {
  return std::all_of(group.facts.begin(), group.facts.end(), [&](const auto& criterion) {
    return assessment::study::fits(criterion, answers.at(criterion.fact).answer);
  });
}

base::Result<std::string> group_by_facts(const StoredPlan& stored, const Answers& answers) {
  std::optional<std::string> found;
  for (const PlannedGroup& group : stored.plan.groups) {
    if (!holds(group, answers)) continue;
    if (found) return base::Error{"no_group", "the person's facts fit more than one group of the plan"};
    found = group.name;
  }
  if (!found) return base::Error{"no_group", "the person's facts fit no group of the plan"};
  return *found;
}

std::string stratum_of(const StoredPlan& stored, const Answers& answers) {
  std::string stratum;
  for (const std::string& fact : stored.plan.randomisation.strata)
    stratum += (stratum.empty() ? "" : ",") + fact + "=" + answers.at(fact).answer;
  return stratum;
}

base::Result<void> may_take_part(Library& library, const StoredPlan& stored, const std::string& person_id) {
  if (!stored.frozen())
    return base::Error{"plan_not_frozen", "people are enrolled when the plan is frozen (`seldinger study freeze`)"};
  if (const auto known = check_person(library, person_id); !known) return known.error();
  if (stored.plan.people == assessment::study::People::simulated && !is_simulated(library, person_id))
    return base::Error{"real_person", "the study is of simulated people, and this person is a real one"};
  if (!consenting_people(library, stored.study_id).contains(person_id))
    return base::Error{"no_consent", "this person does not consent to the study"};
  for (const StudyEnrolment& one : list_study_enrolments(library, stored.study_id))
    if (one.person_id == person_id) return base::Error{"already_enrolled", "the person takes part already"};
  if (find_lock(library, stored.study_id))
    return base::Error{"data_locked", "the study's data are locked: nobody is enrolled any more"};
  return {};
}

}  // namespace

std::set<std::string> people_asked(Library& library, const StoredPlan& stored) {
  std::set<std::string> people = consenting_people(library, stored.study_id);
  // Consent to research with the library covers real people in a study of simulated ones, too.
  if (stored.plan.people == assessment::study::People::simulated)
    std::erase_if(people, [&](const std::string& person_id) { return !is_simulated(library, person_id); });
  return people;
}

bool is_of_simulated_people(Library& library, const std::string& study_id) {
  const auto plan = find_plan(library, study_id);
  return plan && plan->plan.people == assessment::study::People::simulated;
}

std::set<std::string> people_asked(Library& library, const std::string& study_id) {
  const auto plan = find_plan(library, study_id);
  return plan ? people_asked(library, *plan) : consenting_people(library, study_id);
}

base::Result<StudyEnrolment> enrol_in_study(Library& library, const std::string& study_id,
                                            const std::string& person_id) {
  Transaction transaction(library.database());
  const auto stored = find_plan(library, study_id);
  if (!stored) return stored.error();
  if (const auto may = may_take_part(library, *stored, person_id); !may) return may.error();
  const Answers answers = newest_facts(list_facts(library, person_id));
  for (const std::string& fact : assessment::study::facts_of(stored->plan))
    if (!answers.contains(fact))
      return base::Error{"fact_missing", "the plan asks for a fact that the person has not stated: " + fact};
  const std::string stratum = stratum_of(*stored, answers);
  std::string group;
  if (!stored->plan.randomised) {
    auto by_facts = group_by_facts(*stored, answers);
    if (!by_facts) return by_facts.error();
    group = std::move(*by_facts);
  }
  std::int64_t position = 0;
  {
    Statement take = question(library.database(), "take_study_place");
    CHECK(take.bind("study_id", study_id).bind("stratum", stratum).step());
    position = take.integer("taken") - 1;
    CHECK(!take.step());
  }
  if (stored->plan.randomised)
    group = stored->plan
                .groups[assessment::study::allocated(stored->plan, seed_of(*stored), stratum,
                                                     static_cast<std::size_t>(position))]
                .name;
  question(library.database(), "add_study_enrolment")
      .bind("study_id", study_id)
      .bind("person_id", person_id)
      .bind("now_us", now_us())
      .bind("group_name", group)
      .bind("stratum", stratum)
      .bind("position", position)
      .run();
  audit(library, Act::enrol_in_study, {"study", study_id});
  transaction.commit();
  auto all = list_study_enrolments(library, study_id);
  const auto made =
      std::find_if(all.begin(), all.end(), [&](const StudyEnrolment& one) { return one.person_id == person_id; });
  CHECK(made != all.end());
  return std::move(*made);
}

std::vector<StudyEnrolment> list_study_enrolments(Library& library, const std::string& study_id) {
  std::vector<StudyEnrolment> all;
  Statement rows = question(library.database(), "study_enrolments");
  for (rows.bind("study_id", study_id); rows.step();)
    all.push_back({rows.text("person_id"), rows.text("pseudonym"), rows.text("group_name"), rows.text("stratum"),
                   rows.integer("position"), rows.integer("enrolled_us"), rows.integer("consents") != 0});
  return all;
}

std::size_t count_ever_enrolled(Library& library, const std::string& study_id) {
  Statement row = question(library.database(), "study_places_taken");
  CHECK(row.bind("study_id", study_id).step());
  return static_cast<std::size_t>(row.integer("taken"));
}

}  // namespace seldinger::casedb
