// study simulate.
#include <cmath>
#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/population/open_surrogate.h"
#include "app/population/population_json.h"
#include "app/population/study_tables.h"
#include "assessment/population/studies/simulated_study.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;
namespace study = assessment::study;

constexpr std::size_t kMostPlanBytes = 1U << 20U;

// "novices=0": a group of the plan and by how much its abilities are shifted, or which group of people it is.
population::Group group_of(const study::Plan& plan, const std::string& text, std::size_t& which) {
  const std::size_t equals = text.rfind('=');
  const auto found = std::find_if(plan.groups.begin(), plan.groups.end(), [&](const study::PlannedGroup& one) {
    return one.name == text.substr(0, equals);
  });
  if (equals == text.npos || found == plan.groups.end())
    throw UsageError("--shift is a group of the plan, = and a number or novice, intermediate, expert");
  which = static_cast<std::size_t>(found - plan.groups.begin());
  const auto known = group_from(text.substr(equals + 1));
  if (!known) throw UsageError("--shift ends in a number of -5 to 5, or novice, intermediate, expert");
  population::Group group = *known;
  // Two groups of the same shift are different people.
  group.name = found->name;
  return group;
}

population::World world_of(const Arguments& arguments, const study::Plan& plan) {
  population::World world;
  std::vector<bool> told(plan.groups.size());
  world.groups.resize(plan.groups.size());
  if (arguments.has("--shift"))
    for (const std::string& text : arguments.all("--shift")) {
      std::size_t which = 0;
      population::Group group = group_of(plan, text, which);
      world.groups[which] = std::move(group);
      told[which] = true;
    }
  for (std::size_t g = 0; g < told.size(); ++g)
    if (!told[g]) throw UsageError("--shift is given for every group of the plan: " + plan.groups[g].name + "=0.8");
  world.per_group = static_cast<std::size_t>(arguments.whole("--per-group", plan.per_group, 2, 10'000));
  world.sites = static_cast<std::size_t>(arguments.whole("--sites", 1, 1, 1000));
  world.devices = static_cast<std::size_t>(arguments.whole("--devices", 1, 1, 1000));
  world.raters = static_cast<std::size_t>(arguments.whole("--raters", 0, 0, 1000));
  return world;
}

std::string share_text(std::size_t part, std::size_t of) {
  if (of == 0) return "–";
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %% (%zu of %zu)",
                100.0 * static_cast<double>(part) / static_cast<double>(of), part, of);
  return text;
}

void print(const population::StudiesSum& sum, const population::World& world, double alpha) {
  std::printf("SIMULATED: %zu studies of %zu people in each group; nothing here is about people.\n", sum.studies,
              world.per_group);
  for (const population::OutcomeSum& one : sum.primary) {
    std::printf("\n%s\n  analysed in            %s\n  significant at %.3g    %s\n", one.name.c_str(),
                share_text(one.analysed, sum.studies).c_str(), alpha,
                share_text(one.significant, one.analysed).c_str());
    if (one.truth) std::printf("  %s, true          %.4g\n", one.estimate_name.c_str(), *one.truth);
    if (one.analysed > 0)
      std::printf("  mean of the estimates  %.4g\n", one.sum_of_estimates / static_cast<double>(one.analysed));
    std::printf("  interval has the truth %s\n", share_text(one.covered, one.with_interval).c_str());
    if (one.with_interval > 0)
      std::printf("  its mean width         %.4g\n", one.sum_of_widths / static_cast<double>(one.with_interval));
  }
}

int run_study_simulate(const Arguments& arguments) {
  const auto text = read_text_of(arguments, "PLAN.json", kMostPlanBytes);
  if (!text) return refuse(text.error());
  auto plan = study::plan_from_json(*text);
  if (!plan) return refuse(plan.error());
  if (auto problems = study::problems_of(*plan); !problems.empty())
    return refuse(
        {"bad_study_plan", "the plan asks for something that is not measured today", std::move(problems)});
  plan->people = study::People::simulated;  // whatever it is planned for: these are
  const population::World world = world_of(arguments, *plan);
  const auto studies = static_cast<std::size_t>(arguments.whole("--studies", 1000, 1, 1'000'000));
  const auto truth = static_cast<std::size_t>(arguments.whole("--truth-people", 20'000, 100, 1'000'000));
  const auto seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  for (const auto* outcomes : {&plan->primary, &plan->secondary})
    for (const study::Outcome& one : *outcomes)
      if (one.case_id != surrogate->mark().case_id)
        return refuse({"other_surrogate", "the surrogate is for another case than the plan's outcomes"});
  if (arguments.has("--out"))
    if (const auto written =
            write_study(arguments.text("--out"), population::simulated_study(*plan, world, *surrogate, seed, 1));
        !written)
      return refuse(written.error());
  const auto sum = population::simulate_studies(*plan, world, *surrogate, seed, studies, truth);
  if (arguments.has("--json"))
    std::fputs(json_of_studies(sum, world).c_str(), stdout);
  else
    print(sum, world, plan->alpha);
  return kDone;
}

constexpr Option kSimulateOptions[] = {
    {"--surrogate", "FILE.json", "what `seldinger surrogate fit` wrote for the plan's case"},
    {"--shift", "GROUP=X",
     "shift of a group's abilities in standard deviations, or novice, intermediate, expert; once for every group "
     "of the plan",
     true},
    {"--per-group", "N", "people in each group; default the plan's"},
    {"--studies", "N", "how many studies; default 1000"},
    {"--sites", "N", "sites among which people are divided; default 1"},
    {"--devices", "N", "devices at each site; default 1"},
    {"--raters", "N", "raters, who rate every attempt; default none"},
    {"--seed", "N", "for everything that is drawn at random; default 1"},
    {"--truth-people", "N", "people in each group that give the true value; default 20000"},
    {"--out", "DIR", "a new folder for the first study's people, metrics, ratings and answers as CSV"},
    kJson};

}  // namespace

Command study_simulate_command() {
  return {.name = "study simulate",
          .positionals = "PLAN.json",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kSimulateOptions,
          .summary = "Runs a plan's analysis in thousands of simulated studies: power, size, coverage, width.",
          .run = &run_study_simulate};
}

}  // namespace seldinger::app
