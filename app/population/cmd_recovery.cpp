// recovery.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <thread>

#include "app/acting/acting.h"
#include "app/attempts/this_program.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/cli/version.h"
#include "app/population/recovery.h"
#include "assessment/registry.h"
#include "assessment/statistics/reasons.h"
#include "assessment/statistics/standards/contrasting_groups.h"
#include "casedb/people/simulated_people.h"
#include "reports/learning/case_report.h"
#include "session/attempt/simulated_people.h"
#include "session/attempt/simulation.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
namespace statistics = assessment::statistics;
using casedb::LearningAttempt;

constexpr std::size_t kLeastCourse = 12;           // attempts of somebody whose course is looked at
constexpr std::uint64_t kPractisedFrom = 100'000;  // number of an attempt: none that the library holds
constexpr std::size_t kCutDraws = 2000;
constexpr std::size_t kRaterSets = 10, kRaters = 4, kRatedOthers = 400;

struct Asked {
  std::size_t truth = 100, learners = 12, jobs = 1;
  std::uint64_t seed = 1;
};

// A simulated person of the library, as they were drawn.
struct Known {
  std::string name;
  population::Person person;
};
using KnownPeople = std::map<std::string, Known>;  // by person's id

// Of the groups that have a name: what a file of one's own planted is not kept.
KnownPeople known_people(casedb::Library& library) {
  KnownPeople known;
  for (const casedb::SimulatedTruth& one : casedb::list_simulated_truths(library))
    if (const auto group = population::named_group(one.group);
        group && one.people_version == population::kPeopleVersion)
      known[one.person_id] = {one.group + "-" + std::to_string(one.number),
                              population::drawn_person(*group, one.seed, one.number)};
  return known;
}

session::SimulatedTrial trial_of(const population::Person& person, const population::Occasion& occasion) {
  session::SimulatedTrial trial;
  trial.profile = population::profile_on(person, occasion);
  trial.seed = population::attempt_seed(person, occasion);
  trial.mishaps = population::mishaps_on(person, occasion);
  return trial;
}

double value_of(const std::vector<assessment::MetricValue>& metrics, const assessment::Criterion& criterion) {
  const assessment::MetricValue* value = assessment::find_version(metrics, criterion.metric, criterion.version);
  return value != nullptr && value->value && std::isfinite(*value->value) ? *value->value : NAN;
}

// What others of a group make at their first attempt.
base::Result<std::vector<assessment::Grade>> others_of(const session::Simulation& simulation,
                                                       const std::string& group, const Asked& asked) {
  const std::uint64_t case_key = population::case_key_of(simulation.task().row.title);
  std::vector<session::SimulatedTrial> trials;
  for (std::size_t number = 1; number <= asked.truth; ++number)
    trials.push_back(trial_of(population::drawn_person(*population::named_group(group), asked.seed, number),
                              {case_key, 0, 0.0}));
  std::vector<assessment::Grade> grades(trials.size());
  Progress progress(trials.size());
  const auto done =
      simulation.forgotten_attempts(trials, asked.jobs, [&](std::size_t i, const assessment::Grade& grade) {
        grades[i] = grade;
        progress.one_done();
        return true;
      });
  progress.clear();
  if (!done) return done.error();
  return grades;
}

// The share that passes at the first attempt.
void add_difficulty(const reports::ReportedCase& own, const std::string& what,
                    const std::vector<assessment::Grade>& others, RecoverySection& section) {
  const reports::CaseNumbers numbers = reports::case_numbers({own}).front();
  double passed = 0.0, graded = 0.0;
  for (const assessment::Grade& one : others) {
    passed += one.verdict == assessment::Verdict::passed ? 1.0 : 0.0;
    graded += one.verdict == assessment::Verdict::passed || one.verdict == assessment::Verdict::failed ? 1.0 : 0.0;
  }
  if (numbers.persons == 0 || graded == 0.0) return;
  const double nearer = (passed + 2.0) / (graded + 4.0);  // never without an error
  section.numbers.push_back({what, passed / graded, std::sqrt(nearer * (1.0 - nearer) / graded),
                             static_cast<double>(numbers.first_passes) / static_cast<double>(numbers.persons),
                             numbers.first});
}

std::vector<double> first_values(const reports::ReportedCase& own, const assessment::Criterion& criterion) {
  std::vector<double> values;
  std::set<std::string> seen;
  for (const LearningAttempt& one : own.attempts)
    if (const double value = value_of(one.metrics, criterion);
        seen.insert(one.person_id).second && !std::isnan(value))
      values.push_back(value);
  return values;
}

