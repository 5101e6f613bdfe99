// surrogate fit, check, effects.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/acting/acting.h"
#include "app/attempts/this_program.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/shard.h"
#include "app/cli/words.h"
#include "app/population/agreement_text.h"
#include "app/population/effects_text.h"
#include "app/population/open_surrogate.h"
#include "app/population/population_json.h"
#include "assessment/population/agreement.h"
#include "session/attempt/simulation.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

// Of each attempt that it is held against.
constexpr std::size_t kDrawsEach = 20;
constexpr std::uint64_t kDrawSeed = 1;

// A surrogate is asked about groups between and a little beyond those that there are.
std::vector<population::Group> fitted_groups() {
  std::vector<population::Group> groups;
  for (const double shift : {-0.6, 0.0, 0.4, 0.8, 1.2, 1.8}) groups.push_back(population::shifted_group(shift));
  return groups;
}

std::vector<population::Group> groups_of(const Arguments& arguments, std::vector<population::Group> groups) {
  if (!arguments.has("--group")) return groups;
  groups.clear();
  for (const std::string& text : arguments.all("--group")) {
    const auto group = group_from(text);
    if (!group) throw UsageError("--group is novice, intermediate, expert or a number of -5 to 5");
    groups.push_back(*group);
  }
  return groups;
}

// What is about simulating, where attempts come from files.
void refuse_beside(const char* files, std::vector<const char*> others, const Arguments& arguments) {
  for (const char* option : {"--case", "--library", "--group", "--attempts", "--seed", "--jobs"})
    others.push_back(option);
  for (const char* option : others)
    if (arguments.has(option)) throw UsageError(std::string(option) + " does not go with " + files);
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

// Simulated now, with the mark that they have for it.
base::Result<population::Surrogate> fitted_now(const Arguments& arguments,
                                               const std::vector<population::Group>& groups) {
  auto made = ready(arguments, 600, static_cast<int>(population::Surrogate::kFewest), 1);
  if (!made) return made.error();
  const Numbered people = numbered(shard_of(arguments), made->attempts);
  auto points = simulated_points(made->simulation, groups, made->seed, people, made->jobs);
  if (!points) return points.error();
  return population::Surrogate::fit(mark_of_case(made->library, made->simulation), std::move(*points));
}

// Of files that `surrogate fit` wrote of parts of them, all of one mark.
base::Result<population::Surrogate> fitted_from_files(const Arguments& arguments) {
  std::optional<population::SurrogateMark> mark;
  std::vector<population::SimulatedPoint> points;
  for (const std::string& file : arguments.all("--from")) {
    const auto part = surrogate_in("--from", file);
    if (!part) return part.error();
    if (!mark) mark = part->mark();
    if (const std::string differs = difference(*mark, part->mark()); !differs.empty())
      return base::Error{"other_surrogate", "the attempts of " + shown(file) + " are of " + differs};
    if (!population::add_once(part->attempts(), points))
      return base::Error{"other_surrogate", "one attempt is in two files, and differs: " + shown(file)};
  }
  return population::Surrogate::fit(std::move(*mark), std::move(points));
}

int run_surrogate_fit(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".json"});
  const auto groups = groups_of(arguments, fitted_groups());
  const bool from_files = arguments.has("--from");
  // It takes minutes of attempts to make one; and a file that is read by --from is no place for their sum.
  if (std::error_code failed; std::filesystem::exists(std::filesystem::symlink_status(out, failed)))
    return refuse({"exists", "--out: there is already something of that name"});
  if (from_files) refuse_beside("--from", {"--shard"}, arguments);
  const auto surrogate = from_files ? fitted_from_files(arguments) : fitted_now(arguments, groups);
  if (!surrogate) return refuse(surrogate.error());
  write_file(out, surrogate->to_json());
  if (arguments.has("--json"))
    std::fputs(json_of_fit(*surrogate).c_str(), stdout);
  else
    std::printf("fitted to %zu simulated attempts; `seldinger surrogate check` tells how well\n",
                surrogate->attempts().size());
  return kDone;
}

struct Level {
  std::string name;
  std::vector<population::SimulatedPoint> points;
};

// Of files that `surrogate fit` wrote: attempts that were simulated whole before.
base::Result<std::vector<Level>> levels_of_files(const Arguments& arguments,
                                                 const population::Surrogate& surrogate) {
  std::vector<Level> levels;
  for (const std::string& file : arguments.all("--against")) {
    const auto other = surrogate_in("--against", file);
    if (!other) return other.error();
    if (const std::string differs = difference(surrogate.mark(), other->mark()); !differs.empty())
      return base::Error{"other_surrogate", "the attempts of --against are of " + differs};
    levels.push_back({std::filesystem::path(file).stem().string(), other->attempts()});
  }
  return levels;
}

