// What a metric needs before it means anything: as data, so that measuring, documents and pages ask the same.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sim/case/case.h"

namespace seldinger::assessment {

struct Signals;

// How an attempt was made, as far as it decides which metrics mean something.
struct Manner {
  cases::Modality modality = cases::Modality::mpr;
  cases::Approach approach = cases::Approach::in_plane;  // says nothing under xray
  cases::InstrumentKind instrument = cases::InstrumentKind::access;
};

using Needs = std::uint64_t;  // Need, or-ed

enum Need : Needs {
  // Of the manner.
  kXray = 1U << 0U,
  kUltrasound = 1U << 1U,
  kPicturePlane = 1U << 2U,  // any but xray: a projection has no plane
  kInPlane = 1U << 3U,       // or xray
  kOutOfPlane = 1U << 4U,
  kCoreNeedle = 1U << 5U,
  // Of the case or the desk.
  kTarget = 1U << 6U,
  kPlan = 1U << 7U,
  kNoGo = 1U << 8U,  // a structure to stay out of, of any severity
  kNoGoCritical = 1U << 9U,
  kNoGoMajor = 1U << 10U,
  kNoGoAdvisory = 1U << 11U,
  kMustCross = 1U << 12U,
  kOrgan = 1U << 13U,
  kLumen = 1U << 14U,
  kSkin = 1U << 15U,
  kForces = 1U << 16U,
  // Of the recording.
  kEndpoint = 1U << 17U,
  kPictures = 1U << 18U,
  kBeam = 1U << 19U,
  kNearPlane = 1U << 20U,
  kMotion = 1U << 21U,  // more than gaps
  kTissue = 1U << 22U,  // the tip was in the body
  kEvents = 1U << 23U,
  kTrouble = 1U << 24U,  // an event of a mentor's
  // Of the case.
  kDecision = 1U << 25U,
  kBreathes = 1U << 26U,
  kYields = 1U << 27U,
  kPatient = 1U << 28U,
  // Of the hands: an attempt whose recorder noted nothing of them (cases::EventInfo::noted) meets both.
  kFreehand = 1U << 29U,
  kArmLed = 1U << 30U,
  // Of the recording.
  kCalipers = 1U << 31U,
  // Of the case.
  kProbeChosen = Needs{1} << 32U,
};

struct NeedInfo {
  Needs need;
  const char* words;   // "a core needle"
  const char* reason;  // stable snake_case, of the null where it is not met
  bool (*met)(const Signals&);
};

// In the order in which they are asked.
std::span<const NeedInfo> needs();

// Those of all needs that an attempt does not meet, or-ed.
Needs unmet_needs(const Signals& signals);

// Whether something with these needs could have a value when practising in this manner. What could not is not
// shown to people.
bool applies(Needs needs, const Manner& manner);

// Whether a null with this reason says what the case or the desk does not have, whatever was done.
bool absent_from_case(std::string_view reason);

}  // namespace seldinger::assessment
