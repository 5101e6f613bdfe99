// surrogate fit, check, effects.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "app/acting/acting.h"
#include "app/attempts/this_program.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/population/effects_text.h"
#include "app/population/open_surrogate.h"
#include "app/population/population_json.h"
#include "assessment/population/agreement.h"
#include "session/attempt/simulation.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

// A surrogate is asked about groups between and a little beyond those that there are.
std::vector<population::Group> fitted_groups() {
  std::vector<population::Group> groups;
  for (const double shift : {-0.6, 0.0, 0.4, 0.8, 1.2, 1.8}) groups.push_back(population::shifted_group(shift));
  return groups;
}

struct Ready {
  casedb::Library library;
  session::Simulation simulation;
  std::size_t attempts, jobs;
  std::uint64_t seed;
};

base::Result<Ready> ready(const Arguments& arguments, int attempts, int fewest, int seed) {
  arguments.required("--case");
  const auto count =
      arguments.whole("--attempts", attempts, fewest, static_cast<int>(population::Surrogate::kMost));
  const auto jobs = arguments.whole("--jobs", std::clamp(std::thread::hardware_concurrency(), 1U, 16U), 1, 256);
  const auto first = arguments.whole("--seed", seed, 0, 9'007'199'254'740'992);
  auto library = open_acting(arguments);
  if (!library) return library.error();
  if (const auto by = acting(*library, arguments, casedb::Action::simulate_attempts); !by) return by.error();
  auto simulation = session::Simulation::prepare(*library, this_program(), arguments.text("--case"), "");
  if (!simulation) return simulation.error();
  return Ready{std::move(*library), std::move(*simulation), static_cast<std::size_t>(count),
               static_cast<std::size_t>(jobs), static_cast<std::uint64_t>(first)};
}

int run_surrogate_fit(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".json"});
  auto made = ready(arguments, 600, static_cast<int>(population::Surrogate::kFewest), 1);
  if (!made) return refuse(made.error());
  auto points = simulated_points(made->simulation, fitted_groups(), made->seed, made->attempts, made->jobs);
  if (!points) return refuse(points.error());
  const auto surrogate =
      population::Surrogate::fit(mark_of_case(made->library, made->simulation), std::move(*points));
  if (!surrogate) return refuse(surrogate.error());
  write_file(out, surrogate->to_json());
  if (arguments.has("--json"))
    std::fputs(json_of_fit(*surrogate).c_str(), stdout);
  else
    std::printf("fitted to %zu simulated attempts; `seldinger surrogate check` tells how well\n",
                surrogate->points());
  return kDone;
}

void print(const std::string& group, const population::Agreement& one) {
  std::printf("%s: %zu attempts that the surrogate does not know\n", group.c_str(), one.attempts);
  std::printf("  quantiles   %zu of %zu metrics off by more than .1 SD, %zu by more than chance\n",
              one.quantiles_off, one.metrics.size(), one.quantiles_beyond_chance);
  std::printf("  nulls, zeros  %zu shares off by more than 3 points, %zu by more than chance\n", one.shares_off,
              one.shares_beyond_chance);
  std::printf(
      "  rank correlations  %zu of %zu pairs off by more than .1, %zu by more than chance; worst %.2f, %s\n",
      one.pairs_off, one.pairs, one.pairs_beyond_chance, one.worst_rank_correlation, one.worst_pair.c_str());
  std::vector<population::MetricAgreement> worst = one.metrics;
  std::sort(worst.begin(), worst.end(),
            [](const auto& a, const auto& b) { return std::abs(a.quantile_sd) > std::abs(b.quantile_sd); });
  for (std::size_t i = 0; i < std::min<std::size_t>(worst.size(), 5); ++i)
    std::printf("  %-28s %+.2f SD (one standard error of the attempts %.2f)\n", worst[i].metric.c_str(),
                worst[i].quantile_sd, worst[i].quantile_error_sd);
}

int run_surrogate_check(const Arguments& arguments) {
  auto made = ready(arguments, 500, 30, 1'000'001);
  if (!made) return refuse(made.error());
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  if (const std::string other = difference(surrogate->mark(), mark_of_case(made->library, made->simulation));
      !other.empty())
    return refuse({"other_surrogate", "the surrogate is of " + other});
  std::vector<LevelAgreement> levels;
  std::size_t beyond = 0;
  for (const char* name : {"novice", "intermediate", "expert"}) {
    const auto points = simulated_points(made->simulation, {*population::named_group(name)}, made->seed,
                                         made->attempts, made->jobs);
    if (!points) return refuse(points.error());
    const auto one = population::agreement_of(*surrogate, *points, 20, made->seed);
    beyond += one.quantiles_beyond_chance + one.shares_beyond_chance + one.pairs_beyond_chance;
    levels.push_back({name, one});
    if (!arguments.has("--json")) print(name, one);
  }
  if (arguments.has("--json")) std::fputs(json_of_agreement(levels).c_str(), stdout);
  return beyond == 0 ? kDone : kCheckFailed;
}

int run_surrogate_effects(const Arguments& arguments) {
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  const auto people = static_cast<std::size_t>(arguments.whole("--people", 2000, 100, 1'000'000));
  const auto effects = simulated_effects(*surrogate, people, 1);
  std::fputs(arguments.has("--json") ? json_of_effects(effects).c_str() : text_of_effects(effects).c_str(), stdout);
  return kDone;
}

constexpr Option kCase{"--case", "CASE", "the case"};
constexpr Option kFile{"--surrogate", "FILE.json", "what `seldinger surrogate fit` wrote"};
constexpr Option kJobs{"--jobs", "N", "threads; default one for each core. The results are the same"};
constexpr Option kFitOptions[] = {kLibrary,
                                  kCase,
                                  {"--attempts", "N", "to fit it to; default 600"},
                                  {"--seed", "N", "of the people; default 1"},
                                  kJobs,
                                  {"--out", "FILE.json", "the new file"},
                                  kJson};
constexpr Option kCheckOptions[] = {kLibrary,
                                    kCase,
                                    kFile,
                                    {"--attempts", "N", "of each level, that it was not fitted to; default 500"},
                                    {"--seed", "N", "of the people; default 1000001"},
                                    kJobs,
                                    kJson};
constexpr Option kEffectsOptions[] = {kFile, {"--people", "N", "drawn for each group; default 2000"}, kJson};

}  // namespace

Command surrogate_fit_command() {
  return {.name = "surrogate fit",
          .options = kFitOptions,
          .acts = true,
          .summary = "Fits a fast stand-in for simulated people's attempts at a case to attempts simulated whole.",
          .run = &run_surrogate_fit};
}

Command surrogate_check_command() {
  return {.name = "surrogate check",
          .options = kCheckOptions,
          .acts = true,
          .summary = "Holds a surrogate against attempts simulated whole that it was not fitted to.",
          .run = &run_surrogate_check};
}

Command surrogate_effects_command() {
  return {.name = "surrogate effects",
          .options = kEffectsOptions,
          .summary = "Tells how simulated novices and experts differ in each metric, beside published effects.",
          .run = &run_surrogate_effects};
}

}  // namespace seldinger::app