std::vector<double> values_in(const std::vector<assessment::Grade>& grades,
                              const assessment::Criterion& criterion) {
  std::vector<double> values;
  for (const assessment::Grade& grade : grades)
    for (const assessment::CriterionResult& one : grade.criteria)
      if (one.criterion.metric == criterion.metric && !one.of_the_time_limit && one.value)
        values.push_back(*one.value);
  return values;
}

bool is_measured(const assessment::Criterion& criterion) {
  const assessment::MetricInfo* info = assessment::find_metric(criterion.metric);
  return info != nullptr && std::string_view(info->unit) != "bool";
}

std::string metric_at(const reports::ReportedCase& at, const assessment::Criterion& criterion) {
  const assessment::MetricInfo& info = *assessment::find_metric(criterion.metric);
  return at.title + ", " + info.label + (*info.unit == '\0' ? "" : ", ") + info.unit;
}

struct GroupsAttempts {
  reports::ReportedCase own;              // of the library
  std::vector<assessment::Grade> others;  // who tell what is true
};

// The cut between novices and experts by contrasting groups, as a meeting about the case would have it.
void add_cuts(const reports::ReportedCase& reported, const std::map<std::string, GroupsAttempts>& groups,
              RecoverySection& section) {
  const auto novices = groups.find("novice"), experts = groups.find("expert");
  if (novices == groups.end() || experts == groups.end()) return;
  for (const assessment::Criterion& criterion : reported.rule.criteria) {
    if (!is_measured(criterion)) continue;
    const auto cut_of = [&](std::vector<double> without, std::vector<double> competent) {
      const statistics::ContrastingGroups of{{"novice", without.size()},
                                             {"expert", competent.size()},
                                             std::move(without),
                                             std::move(competent),
                                             criterion.comparison == assessment::Comparison::at_least};
      return statistics::settled(statistics::contrasting_groups(of, kCutDraws, 1));
    };
    const statistics::Answer truth =
        cut_of(values_in(novices->second.others, criterion), values_in(experts->second.others, criterion));
    const statistics::Answer found =
        cut_of(first_values(novices->second.own, criterion), first_values(experts->second.own, criterion));
    if (!truth.estimate || !truth.ci95) {
      const auto* reason = statistics::find_reason(truth.reason.c_str());
      section.refused.push_back(metric_at(reported, criterion) + ": " +
                                (reason != nullptr ? reason->words : "there is no interval"));
      continue;
    }
    section.numbers.push_back({metric_at(reported, criterion), *truth.estimate,
                               (truth.ci95->high - truth.ci95->low) / (2.0 * 1.96), found.estimate, found.ci95});
  }
}

base::Result<void> add_first_attempts(const session::Simulation& simulation, const reports::ReportedCase& reported,
                                      const KnownPeople& known, const Asked& asked, RecoverySection& difficulty,
                                      RecoverySection& cuts) {
  std::map<std::string, GroupsAttempts> groups;
  for (const LearningAttempt& one : reported.attempts)
    if (const auto found = known.find(one.person_id); found != known.end())
      groups[found->second.person.group].own.attempts.push_back(one);
  for (auto& [group, attempts] : groups) {
    auto others = others_of(simulation, group, asked);
    if (!others) return others.error();
    attempts.others = std::move(*others);
    add_difficulty(attempts.own, reported.title + ", " + group + "s", attempts.others, difficulty);
  }
  add_cuts(reported, groups, cuts);
  return {};
}

