// Whether somebody can train at this computer.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace seldinger::app {

struct Machine {
  bool display = false;                // a window can be opened
  bool gl = false;                     // OpenGL 4.3 can be had
  bool software = false;               // it is drawn by the processor
  unsigned cores = 0;                  // 0: not known
  std::optional<double> disk_free_mb;  // where attempts are stored
};

enum class Fit { yes, slowly, no };

struct Fitness {
  Fit fit = Fit::yes;
  std::vector<std::string> why;  // empty: yes
};

const char* name_of(Fit fit);
Fitness fitness_of(const Machine& machine);

}  // namespace seldinger::app
