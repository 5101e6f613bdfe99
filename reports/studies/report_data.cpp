#include "reports/studies/report_data.h"

#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "assessment/statistics/relations/proportions.h"
#include "reports/export/csv_line.h"
#include "reports/studies/numbers/baseline.h"
#include "reports/studies/numbers/decision_numbers.h"
#include "reports/studies/numbers/relations.h"
#include "reports/studies/numbers/subgroups.h"
#include "reports/studies/study_words.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> study_files();
}

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
namespace statistics = assessment::statistics;

constexpr auto kStandingWords = base::names<study::Standing>({{study::Standing::value, "value"},
                                                              {study::Standing::failure, "failure"},
                                                              {study::Standing::censored, "censored"},
                                                              {study::Standing::absent, "absent"}});

// Every comparison with its number, from 1: primary ones first.
template <typename Told>
void each_outcome(const ValidityReport& report, const Told& told) {
  std::size_t number = 0;
  for (const study::Compared& one : report.result.primary) told(++number, one, true);
  for (const study::Compared& one : report.result.secondary) told(++number, one, false);
}

std::string people_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name :
       {"outcome", "person", "group", "standing", "value", "every_visit", "last_but_one", "last", "odd", "even"})
    line.text(name);
  std::string text = line.take();
  std::map<std::string, std::uint64_t> numbers;  // of persons
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool) {
    for (const study::PersonValue& person : one.people) {
      const std::uint64_t who = numbers.emplace(person.name, numbers.size() + 1).first->second;
      line.whole(std::uint64_t{number}).whole(who).text(person.group);
      line.text(base::name_of(kStandingWords, person.standing));
      line.number(person.standing == study::Standing::value ? std::optional(person.value) : std::nullopt);
      line.flag(person.every_visit);
      const std::size_t n = person.values.size();
      line.number(n > 1 ? std::optional(person.values[n - 2]) : std::nullopt);
      line.number(n > 1 ? std::optional(person.values[n - 1]) : std::nullopt);
      const auto halves = halves_of(person);
      line.number(halves ? std::optional(halves->first) : std::nullopt);
      line.number(halves ? std::optional(halves->second) : std::nullopt);
      text += line.take();
    }
  });
  return text;
}

std::string outcomes_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"outcome", "primary", "name", "hand", "metric", "test", "first", "second", "better",
                           "failure_value", "absent", "refused", "cut", "cut_higher_is_better"})
    line.text(name);
  std::string text = line.take();
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool primary) {
    const study::Outcome& outcome = one.outcome;
    const auto mark = pass_mark_of(report.marks, outcome);
    line.whole(std::uint64_t{number}).flag(primary).text(outcome.name).text(one.hand).text(outcome.metric);
    line.text(base::name_of(study::kTestNames, outcome.test)).text(outcome.first).text(outcome.second);
    line.text(outcome.better == assessment::Direction::lower_is_better ? "lower" : "higher");
    line.number(outcome.failure_value);
    line.text(base::name_of(study::kAbsentNames, report.plan.plan.absent)).flag(!one.refused.empty());
    line.number(mark ? std::optional(mark->cut) : std::nullopt).flag(mark && mark->higher_is_better);
    text += line.take();
  });
  return text;
}

// Each scale's answers, and one row a respondent and item.
std::string answers_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"scale", "respondent", "item", "score"}) line.text(name);
  std::string text = line.take();
  for (std::size_t scale = 0; scale < report.forms.size(); ++scale) {
    const statistics::DataTable& of = report.forms[scale].answers;
    for (std::size_t row = 0; row < of.rows; ++row)
      for (const statistics::Column& item : of.values) {
        const double score = item.values[row];
        line.whole(std::uint64_t{scale + 1}).whole(std::uint64_t{row + 1}).text(item.name);
        line.number(std::isnan(score) ? std::nullopt : std::optional(score));
        text += line.take();
      }
  }
  return text;
}

