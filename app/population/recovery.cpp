#include "app/population/recovery.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/population/raters.h"
#include "assessment/statistics/distributions.h"
#include "assessment/statistics/growth/learning_curve.h"
#include "assessment/statistics/growth/rasch/rasch.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
namespace statistics = assessment::statistics;

constexpr double kWidth95 = 1.959963984540054;

struct MeanAndError {
  double mean = 0.0, error = 0.0;
};
MeanAndError mean_and_error(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  const auto n = static_cast<double>(values.size());
  for (const double one : values) sum += one / n;
  for (const double one : values) squares += (one - sum) * (one - sum);
  return {sum, values.size() < 2 ? 0.0 : std::sqrt(squares / (n - 1.0) / n)};
}

// Attempts with a value, counted from 1 over all of them.
struct PresentCourse {
  std::vector<double> t, y;
};
PresentCourse present_course(const std::vector<double>& values) {
  PresentCourse course;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) {
      course.t.push_back(static_cast<double>(i + 1));
      course.y.push_back(values[i]);
    }
  return course;
}

std::optional<double> named_number(const statistics::Answer& answer, const char* name) {
  for (const statistics::Named& one : answer.more)
    if (one.name == name) return one.value;
  return std::nullopt;
}

// As the report of a learner has it: the better of both curves.
void find_plateau(const PresentCourse& course, PlantedNumber& number) {
  statistics::DataTable table;
  table.values.push_back({"value", course.y});
  table.x = course.t;
  table.rows = course.y.size();
  const statistics::Answer answer = statistics::learning_curve(table, {});
  number.found = named_number(answer, "plateau");
  const auto low = named_number(answer, "plateau_low"), high = named_number(answer, "plateau_high");
  if (low && high) number.interval = statistics::Interval{*low, *high};
}

// Of the exponential curve, whose b is the share that an attempt takes of what is left; of a power law it is not.
void find_rate(const PresentCourse& course, PlantedNumber& number) {
  const auto curve = statistics::fit_curve(statistics::CurveKind::exponential, course.t, course.y);
  if (!curve || curve->at_bound || !std::isfinite(curve->se_b)) return;
  const double reach =
      statistics::student_t_quantile(0.975, static_cast<double>(course.y.size() - 3)) * curve->se_b;
  number.found = curve->b;
  number.interval = statistics::Interval{curve->b - reach, curve->b + reach};
}

std::string number_cell(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string interval_cell(const PlantedNumber& one) {
  if (!one.interval) return "";
  return number_cell(one.interval->low) + " to " + number_cell(one.interval->high);
}

// What each rater of a set makes of each person, item by item, from 0; `cycle`: a rater's tiredness begins anew.
statistics::DataTable ratings_of(const std::vector<population::Person>& people,
                                 const std::vector<population::Rater>& raters, std::size_t cycle) {
  statistics::DataTable table;
  for (const population::RatedItem& item : population::rated_items())
    table.values.push_back({std::string(item.name), {}});
  for (std::size_t p = 0; p < people.size(); ++p)
    for (std::size_t r = 0; r < raters.size(); ++r) {
      for (std::size_t item = 0; item < table.values.size(); ++item)
        table.values[item].values.push_back(
            population::rating_of(raters[r], people[p], people[p].ability, item, p % cycle) - 1);
      table.subject.push_back("p" + std::to_string(p));
      table.rater.push_back("r" + std::to_string(r + 1));
      ++table.rows;
    }
  return table;
}

struct Severity {
  double logits = 0.0, error = 0.0;
};
std::optional<Severity> severity_in(const statistics::Answer& answer, std::size_t rater) {
  for (const statistics::Row& row : answer.rows)
    if (row.name == "rater: r" + std::to_string(rater)) return Severity{row.values[0].value, row.values[1].value};
  return std::nullopt;
}

}  // namespace

std::optional<bool> PlantedNumber::held() const {
  if (!interval || !found) return std::nullopt;
  const double off = kWidth95 * planted_error;
  const double low = *found - std::hypot(*found - interval->low, off);
  const double high = *found + std::hypot(interval->high - *found, off);
  return low <= planted && planted <= high;
}

std::size_t RecoverySection::held() const {
  return static_cast<std::size_t>(std::count_if(
      numbers.begin(), numbers.end(), [](const PlantedNumber& one) { return one.held().value_or(false); }));
}

std::size_t RecoverySection::with_interval() const {
  return static_cast<std::size_t>(std::count_if(numbers.begin(), numbers.end(),
                                                [](const PlantedNumber& one) { return one.held().has_value(); }));
}

RecoverySection plateaus_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses) {
  RecoverySection section{"Where a learner levels off: " + metric,
                          "The plateau in the learner's report, beside the mean of attempts by the same person "
                          "with nothing left to learn.",
                          {}};
  for (const LearnersCourse& one : courses) {
    const MeanAndError planted = mean_and_error(one.practised_values);
    PlantedNumber number{one.learner, planted.mean, planted.error, {}, {}};
    find_plateau(present_course(one.values), number);
    section.numbers.push_back(std::move(number));
  }
  return section;
}

RecoverySection rates_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses) {
  RecoverySection section{"How fast a learner learns: " + metric,
                          "The rate b of the exponential curve, beside the planted one: each attempt removes a "
                          "share 1 − exp(−b) of what is left.",
                          {}};
  for (const LearnersCourse& one : courses) {
    if (!(one.practice.ceiling > 0.0)) continue;
    PlantedNumber number{one.learner, one.practice.rate, 0.0, {}, {}};
    find_rate(present_course(one.values), number);
    section.numbers.push_back(std::move(number));
  }
  return section;
}