base::Result<std::vector<Level>> levels_of_groups(Ready& made, const std::vector<population::Group>& groups,
                                                  const population::Surrogate& surrogate) {
  if (const std::string other = difference(surrogate.mark(), mark_of_case(made.library, made.simulation));
      !other.empty())
    return base::Error{"other_surrogate", "the surrogate is of " + other};
  std::vector<Level> levels;
  for (const population::Group& group : groups) {
    auto points = simulated_points(made.simulation, {group}, made.seed, {1, made.attempts}, made.jobs);
    if (!points) return points.error();
    levels.push_back({group.name, std::move(*points)});
  }
  return levels;
}

int run_surrogate_check(const Arguments& arguments) {
  const auto groups =
      groups_of(arguments, {*population::named_group("novice"), *population::named_group("intermediate"),
                            *population::named_group("expert")});
  std::optional<Ready> simulated_by;
  if (arguments.has("--against")) {
    refuse_beside("--against", {}, arguments);
  } else {
    auto simulating = ready(arguments, 500, 30, 1'000'001);
    if (!simulating) return refuse(simulating.error());
    simulated_by = std::move(*simulating);
  }
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  const auto levels =
      simulated_by ? levels_of_groups(*simulated_by, groups, *surrogate) : levels_of_files(arguments, *surrogate);
  if (!levels) return refuse(levels.error());
  for (const Level& one : *levels)
    if (population::was_fitted_to(*surrogate, one.points))
      return refuse({"known_attempts", "the surrogate was fitted to attempts of " + one.name + " itself"});
  SurrogateAgreement made;
  for (const Level& one : *levels) {
    made.levels.push_back({one.name, population::agreement_of(*surrogate, one.points, kDrawsEach, kDrawSeed)});
    if (&one != &levels->front())
      made.effects.push_back(
          {levels->front().name, one.name,
           population::effects_of(*surrogate, levels->front().points, one.points, kDrawsEach, kDrawSeed)});
  }
  std::fputs(arguments.has("--json") ? json_of_agreement(made).c_str() : text_of_agreement(made).c_str(), stdout);
  return verdict_of(made).within_chance() ? kDone : kCheckFailed;
}

int run_surrogate_effects(const Arguments& arguments) {
  std::optional<std::filesystem::path> chart;
  if (arguments.has("--chart")) chart = file_of("--chart", arguments.text("--chart"), {".svg"});
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  const auto people = static_cast<std::size_t>(arguments.whole("--people", 2000, 100, 1'000'000));
  const auto effects = simulated_effects(*surrogate, people, 1);
  if (chart) write_file(*chart, svg_of_effects(effects));
  std::fputs(arguments.has("--json") ? json_of_effects(effects).c_str() : text_of_effects(effects).c_str(), stdout);
  return kDone;
}

constexpr Option kCase{"--case", "CASE", "the case"};
constexpr Option kAgainst{
    "--against", "FILE.json",
    "instead of simulating: what `seldinger surrogate fit --group` wrote of one group; may be "
    "given many times",
    true};
constexpr Option kFile{"--surrogate", "FILE.json", "what `seldinger surrogate fit` wrote"};
constexpr Option kJobs{"--jobs", "N", "threads; default one for each core. The results are the same"};
constexpr Option kGroup{
    "--group", "GROUP",
    "who: novice, intermediate, expert or by how many standard deviations abilities are shifted; "
    "may be given many times. Default: groups from -0.6 to 1.8",
    true};
constexpr Option kFitOptions[] = {
    kLibrary,
    kCase,
    {"--attempts", "N", "to fit it to; default 600"},
    {"--seed", "N", "of the people; default 1"},
    kGroup,
    {"--shard", "I/N", "only the I-th of N parts of these attempts: N calls make them all, each once"},
    {"--from", "FILE.json",
     "instead of simulating: what `seldinger surrogate fit` wrote of a part; may be given many times. An attempt "
     "that is in several of them counts once",
     true},
    kJobs,
    {"--out", "FILE.json", "the new file"},
    kJson};
constexpr Option kCheckOptions[] = {
    kLibrary,
    kCase,
    kFile,
    {"--attempts", "N", "of each level, that it was not fitted to; default 500"},
    {"--seed", "N", "of the people; default 1000001"},
    {"--group", "GROUP", "who, as of `seldinger surrogate fit`; default novice, intermediate, expert", true},
    kAgainst,
    kJobs,
    kJson};
constexpr Option kEffectsOptions[] = {kFile,
                                      {"--people", "N", "drawn for each group; default 2000"},
                                      {"--chart", "FILE.svg", "draw them, beside published ones, into a new file"},
                                      kJson};

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