// Without calibration and repeats; raters and replays by numbers in the order of their names.
void add_scores(std::string& text, const std::string& name, std::size_t each,
                const std::vector<assessment::rating::Rating>& scores) {
  CsvLine line;
  std::map<std::string, std::uint64_t> replays, raters;
  for (const assessment::rating::Rating& one : scores) {
    replays[one.view] = 0;
    raters[one.rater] = 0;
  }
  for (auto* numbers : {&replays, &raters}) {
    std::uint64_t next = 0;
    for (auto& [of, number] : *numbers) number = ++next;
  }
  for (const assessment::rating::Rating& one : scores) {
    if (one.part != assessment::rating::Part::rated) continue;
    line.text(name).whole(std::uint64_t{each}).whole(replays[one.view]);
    line.whole(raters[one.rater]).number(one.score);
    text += line.take();
  }
}

// Of each round, and of each form at a case.
std::string ratings_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"of", "each", "replay", "rater", "score"}) line.text(name);
  std::string text = line.take();
  for (std::size_t i = 0; i < report.rated_rounds.size(); ++i)
    add_scores(text, "round " + std::to_string(i + 1), report.rated_rounds[i].each, report.rated_rounds[i].scores);
  for (std::size_t i = 0; i < report.ratings.size(); ++i)
    add_scores(text, "form " + std::to_string(i + 1), report.ratings[i].each, report.ratings[i].scores);
  return text;
}

// Each primary outcome beside what else is known of its people; `form`: empty, or as ratings.csv has it.
template <typename Told>
void each_related(const ValidityReport& report, const Told& told) {
  const std::vector<Other> experience = stated_experience(report.backgrounds);
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool primary) {
    if (!primary) return;
    const Reliability of_outcome = value_reliability(one);
    std::size_t others = 0;
    const auto tell = [&](const Other& other, const std::string& form) {
      told(number, ++others, form, of_outcome, related(one, other, of_outcome));
    };
    for (std::size_t i = 0; i < report.ratings.size(); ++i)
      if (report.ratings[i].case_id == one.outcome.case_id)
        tell(mean_rating(report.ratings[i]), "form " + std::to_string(i + 1));
    for (const Other& other : experience) tell(other, {});
  });
}

std::string related_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"outcome", "other", "form", "value", "beside"}) line.text(name);
  std::string text = line.take();
  each_related(report, [&](std::size_t number, std::size_t other, const std::string& form, const Reliability&,
                           const Related& found) {
    for (std::size_t row = 0; row < found.table.rows; ++row) {
      line.whole(std::uint64_t{number}).whole(std::uint64_t{other}).text(form);
      line.number(found.table.values.front().values[row]).number(found.table.x[row]);
      text += line.take();
    }
  });
  return text;
}

// Subgroups by numbers, since a site's name is what somebody wrote; withheld ones are not here.
template <typename Told>
void each_subgroup(const ValidityReport& report, const Told& told) {
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool primary) {
    const auto mark = primary ? pass_mark_of(report.marks, one.outcome) : std::nullopt;
    if (!mark) return;
    const std::vector<Subgroups> parted = subgroups_of(one, *mark, report.backgrounds);
    for (std::size_t by = 0; by < parted.size(); ++by)
      for (std::size_t i = 0; i < parted[by].groups.size(); ++i)
        if (parted[by].groups[i].told) told(number, by + 1, i + 1, parted[by].groups[i]);
  });
}

std::string subgroups_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"outcome", "by", "subgroup", "passed"}) line.text(name);
  std::string text = line.take();
  each_subgroup(report, [&](std::size_t number, std::size_t by, std::size_t which, const Subgroup& group) {
    for (const bool passed : group.passed) {
      line.whole(std::uint64_t{number}).whole(std::uint64_t{by}).whole(std::uint64_t{which}).flag(passed);
      text += line.take();
    }
  });
  return text;
}

std::string baseline_table_text(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"fact", "group", "value"}) line.text(name);
  std::string text = line.take();
  for (const BaselineRow& row : baseline_of(report.plan.plan, report.backgrounds))
    for (std::size_t group = 0; group < row.groups.size(); ++group)
      for (const double value : row.groups[group].stated) {
        line.text(row.fact->id).whole(std::uint64_t{group + 1}).number(value);
        text += line.take();
      }
  return text;
}