// Whoever made attempts enough at the case, and their attempts there when nothing is left to learn.
base::Result<void> add_learning(const session::Simulation& simulation, const reports::ReportedCase& reported,
                                const KnownPeople& known, const Asked& asked,
                                std::vector<RecoverySection>& sections) {
  std::map<std::string, std::vector<const LearningAttempt*>> courses;
  for (const LearningAttempt& one : reported.attempts)
    if (known.contains(one.person_id)) courses[one.person_id].push_back(&one);
  std::erase_if(courses, [](const auto& one) { return one.second.size() < kLeastCourse; });
  while (courses.size() > asked.learners) courses.erase(std::prev(courses.end()));
  if (courses.empty()) return {};
  const std::uint64_t case_key = population::case_key_of(simulation.task().row.title);
  std::vector<session::SimulatedTrial> trials;
  for (const auto& one : courses) {
    const population::Person& person = known.at(one.first).person;
    for (std::size_t i = 0; i < asked.truth; ++i)
      trials.push_back(trial_of(person, {case_key, kPractisedFrom + i, person.practice.ceiling}));
  }
  std::vector<std::vector<assessment::MetricValue>> practised(trials.size());
  Progress progress(trials.size());
  const auto done = simulation.measured_attempts(
      trials, asked.jobs, [&](std::size_t i, const session::Simulation::MeasuredAttempt& attempt) {
        practised[i] = attempt.metrics;
        progress.one_done();
        return true;
      });
  progress.clear();
  if (!done) return done.error();
  for (const assessment::Criterion& criterion : reported.rule.criteria) {
    if (!is_measured(criterion)) continue;
    std::vector<LearnersCourse> all;
    std::size_t learner = 0;
    for (const auto& [person_id, attempts] : courses) {
      LearnersCourse& made = all.emplace_back();
      made.learner = known.at(person_id).name;
      made.practice = known.at(person_id).person.practice;
      for (const LearningAttempt* one : attempts) made.values.push_back(value_of(one->metrics, criterion));
      for (std::size_t i = 0; i < asked.truth; ++i)
        if (const double value = value_of(practised[learner * asked.truth + i], criterion); !std::isnan(value))
          made.practised_values.push_back(value);
      ++learner;
    }
    for (const auto recovered : {&pooled_recovered, &plateaus_recovered, &rates_recovered})
      sections.push_back(recovered(metric_at(reported, criterion), all));
  }
  return {};
}

int run_recovery(const Arguments& arguments) {
  Asked asked;
  asked.truth = static_cast<std::size_t>(arguments.whole("--truth", 100, 2, 100'000));
  asked.learners = static_cast<std::size_t>(arguments.whole("--learners", 12, 1, 1000));
  asked.jobs = static_cast<std::size_t>(
      arguments.whole("--jobs", std::clamp(std::thread::hardware_concurrency(), 1U, 16U), 1, 256));
  asked.seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1'000'001, 0, 9'007'199'254'740'992));
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::simulate_attempts); !by)
    return refuse(by.error());
  const KnownPeople known = known_people(*library);
  if (known.empty())
    return refuse({"no_attempt", "there are no attempts by simulated novices, intermediates or experts here"});
  const reports::CaseReport report = reports::case_report_of(*library, casedb::Learners::simulated, kVersion);
  const std::string others = std::to_string(asked.truth) + " others of the same group";
  RecoverySection difficulty{
      "How hard cases are",
      "The share that passes at the first attempt, with the interval from the case report, beside the share of " +
          others + ".",
      {}},
      cuts{"Cuts between novices and experts",
           "By contrasting groups, from first attempts, beside the cut of " + others + ".",
           {}};
  std::vector<RecoverySection> courses;
  std::size_t attempts = 0;
  for (const reports::ReportedCase& one : report.cases) {
    attempts += one.attempts.size();
    const auto simulation = session::Simulation::prepare(*library, this_program(), one.attempts.back().case_id, "");
    if (!simulation) return refuse(simulation.error());
    if (const auto done = add_first_attempts(*simulation, one, known, asked, difficulty, cuts); !done)
      return refuse(done.error());
    if (const auto done = add_learning(*simulation, one, known, asked, courses); !done) return refuse(done.error());
  }
  std::vector<population::Person> people;
  for (const auto& one : known) people.push_back(one.second.person);
  std::vector<RecoverySection> sections{std::move(difficulty), std::move(cuts)};
  std::move(courses.begin(), courses.end(), std::back_inserter(sections));
  sections.push_back(severities_recovered(people, kRaterSets, kRaters, kRatedOthers, asked.seed));
  const std::string of = "A library of " + std::to_string(known.size()) + " simulated people and " +
                         std::to_string(attempts) + " attempts of theirs at " +
                         std::to_string(report.cases.size()) + (report.cases.size() == 1 ? " case." : " cases.");
  std::fputs(text_of_recovery(of, sections).c_str(), stdout);
  return kDone;
}

constexpr Option kRecoveryOptions[] = {
    kLibrary,
    {"--truth", "N",
     "attempts, simulated and not stored, that give the true value for a group or a learner; default 100"},
    {"--learners", "N", "at most this many learners for each case, of those with 12 attempts or more; default 12"},
    {"--seed", "N", "for the other people, who give the true values; default 1000001"},
    {"--jobs", "N", "threads; default one for each core. The results are the same"}};

}  // namespace

Command recovery_command() {
  return {.name = "recovery",
          .options = kRecoveryOptions,
          .acts = true,
          .summary =
              "Compares what reports find in a library's simulated people with what was planted in them: "
              "difficulty, rates, plateaus, severity (docs/simulated-people.md).",
          .run = &run_recovery};
}

}  // namespace seldinger::app
