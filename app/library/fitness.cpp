#include "app/library/fitness.h"

#include <cmath>

namespace seldinger::app {
namespace {

// An attempt of ten minutes: half a minute under a probe is 1.3 MB when it is written out (docs/export.md).
constexpr double kLeastFreeMb = 26.0;
// The hands are moved at 1 kHz by a thread of their own, beside the one that draws.
constexpr unsigned kLeastCores = 2;

}  // namespace

const char* name_of(Fit fit) {
  switch (fit) {
    case Fit::yes:
      return "yes";
    case Fit::slowly:
      return "slowly";
    case Fit::no:
      return "no";
  }
  return "";
}

Fitness fitness_of(const Machine& machine) {
  Fitness fitness;
  const auto add = [&](Fit fit, const std::string& why) {
    if (fit != fitness.fit && fitness.fit != Fit::no) {
      fitness.fit = fit;
      if (fit == Fit::no) fitness.why.clear();  // what only slows is beside the point
    }
    if (fit == fitness.fit) fitness.why.push_back(why);
  };
  if (machine.software) add(Fit::slowly, "the processor draws the pictures: no graphics card for OpenGL 4.3");
  if (machine.cores > 0 && machine.cores < kLeastCores)
    add(Fit::slowly, "one processor core, shared by hands and pictures");
  if (!machine.display) add(Fit::no, "there is no display to open the window on");
  if (!machine.gl) add(Fit::no, "OpenGL 4.3 is not available");
  if (machine.disk_free_mb && *machine.disk_free_mb < kLeastFreeMb)
    add(Fit::no, std::to_string(std::lround(*machine.disk_free_mb)) + " MB are free for attempts, of " +
                     std::to_string(std::lround(kLeastFreeMb)) + " that one of ten minutes may take");
  return fitness;
}

}  // namespace seldinger::app
