// Players who know the way to the target to the millimetre and try to pass without doing what a case is about:
// scripts of stages, played in virtual time by tick and pictures as a simulated operator's attempt is.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/operators/plan.h"
#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/case/record/recording.h"

namespace seldinger::gaming {

// Where the probe is held; under a fluoroscope it is laid aside.
enum class Glance {
  tip,     // the picture shows the tip as well as the plan lets it
  beside,  // in plane: beside the needle's plane; out of plane: ahead of the target, where the tip never comes
};

// From where the one before ended.
struct Stage {
  // How deep the tip goes along the planned way, told from the entry or from where the trigger is to fall;
  // negative: short of it.
  enum class From { entry, target };
  From from = From::entry;
  double depth_mm = -30.0;
  double mm_s = 15.0;
  double beside_mm = 0.0;  // of the whole needle, from the planned way
  double wait_s = 0.0;     // once it is there
  Glance glance = Glance::tip;
  bool frozen = false, fire = false;
  bool two_views = false;  // under a fluoroscope: pulses from two directions while it waits
  std::vector<cases::EventKind> says = {};
};

struct Player {
  const char* name;
  const char* fault;  // why this is no pass
  std::vector<Stage> stages;
};

// Does what every case asks: the tip in the picture all the way, one puncture, the trigger in the target.
const Player& honest_player();
std::span<const Player> gaming_players();

cases::Recording play(const Player& player, const cases::Case& scene, const assessment::PuncturePlan& plan);

}  // namespace seldinger::gaming
