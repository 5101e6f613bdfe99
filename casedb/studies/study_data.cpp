#include "casedb/studies/study_data.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <span>

#include "assessment/estimand.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/grading/grading.h"
#include "casedb/people/facts.h"
#include "casedb/studies/lock.h"

namespace seldinger::casedb {
namespace {

namespace study = assessment::study;

constexpr double kStudyDayUs = 86'400e6;

std::set<std::string> cases_of(const study::Plan& plan) {
  std::set<std::string> cases;
  for (const auto* outcomes : {&plan.primary, &plan.secondary})
    for (const study::Outcome& one : *outcomes) cases.insert(one.case_id);
  return cases;
}

bool is_of_plan(const study::Plan& plan, const std::set<std::string>& cases, const AttemptRow& row) {
  return cases.contains(row.case_id) && by_a_person(row) == (plan.people == study::People::real);
}

StudyPeople counted(const study::Plan& plan, const std::set<std::string>& people) {
  return {static_cast<int>(people.size()), plan.people == study::People::simulated};
}

std::string cut_off_words(const AttemptRow& row) {
  const std::string_view code = cut_off_of(row);
  if (code == "interrupted") return "interrupted: the program was gone";
  if (code == "device_lost") return "a device was lost";
  return {};
}

// Metrics that the analysis looks at.
std::set<std::string> metrics_of(const study::Plan& plan) {
  std::set<std::string> metrics;
  for (const std::string_view one : assessment::kMetricsThatCount) metrics.emplace(one);
  for (const auto* outcomes : {&plan.primary, &plan.secondary})
    for (const study::Outcome& one : *outcomes) metrics.insert(one.metric);
  for (const study::Exclusion& one : plan.exclusions) metrics.insert(one.metric);
  return metrics;
}

Background background_of(Library& library, const StudyEnrolment& of) {
  Background background;
  background.group = of.group;
  for (const FactGiven& one : list_facts(library, of.person_id))  // the oldest first
    if (one.given_us <= of.enrolled_us) background.answers[one.fact_id] = one.answer;
  Statement rows = question(library.database(), "sites_of_person");
  for (rows.bind("person_id", of.person_id); rows.step();) background.sites.push_back(rows.text("site"));
  return background;
}

std::string digits_of_value(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

StudyData study_data(Library& library, const StoredPlan& stored) {
  const Snapshot one_state(library.database());
  StudyData data;
  data.flow.people = counted(stored.plan, people_asked(library, stored));
  data.flow.ever_enrolled = count_ever_enrolled(library, stored.study_id);
  for (const study::PlannedGroup& group : stored.plan.groups) data.flow.groups.push_back({group.name, 0, 0, 0, 0});
  const std::set<std::string> cases = cases_of(stored.plan), metrics = metrics_of(stored.plan);
  const std::optional<StudyLock> lock = find_lock(library, stored.study_id);
  std::size_t known = 0;
  for (const StudyEnrolment& one : list_study_enrolments(library, stored.study_id)) {
    ++known;
    const auto flow = std::find_if(data.flow.groups.begin(), data.flow.groups.end(),
                                   [&](const GroupFlow& group) { return group.name == one.group; });
    if (flow == data.flow.groups.end()) continue;  // a plan and its enrolments are stored apart: damage
    ++flow->allocated;
    if (!one.consents) {
      ++flow->withdrew;
      continue;
    }
    study::StudyPerson person{one.pseudonym, one.group, {}};
    bool attempted = false;
    data.backgrounds.emplace(one.pseudonym, background_of(library, one));
    const auto hands = condition_words_of(library, one.person_id, "needle_hand"),
               arms = condition_words_of(library, one.person_id, "needle_arm");
    const auto word_of = [](const auto& words, const AttemptRow& row) {
      const auto found = words.find(row.attempt_id);
      return found == words.end() ? std::string() : found->second;
    };
    for (const AttemptRow& row : list_attempts_of(library, one.person_id, metrics)) {
      if (!cases.contains(row.case_id)) continue;
      attempted = attempted || is_of_plan(stored.plan, cases, row);
      person.attempts.push_back({row.case_id, static_cast<double>(row.started_us - one.enrolled_us) / kStudyDayUs,
                                 row.synthetic(), cut_off_words(row), word_of(hands, row), word_of(arms, row),
                                 every_version(row), lock && row.started_us > lock->locked_us});
    }
    flow->attempted += attempted ? 1U : 0U;
    data.people.push_back(std::move(person));
  }
  data.flow.unknown = data.flow.ever_enrolled - std::min(known, data.flow.ever_enrolled);
  return data;
}

std::size_t people_with_outcome(const study::StudyResult& result) {
  std::set<std::string> people;
  for (const study::Compared& one : result.primary)
    for (const study::PersonValue& person : one.people)
      if (person.standing != study::Standing::absent) people.insert(person.name);
  return people.size();
}

void add_analysed(const study::StudyResult& result, ParticipantFlow& flow) {
  if (result.primary.empty()) return;
  const std::string& first = result.primary.front().outcome.name;
  for (GroupFlow& group : flow.groups) {
    std::set<std::string> people;
    for (const study::Compared& one : result.primary)
      if (one.outcome.name == first && one.refused.empty())
        for (const study::PersonValue& person : one.people)
          if (person.group == group.name && person.standing != study::Standing::absent) people.insert(person.name);
    group.analysed = people.size();
  }
}

BlindedCounts blinded_counts(Library& library, const StoredPlan& stored) {
  const Snapshot one_state(library.database());
  const std::set<std::string> cases = cases_of(stored.plan);
  BlindedCounts counts;
  const std::set<std::string> people = people_asked(library, stored);
  counts.people = counted(stored.plan, people);
  for (const std::string& person_id : people) {
    const auto rows = list_bare_attempts_of(library, person_id);
    const auto attempts = static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [&](const AttemptRow& row) { return is_of_plan(stored.plan, cases, row); }));
    counts.attempts += attempts;
    counts.with_attempts += attempts > 0 ? 1U : 0U;
  }
  return counts;
}

std::string data_hash(const study::StudyResult& result) {
  std::string text;
  for (const auto* outcomes : {&result.primary, &result.secondary})
    for (const study::Compared& one : *outcomes)
      for (const study::PersonValue& person : one.people)
        text += one.outcome.name + "\t" + one.hand + "\t" + person.name + "\t" + person.group + "\t" +
                std::to_string(static_cast<int>(person.standing)) + "\t" +
                (person.standing == study::Standing::value ? digits_of_value(person.value) : std::string()) + "\n";
  return sha256_hex(std::as_bytes(std::span(text)));
}

}  // namespace seldinger::casedb
