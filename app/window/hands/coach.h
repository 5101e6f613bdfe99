// What to do next, in words, for who practises on a block of gel: hints that fade with passes. They tell what the
// picture shows already, never where a target lies that is not in it.
#pragma once

#include <string>

#include "app/window/hands/person_attempt.h"
#include "sim/devices/hands/mouse_hands.h"

namespace seldinger::app {

// `help`: as Trainer::help: 2 with how far it is and which way the hand goes there in the room as it is seen, 1
// without, 0 nothing. Empty: there is nothing to say, as in every case that is no ultrasound-guided puncture of
// gel.
std::string hint_words(const cases::Case& scene, const Seen& seen, int help, const devices::HandView& view = {});

}  // namespace seldinger::app