RecoverySection pooled_recovered(const std::string& metric, const std::vector<LearnersCourse>& courses) {
  RecoverySection section{"All learners as one: " + metric,
                          "One curve through the mean of all learners at each attempt. The planted rate is that of "
                          "an exponential through the mean of what practice added.",
                          {}};
  std::size_t attempts = 0;
  for (const LearnersCourse& one : courses) attempts = std::max(attempts, one.values.size());
  std::vector<double> t, gains, means(attempts, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < attempts; ++i) {
    std::vector<double> now, added;
    for (const LearnersCourse& one : courses) {
      if (i < one.values.size() && !std::isnan(one.values[i])) now.push_back(one.values[i]);
      added.push_back(one.practice.ceiling * (1.0 - std::exp(-one.practice.rate * static_cast<double>(i))));
    }
    if (!now.empty()) means[i] = mean_and_error(now).mean;
    t.push_back(static_cast<double>(i + 1));
    gains.push_back(mean_and_error(added).mean);
  }
  const PresentCourse course = present_course(means);
  MeanAndError plateau;
  for (const LearnersCourse& one : courses) {
    const MeanAndError own = mean_and_error(one.practised_values);
    plateau.mean += own.mean / static_cast<double>(courses.size());
    plateau.error = std::hypot(plateau.error, own.error / static_cast<double>(courses.size()));
  }
  PlantedNumber level{"plateau", plateau.mean, plateau.error, {}, {}};
  find_plateau(course, level);
  section.numbers.push_back(std::move(level));
  if (const auto planted = statistics::fit_curve(statistics::CurveKind::exponential, t, gains)) {
    PlantedNumber rate{"rate b", planted->b, 0.0, {}, {}};
    find_rate(course, rate);
    section.numbers.push_back(std::move(rate));
  }
  return section;
}

RecoverySection severities_recovered(const std::vector<population::Person>& people, std::size_t sets,
                                     std::size_t raters, std::size_t many, std::uint64_t seed) {
  RecoverySection section{"How severe raters are",
                          "Severity in logits by the many-facet rating scale model, each rater with each person "
                          "once, beside what the model finds for the same raters and " +
                              std::to_string(many) +
                              " other people. Raters have a halo: items of one rating are more alike than the "
                              "model assumes, so its intervals are too narrow.",
                          {}};
  std::vector<population::Person> others;
  for (std::size_t p = 0; p < many && !people.empty(); ++p)
    others.push_back(population::drawn_person(
        population::named_group(people[p % people.size()].group).value_or(population::shifted_group(0.0)), seed + 1,
        p + 1));
  for (std::size_t set = 0; set < sets; ++set) {
    std::vector<population::Rater> drawn;
    for (std::size_t r = 1; r <= raters; ++r) drawn.push_back(population::drawn_rater(seed + set, r));
    const statistics::Answer found =
        statistics::rasch(ratings_of(people, drawn, std::max<std::size_t>(1, people.size())));
    const statistics::Answer truth =
        statistics::rasch(ratings_of(others, drawn, std::max<std::size_t>(1, people.size())));
    for (std::size_t r = 1; r <= raters; ++r) {
      const auto planted = severity_in(truth, r), own = severity_in(found, r);
      if (!planted) continue;
      PlantedNumber number{"set " + std::to_string(set + 1) + ", rater " + std::to_string(r),
                           planted->logits,
                           planted->error,
                           {},
                           {}};
      if (own) {
        number.found = own->logits;
        number.interval =
            statistics::Interval{own->logits - kWidth95 * own->error, own->logits + kWidth95 * own->error};
      }
      section.numbers.push_back(std::move(number));
    }
  }
  return section;
}

std::string text_of_recovery(const std::string& of, const std::vector<RecoverySection>& sections) {
  std::string text =
      "# What reports find of what was planted\n\nMade by `seldinger recovery`. **SIMULATED:** nothing "
      "here is about people. " +
      of + "\n\n| | intervals | that contain the planted value |\n|---|---|---|\n";
  for (const RecoverySection& one : sections)
    text +=
        "| " + one.title + " | " + std::to_string(one.with_interval()) + " of " +
        std::to_string(one.numbers.size()) + " | " + std::to_string(one.held()) +
        (one.with_interval() == 0
             ? ""
             : " (" +
                   number_cell(100.0 * static_cast<double>(one.held()) / static_cast<double>(one.with_interval())) +
                   " %)") +
        " |\n";
  text +=
      "\nIntervals are 95 % intervals. Where the planted number is itself simulated, its error widens the interval "
      "before the comparison.\n";
  for (const RecoverySection& one : sections) {
    text += "\n## " + one.title + "\n\n" + one.words + "\n";
    if (!one.refused.empty()) text += "\nNot estimable:\n\n";
    for (const std::string& what : one.refused) text += "- " + what + "\n";
    if (one.numbers.empty() && !one.refused.empty()) continue;
    if (one.numbers.empty()) {
      text += "\nNothing could be estimated.\n";
      continue;
    }
    text += "\n| | planted | found | 95 % | holds |\n|---|---|---|---|---|\n";
    for (const PlantedNumber& number : one.numbers) {
      const auto held = number.held();
      text += "| " + number.what + " | " + number_cell(number.planted) +
              (number.planted_error > 0.0 ? " ± " + number_cell(number.planted_error) : "") + " | " +
              (number.found ? number_cell(*number.found) : "none") + " | " + interval_cell(number) + " | " +
              (held ? (*held ? "yes" : "**no**") : "") + " |\n";
    }
  }
  return text;
}

}  // namespace seldinger::app