// What was drawn for who is absent, in the order of people.csv, group by group.
std::string imputed_table(const ValidityReport& report) {
  CsvLine line;
  for (const char* name : {"outcome", "draw", "place", "value"}) line.text(name);
  std::string text = line.take();
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool) {
    for (const study::Sensitivity& other : one.sensitivity)
      for (std::size_t draw = 0; draw < other.draws.size(); ++draw)
        for (std::size_t place = 0; place < other.draws[draw].size(); ++place) {
          line.whole(std::uint64_t{number}).whole(std::uint64_t{draw + 1}).whole(std::uint64_t{place + 1});
          line.number(other.draws[draw][place]);
          text += line.take();
        }
  });
  return text;
}

class Numbers {
 public:
  Numbers() {
    for (const char* name : {"outcome", "rule", "number", "value"}) line_.text(name);
    text_ = line_.take();
  }
  // Of an outcome by its number, or of "scale 1", "round 1", "outcome 1 other 2", "outcome 1 by 2 subgroup 3".
  void begin(std::string of, std::string_view rule) {
    of_ = std::move(of);
    rule_ = rule;
  }
  void add(const std::string& name, const std::optional<double>& value) {
    if (!value) return;
    line_.text(of_).text(rule_).text(name).number(*value);
    text_ += line_.take();
  }
  void add(const std::string& name, const std::optional<statistics::Interval>& interval) {
    if (!interval) return;
    add(name + "low", interval->low);
    add(name + "high", interval->high);
  }
  void count(const std::string& name, std::size_t many) { add(name, std::optional(static_cast<double>(many))); }
  const std::string& text() const { return text_; }

 private:
  CsvLine line_;
  std::string text_, of_, rule_;
};

void add_group(Numbers& numbers, const std::string& which, const study::GroupSum& sum) {
  numbers.count(which + "_n", sum.persons - sum.absent);
  numbers.count(which + "_failed", sum.failures + sum.censored);
  numbers.count(which + "_absent", sum.absent);
  numbers.add(which + "_median", sum.median);
  numbers.add(which + "_low_quartile", sum.low_quartile);
  numbers.add(which + "_high_quartile", sum.high_quartile);
}

void add_effect_numbers(Numbers& numbers, const statistics::Answer& answer, bool with_p) {
  if (!answer.estimable()) return;
  numbers.count("n", answer.n);
  numbers.add("estimate", answer.estimate);
  numbers.add("", answer.ci95);
  if (with_p) numbers.add("p", answer.p_value);
}

void add_decision_numbers(Numbers& numbers, const ValidityReport& report, const study::Compared& one) {
  const statistics::Answer agreement = agreement_of(one);
  if (agreement.estimable()) {
    numbers.count("agreement_n", agreement.n);
    numbers.add("agreement_icc", agreement.estimate);
    numbers.add("agreement_icc_", agreement.ci95);
    numbers.add("agreement_sem", further(agreement, "sem"));
    numbers.add("agreement_mdc95", further(agreement, "mdc95"));
  }
  const auto mark = pass_mark_of(report.marks, one.outcome);
  if (!mark) return;
  for (const bool first : {true, false}) {
    const AtMark at = at_mark(one, first ? one.outcome.first : one.outcome.second, *mark);
    const std::string which = first ? "first_pass" : "second_pass";
    numbers.count(which, static_cast<std::size_t>(at.passed));
    if (at.n > 0) numbers.add(which + "_", std::optional(statistics::wilson_interval(at.passed, at.n)));
  }
  const statistics::Answer decisions = decisions_of(one, *mark, agreement);
  if (!decisions.estimable()) return;
  numbers.add("alike", decisions.estimate);
  numbers.add("false_pass", further(decisions, "false_pass"));
  numbers.add("false_fail", further(decisions, "false_fail"));
}

void add_named(Numbers& numbers, const std::string& name, const statistics::Answer& answer) {
  numbers.add(name, answer.estimate);
  if (answer.estimate) numbers.add(name + "_", answer.ci95);
}

