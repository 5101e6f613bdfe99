// bench, goals and haptics stability: start seldinger-measure, a program of its own (docs/decisions/0038).
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/bench_stages.h"
#include "app/commands.h"
#include "sim/base/failure.h"

namespace seldinger::app {

int run_measure(const Arguments& arguments) {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw base::Failure("measure_not_started", "this program cannot tell where it lies");
  const std::string program = own.parent_path() / "seldinger-measure";

  std::vector<std::string> words = {program};
  std::istringstream name(arguments.command());
  for (std::string word; name >> word;) words.push_back(word);
  words.insert(words.end(), arguments.words().begin(), arguments.words().end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  ::execv(program.c_str(), argv.data());  // returns only when it failed
  if (errno == ENOENT)
    throw base::Failure("measure_not_built",
                        "benchmarks and goals are a program of their own: build it with ./run measure");
  throw base::Failure("measure_not_started", "the program of benchmarks and goals cannot be started");
}

namespace {

constexpr Option kBenchOptions[] = {
    {"--stage", "a,b", kBenchStageHelp.data()},
    {"--quick", nullptr, "fewer repetitions"},
    {"--ct", "SOURCE",
     "the CT for import, and the patient for xray, ultrasound and room; default the built-in case"},
    {"--volume", "FILE", "xray: in place of the projector phantom"},
    {"--out", "DIR", "where results.csv goes"}};

constexpr Option kGoalsOptions[] = {
    {"--method", "scatterers|lattice|thesis|all", "how speckle is made; default scatterers"},
    {"--probe", "NAME", "C5-2v, L11-5v, thesis-linear or thesis-curved; default all"},
    {"--quality", "fast|reference",
     "reference: 512 beams, 2048 samples, three times the scatterers, against the narrower tolerances; default "
     "fast"},
    {"--quick", nullptr, "fewer frames, so noisier figures"},
    kJson};

}  // namespace

Command bench_command() {
  return {.name = "bench",
          .options = kBenchOptions,
          .summary = "Measures time and error for every stage that offers a choice.",
          .run = &run_measure};
}

Command goals_ultrasound_command() {
  return {
      .name = "goals ultrasound",
      .options = kGoalsOptions,
      .summary =
          "Compares the ultrasound picture with closed-form solutions, goal by goal; 1 when scatterers miss one.",
      .run = &run_measure};
}

Command goals_haptics_command() {
  return {
      .name = "goals haptics",
      .options = kJsonOnly,
      .summary =
          "Compares what the hand feels with published lines and with simulated hands; 1 when a goal is missed.",
      .run = &run_measure};
}

Command haptics_stability_command() {
  return {.name = "haptics stability",
          .options = kJsonOnly,
          .summary =
              "Measures with simulated hands and devices whether forces settle; 1 when they do not "
              "(docs/stability.md).",
          .run = &run_measure};
}

}  // namespace seldinger::app
