// What the window answers to each act, in words: what was done, where and how far.
#pragma once

#include <string>

#include "app/window/hands/person_attempt.h"
#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/engine/tick.h"

namespace seldinger::app {

// How long after it a fire flashes at the picture, by the attempt's time (design).
inline constexpr double kFlashS = 0.7;

// What mouse and keys hold, with the key that takes the other tool where there is one.
std::string in_hand_words(const Seen& seen, cases::Modality modality);
// "fired, 22 mm": how far the tip was thrown; of a needle that throws nothing, what was said with the trigger.
std::string fire_words(const cases::Instrument& instrument);
// The same as an answer to the trigger.
std::string fired_answer(const cases::Instrument& instrument);

// What an answer to what was said depends on.
struct Said {
  cases::EventKind kind = cases::EventKind::none;
  double planned_mm = 0.0;           // of note_plan; 0: without
  bool flipped = false;              // the picture: its marker is on the right
  bool needle_in = false;            // in the body
  bool core = false;                 // the needle is one: what has a stylet is its introducer
  haptics::Introducer introducer{};  // before it was said
};
std::string said_words(const Said& said);
// An answer to what is for a patient alone, at a phantom; of a nick, that there is no skin to cut. Empty: a phantom
// is told it, too.
std::string phantom_words(cases::EventKind kind);
// Where there is a depth to set beside it, a plan without one is not noted; these words say so.
bool depth_is_missing(cases::EventKind kind, double planned_mm, cases::Modality modality);
std::string missing_depth_words();
// Of the newest place that is numb; CHECKs that there is one.
std::string numb_words(const engine::Moment& moment);
// Of what was given just now through a needle in tissue.
std::string deep_numb_words(const engine::Moment& moment);
// Of what was aspirated just now through a needle in tissue.
std::string aspirated_words(const cases::NeedleFlow& flow);
// Of an open needle, what runs through it now; empty: its stylet is in.
std::string flow_words(const cases::NeedleFlow& flow);
// Of what has become of the needle guide since it was asked for: taken up, put aside, or why not.
std::string guide_words(const Seen& seen, cases::Modality modality);
// How the arms are: what stands in the way first.
struct ArmsSaid {
  std::string words;
  bool warns = false;
};
ArmsSaid arms_words(const ArmsHeld& arms);
// The same of one of them, for the trace: "lost", "late", "at_limit" or "ok".
const char* arm_state(const ArmsHeld& arms, haptics::Side side);
// Of a patient who was asked to hold the breath; empty: none was, or it is over.
std::string breath_words(const cases::PatientBreath& breath);

}  // namespace seldinger::app
