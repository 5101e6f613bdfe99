// The sounds themselves, made by formulas: no file is read.
#pragma once

#include <vector>

#include "app/window/sound/sounds.h"

namespace seldinger::app {

inline constexpr int kSoundHz = 44100;

// At kSoundHz, one channel, the highest value 1 or −1; the same on every call.
std::vector<float> wave_of(Sound sound);

// Pulses of an alarm: IEC 60601-1-8, tables of the pulse and the burst. A high priority has ten in two bursts, a
// medium one has three.
struct AlarmPulse {
  double begin_s, length_s, tone_hz;
};
std::vector<AlarmPulse> alarm_pulses(Sound alarm);  // alarm_high or alarm_medium (CHECKed)

}  // namespace seldinger::app
