// What is said of arms to the person at the desk, in words: how they are, what a check or a calibration asks for
// next, and what came of it.
#pragma once

#include <string>
#include <vector>

#include "app/hands/arms_seen.h"
#include "sim/base/result.h"
#include "sim/devices/arms/arm_check.h"
#include "sim/devices/arms/calibration.h"
#include "sim/devices/arms/haply.h"
#include "sim/devices/arms/point_taking.h"

namespace seldinger::app {

// One line; `ids`: which arm this hand's is.
std::string arm_words(const ArmSeen& arm, const devices::HaplyIds& ids, const devices::HaplyStatus& status);

struct CheckLine {
  enum class State { open, holds, fails } state = State::open;
  std::string words;
};
std::string check_asks(const devices::ArmCheck& check);  // what the hand is to do now, or how it ended
std::vector<CheckLine> check_lines(const devices::ArmCheck& check);

// "a: the cross, its left end".
std::string point_words(std::size_t point);
std::string taking_asks(const devices::PointTaking& taking);

// Whether it is good enough, and in numbers why, or why not.
std::string calibration_words(const base::Result<devices::Calibration>& calibration);

}  // namespace seldinger::app
