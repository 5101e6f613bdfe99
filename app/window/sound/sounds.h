// What is heard in the room, and when: one table from what changed between two looks at an attempt to the sounds
// that this makes. Pure; who plays them is app/window/sound/speaker.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "app/window/hands/person_attempt.h"

namespace seldinger::app {

enum class Sound {
  touch,         // the probe comes to lie on the skin
  prick,         // the needle goes through the skin
  pop,           // a capsule opens before the needle
  bone,          // the needle meets bone
  shot,          // a core needle is fired
  ow,            // skin that is not numb
  groan,         // bone
  cough,         // a mentor's
  breath_in,     // the breath is held now
  breath_out,    // it could be held no longer
  alarm_high,    // the patient's: bleeding, a pressure that drops
  alarm_medium,  // the workstation's: an arm was lost
  beam_timer,    // the fluoroscope's: five more minutes of beam
};
inline constexpr int kSounds = 13;

// Of a group, one sound at a time is heard: a patient has one voice, a monitor one loudspeaker.
enum class Voice { hands, patient, alarm };

struct SoundInfo {
  Sound sound;
  const char* name;  // as traces write it: "breath_in"
  Voice voice;
  double level;  // its highest value at full loudness; all that sound at once stay below 1 (design)
};

// In the enumeration's order.
std::span<const SoundInfo, kSounds> sound_infos() noexcept;
const SoundInfo& info_of(Sound sound) noexcept;

// A sound that is to be heard now; `loudness`: of its level, 0 to 1.
struct Sounding {
  Sound sound;
  double loudness = 1.0;
  bool operator==(const Sounding&) const = default;
};

// A touch lighter than this is not heard: a probe in gel, a hand that trembles (design).
inline constexpr double kHeardTouchN = 0.3;
// A capsule that takes so much is heard in full (design; the kidney's, haptics' tissue table, takes about as much).
inline constexpr double kLoudCapsuleN = 3.0;
// 21 CFR 1020.32 (h)(2)(ii): a signal for each passage of 5 minutes of irradiation.
inline constexpr double kBeamTimerS = 300.0;

// What happened from one look to the next, of the same attempt; nothing where `now` is no later than `before`.
std::vector<Sounding> sounds_of(const Seen& before, const Seen& now, cases::InstrumentKind instrument);

}  // namespace seldinger::app
