#include "reports/studies/numbers/relations.h"

#include <charconv>
#include <cstddef>

#include "assessment/statistics/ranks.h"
#include "assessment/statistics/relations/correlation.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
namespace statistics = assessment::statistics;

constexpr std::size_t kLeastPersons = 3;  // of a correlation

std::string every_digit(double value) {
  char text[32];
  return {text, std::to_chars(std::begin(text), std::end(text), value).ptr};
}

double number_of(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::optional<std::pair<double, double>> halves_of(const study::PersonValue& person) {
  const std::size_t n = person.values.size();
  if (n < 2) return std::nullopt;
  double sum[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) sum[i % 2] += person.values[i];
  return std::pair(sum[0] / static_cast<double>((n + 1) / 2), sum[1] / static_cast<double>(n / 2));
}

Reliability value_reliability(const study::Compared& outcome) {
  std::vector<double> one, other;
  for (const study::PersonValue& person : outcome.people)
    if (const auto halves = halves_of(person)) {
      one.push_back(halves->first);
      other.push_back(halves->second);
    }
  if (one.size() < kLeastPersons) return {{}, "fewer than three persons have two attempts with a value"};
  const double r = statistics::correlation_coefficient(statistics::midranks(one), statistics::midranks(other));
  if (!(r > 0.0)) return {{}, "the halves of persons’ attempts do not agree"};
  return {2.0 * r / (1.0 + r), {}};
}

Reliability rating_reliability(const casedb::RatedPeople& rated) {
  const auto icc = assessment::rating::agreement_of(rated.scores, rated.each).mean;
  if (!icc.estimate) return {{}, "too few replays have several ratings"};
  if (!(*icc.estimate > 0.0)) return {{}, "raters do not agree"};
  return {*icc.estimate, {}};
}

std::map<std::string, double> stated_of(const casedb::FactInfo& fact,
                                        const std::map<std::string, casedb::Background>& people) {
  std::map<std::string, double> stated;
  for (const auto& [name, background] : people)
    if (const auto answer = background.answers.find(std::string(fact.id)); answer != background.answers.end())
      stated.emplace(name, number_of(answer->second));
  return stated;
}

std::vector<Other> stated_experience(const std::map<std::string, casedb::Background>& people) {
  std::vector<Other> all;
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    if (fact.is_choice()) continue;
    Other one{
        std::string(fact.words), "as stated at enrolment", stated_of(fact, people), {{}, "it was stated once"}};
    if (!one.value.empty()) all.push_back(std::move(one));
  }
  return all;
}

Other mean_rating(const casedb::RatedPeople& rated) {
  return {"Mean rating: " + rated.form_title + ", version " + std::to_string(rated.version),
          std::to_string(rated.ratings) + " ratings", rated.mean, rating_reliability(rated)};
}

Related related(const study::Compared& outcome, const Other& other, const Reliability& of_outcome) {
  Related found;
  found.table.values.emplace_back();
  for (const study::PersonValue& person : outcome.people) {
    const auto beside = other.value.find(person.name);
    if (person.standing != study::Standing::value || beside == other.value.end()) continue;
    found.table.values.front().values.push_back(person.value);
    found.table.x.push_back(beside->second);
  }
  found.table.rows = found.table.x.size();
  std::map<std::string, std::string> options;
  if (!of_outcome.value) {
    found.why_not_corrected = "the outcome: " + of_outcome.why_not;
  } else if (!other.reliability.value) {
    found.why_not_corrected = "the other: " + other.reliability.why_not;
  } else {
    options = {{"reliability_x", every_digit(*other.reliability.value)},
               {"reliability_y", every_digit(*of_outcome.value)}};
  }
  found.raw = statistics::settled(statistics::spearman(found.table, statistics::ProcedureOptions(options)));
  std::optional<double> low, high;
  for (const statistics::Named& one : found.raw.more) {
    if (one.name == "corrected_for_attenuation") found.corrected = one.value;
    if (one.name == "corrected_low") low = one.value;
    if (one.name == "corrected_high") high = one.value;
  }
  if (low && high) found.corrected_ci95 = statistics::Interval{*low, *high};
  return found;
}

}  // namespace seldinger::reports