// Questionnaires' items, raters' scores, outcomes beside what else is known, and who passes.
void add_structure_numbers(Numbers& numbers, const ValidityReport& report) {
  for (std::size_t i = 0; i < report.forms.size(); ++i) {
    const FormReliability& one = report.forms[i];
    numbers.begin("scale " + std::to_string(i + 1), "answers");
    numbers.count("respondents", one.alpha.n);
    add_named(numbers, "alpha", one.alpha);
    add_named(numbers, "omega", one.omega);
  }
  for (std::size_t i = 0; i < report.rated_rounds.size(); ++i) {
    const assessment::rating::Agreement& one = report.rated_rounds[i].agreement;
    numbers.begin("round " + std::to_string(i + 1), "ratings");
    numbers.count("ratings", one.ratings);
    add_named(numbers, "icc_one", one.one);
    add_named(numbers, "icc_mean", one.mean);
  }
  for (const BaselineRow& row : baseline_of(report.plan.plan, report.backgrounds))
    for (std::size_t group = 0; group < row.groups.size(); ++group) {
      numbers.begin("group " + std::to_string(group + 1) + " " + std::string(row.fact->id), "baseline");
      numbers.count("stated", row.groups[group].stated.size());
      numbers.add("median", row.groups[group].median);
      numbers.add("low_quartile", row.groups[group].low_quartile);
      numbers.add("high_quartile", row.groups[group].high_quartile);
    }
  each_related(report, [&](std::size_t number, std::size_t other, const std::string&, const Reliability& of_outcome,
                           const Related& found) {
    numbers.begin("outcome " + std::to_string(number) + " other " + std::to_string(other), "related");
    numbers.count("related_people", found.raw.n);
    add_named(numbers, "rho", found.raw);
    numbers.add("reliability", of_outcome.value);
    numbers.add("corrected", found.corrected);
    numbers.add("corrected_", found.corrected_ci95);
  });
  each_subgroup(report, [&](std::size_t number, std::size_t by, std::size_t which, const Subgroup& group) {
    numbers.begin(
        "outcome " + std::to_string(number) + " by " + std::to_string(by) + " subgroup " + std::to_string(which),
        "subgroups");
    numbers.count("passed", static_cast<std::size_t>(group.passes()));
    numbers.count("persons", static_cast<std::size_t>(group.n()));
    numbers.add("share_", std::optional(group.share));
    numbers.add("difference_", group.difference);
  });
}

std::string numbers_table(const ValidityReport& report) {
  Numbers numbers;
  each_outcome(report, [&](std::size_t number, const study::Compared& one, bool primary) {
    numbers.begin(std::to_string(number), "plan");
    add_group(numbers, "first", one.first);
    add_group(numbers, "second", one.second);
    if (primary) add_decision_numbers(numbers, report, one);
    if (!one.refused.empty()) return;
    add_effect_numbers(numbers, one.answer, primary);
    if (primary) numbers.add("p_holm", one.p_adjusted);
    numbers.add("cliff_delta", further(one.answer, "cliff_delta"));
    numbers.add("detectable", further(one.answer, "detectable_"));
    if (!primary) return;
    for (const study::Sensitivity& other : one.sensitivity) {
      numbers.begin(std::to_string(number), base::name_of(study::kOtherRuleNames, other.kind));
      add_effect_numbers(numbers, other.answer, true);
      numbers.add("shift", other.shift);
    }
  });
  add_structure_numbers(numbers, report);
  return numbers.text();
}

}  // namespace

std::vector<DataFile> report_data(const ValidityReport& report) {
  CHECK(report.plan.frozen());
  return {{"people.csv", people_table(report)},
          {"outcomes.csv", outcomes_table(report)},
          {"answers.csv", answers_table(report)},
          {"ratings.csv", ratings_table(report)},
          {"related.csv", related_table(report)},
          {"subgroups.csv", subgroups_table(report)},
          {"baseline.csv", baseline_table_text(report)},
          {"imputed.csv", imputed_table(report)},
          {"numbers.csv", numbers_table(report)},
          {"redo.R", std::string(base::content_of(embedded::study_files(), "redo.R"))}};
}

}  // namespace seldinger::reports
