// surrogate coverage.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/population/open_surrogate.h"
#include "app/population/population_json.h"
#include "assessment/population/studies/dose_response.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

// What of intervals of 95 % may hold the truth: they are of the logit of an area.
constexpr double kPlanned = 0.95, kMayBeOff = 0.025;

double covered_share(const population::MetricResponse& one) {
  return one.intervals == 0 ? NAN : static_cast<double>(one.covered) / static_cast<double>(one.intervals);
}
double d_covered_share(const population::MetricResponse& one) {
  return one.d_intervals == 0 ? NAN : static_cast<double>(one.d_covered) / static_cast<double>(one.d_intervals);
}

std::vector<double> shifts_of(const Arguments& arguments) {
  if (!arguments.has("--shift")) return {0.0, 0.2, 0.5, 0.8, 1.2};
  std::vector<double> shifts;
  for (const std::string& text : arguments.all("--shift")) {
    const double shift = parse_number(text).value_or(NAN);
    if (!(std::abs(shift) <= kMostShift)) throw UsageError("--shift is a number of -5 to 5");
    shifts.push_back(shift);
  }
  return shifts;
}

void print_sum(const std::vector<population::MetricDose>& doses, const std::vector<double>& shifts) {
  std::printf(
      "| shift | metrics | interval holds the truth, least | middle | most | outside 95 ± 2.5 %% | pairs, largest "
      "rank correlation |\n|---|---|---|---|---|---|---|\n");
  for (std::size_t s = 0; s < shifts.size(); ++s) {
    std::vector<double> shares;
    double paired = 0.0;
    for (const population::MetricDose& one : doses) {
      if (one.responses[s].intervals > 0) shares.push_back(covered_share(one.responses[s]));
      paired = std::max(paired, std::abs(one.responses[s].paired));
    }
    if (shares.empty()) {
      std::printf("| %g | 0 | – | – | – | – | %.3f |\n", shifts[s], paired);
      continue;
    }
    std::sort(shares.begin(), shares.end());
    const auto outside = std::count_if(shares.begin(), shares.end(),
                                       [](double share) { return !(std::abs(share - kPlanned) <= kMayBeOff); });
    std::printf("| %g | %zu | %.1f %% | %.1f %% | %.1f %% | %td | %.3f |\n", shifts[s], shares.size(),
                100.0 * shares.front(), 100.0 * shares[shares.size() / 2], 100.0 * shares.back(), outside, paired);
  }
}

// Of metrics that are normal enough at some shift.
void print_differences(const std::vector<population::MetricDose>& doses, const std::vector<double>& shifts) {
  std::printf(
      "\nDifferences in standard deviations, of metrics that are normal enough in both groups (skewness within "
      "±0.5, "
      "excess kurtosis within ±1), or whose logarithm is (ln):\n\n| metric |");
  for (const double shift : shifts) std::printf(" shift %g |", shift);
  std::printf("\n|---|");
  for (std::size_t s = 0; s < shifts.size(); ++s) std::printf("---|");
  std::printf("\n");
  for (const population::MetricDose& one : doses) {
    if (std::none_of(one.responses.begin(), one.responses.end(), [](const auto& at) { return at.d.has_value(); }))
      continue;
    std::printf("| `%s` |", one.metric.c_str());
    for (const population::MetricResponse& at : one.responses)
      if (at.d)
        std::printf(" %+.2f%s (%.1f %%) |", *at.d, at.of_logarithms ? " ln" : "", 100.0 * d_covered_share(at));
      else
        std::printf(" – |");
    std::printf("\n");
  }
}

void print_metrics(const std::vector<population::MetricDose>& doses, const std::vector<double>& shifts) {
  std::printf("\n| metric |");
  for (const double shift : shifts) std::printf(" shift %g |", shift);
  std::printf("\n|---|");
  for (std::size_t s = 0; s < shifts.size(); ++s) std::printf("---|");
  std::printf("\n");
  for (const population::MetricDose& one : doses) {
    std::printf("| `%s` |", one.metric.c_str());
    for (const population::MetricResponse& at : one.responses)
      std::printf(" %.3f (%.1f %%) |", at.area, 100.0 * covered_share(at));
    std::printf("\n");
  }
}

int run_surrogate_coverage(const Arguments& arguments) {
  const auto shifts = shifts_of(arguments);
  population::DoseOptions options;
  options.per_group = static_cast<std::size_t>(arguments.whole("--per-group", 30, 5, 10'000));
  options.studies = static_cast<std::size_t>(arguments.whole("--studies", 2000, 10, 1'000'000));
  options.truth_people = static_cast<std::size_t>(arguments.whole("--truth-people", 1'000'000, 1000, 10'000'000));
  options.seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  const auto doses = dose_response(*surrogate, shifts, options);
  if (doses.empty()) return refuse({"bad_surrogate", "no metric of the surrogate differs between attempts"});
  if (arguments.has("--json")) {
    std::fputs(json_of_doses(doses, shifts, options).c_str(), stdout);
    return kDone;
  }
  std::printf(
      "Simulated, nothing here is about people: %zu studies of %zu and %zu people a shift at `%s`, the true values "
      "from %zu in each group.\n\n",
      options.studies, options.per_group, options.per_group, surrogate->mark().case_title.c_str(),
      options.truth_people);
  print_sum(doses, shifts);
  print_metrics(doses, shifts);
  print_differences(doses, shifts);
  return kDone;
}

constexpr Option kCoverageOptions[] = {
    {"--surrogate", "FILE.json", "what `seldinger surrogate fit` wrote"},
    {"--shift", "X",
     "shift of abilities in standard deviations; may be given many times; default 0, 0.2, 0.5, 0.8, 1.2", true},
    {"--per-group", "N", "people in each group; default 30"},
    {"--studies", "N", "how many studies; default 2000"},
    {"--truth-people", "N", "people in each group that give the true value; default 1000000"},
    {"--seed", "N", "for everything that is drawn at random; default 1"},
    kJson};

}  // namespace

Command surrogate_coverage_command() {
  return {.name = "surrogate coverage",
          .options = kCoverageOptions,
          .summary =
              "Estimates each metric's area under the ROC curve for each shift of abilities, and how often a "
              "study's interval contains it.",
          .run = &run_surrogate_coverage};
}

}  // namespace seldinger::app
