// Does a law come to rest under a hand? One trial on the rig: the device is put somewhere by an ideal hand, then
// left to a hand of the rig, and watched (docs/touch.md).
#pragma once

#include <functional>

#include "sim/haptics/hand_rig.h"

namespace seldinger::measure {

// Depth in mm, as the encoder tells it, once a tick → force in N, > 0 outwards.
using ForceLaw = std::function<double(double)>;

struct Trial {
  haptics::ArmModel device;
  haptics::Hand hand;
  double from_mm = -1.0, to_mm = 0.0;  // moved there at 20 mm/s by an ideal hand, from one to the other,
  double back_mm = 0.0;                // and back by so much
  double speed_mm_s = 0.0;             // then let go at this speed into the hand, which holds on to that place
  double push_n = 1.0;                 // and pushes inwards,
  double drive_mm_s = 0.0;             // its place going on at this speed
  double seconds = 3.0, watched_s = 0.5;
};

struct Settling {
  double position_mm = 0.0,
         force_n = 0.0;        // peak to peak while watched, at the end; NaN when anything was not finite
  double unrest_n = 0.0;       // standard deviation of the motors' force from a straight line, while watched
  double rest_s = 0.0;         // when it was last further than a count from where it ends
  double least_work_mj = 0.0;  // the least that hands had put in at any tick, since from_mm
  double most_step_n = 0.0;    // of the law's force from tick to tick, after the ideal hand

  // At rest but for one count of the encoder, and of the force by no more than a tenth of a newton
  // (docs/touch.md).
  bool settled(const haptics::ArmModel& device) const noexcept;
};

Settling settle(const Trial& trial, const ForceLaw& law);

}  // namespace seldinger::measure
