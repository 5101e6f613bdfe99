#include "assessment/signals/needs.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "assessment/signals/signals.h"
#include "sim/case/hand_kind.h"

namespace seldinger::assessment {
namespace {

using cases::StructureRule;

bool has(const Signals& signals, StructureRule rule) {
  return std::any_of(signals.setting.structures.begin(), signals.setting.structures.end(),
                     [&](const cases::Structure& one) { return one.rule == rule; });
}

// Those of the manner; needs() asks the same of an attempt.
Needs unmet(const Manner& manner) {
  const bool xray = manner.modality == cases::Modality::xray;
  Needs bits = 0;
  if (!xray) bits |= kXray;
  if (manner.modality != cases::Modality::ultrasound) bits |= kUltrasound;
  if (xray) bits |= kPicturePlane;
  if (!xray && manner.approach != cases::Approach::in_plane) bits |= kInPlane;
  if (xray || manner.approach != cases::Approach::out_of_plane) bits |= kOutOfPlane;
  if (manner.instrument != cases::InstrumentKind::core) bits |= kCoreNeedle;
  return bits;
}

template <Needs need>
bool of_manner(const Signals& signals) {
  return (unmet(manner_of(signals.setting)) & need) == 0;
}
template <StructureRule rule>
bool of_structures(const Signals& signals) {
  return has(signals, rule);
}

// Poses from a file tell what a picture would have shown, not what the beam did.
bool beam_recorded(const Signals& signals) {
  return std::all_of(signals.frames.begin(), signals.frames.end(),
                     [](const cases::FrameTruth& frame) { return !frame.live || frame.beam.has_value(); });
}
bool near_plane_recorded(const Signals& signals) {
  return std::all_of(signals.frames.begin(), signals.frames.end(),
                     [](const cases::FrameTruth& frame) { return !frame.live || frame.near_plane.has_value(); });
}
bool in_tissue(const Signals& signals) {
  return std::any_of(signals.passages.begin(), signals.passages.end(),
                     [](const cases::SkinPassage& passage) { return passage.in_body; });
}

bool calipers_recorded(const Signals& signals) {
  return signals.events &&
         std::any_of(signals.events->begin(), signals.events->end(),
                     [](const cases::Event& event) { return event.kind == cases::EventKind::calipers_recorded; });
}

bool trouble_made(const Signals& signals) {
  return signals.events &&
         std::any_of(signals.events->begin(), signals.events->end(), [](const cases::Event& event) {
           const cases::EventInfo* info = cases::find_event(event.kind);
           return info != nullptr && info->source == cases::EventSource::mentor;
         });
}

// Under a guide the needle's line is the guide's. Taken up in the air and put aside again it led nothing.
bool freehand(const Signals& signals) {
  if (!signals.events) return true;
  const std::vector<cases::EventSpan> guided = cases::guided_times(*signals.events);
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (signals.passages[i].in_body &&
        std::any_of(guided.begin(), guided.end(), [t_s = signals.poses[i].t_s](const cases::EventSpan& span) {
          return span.from_s <= t_s && t_s < span.to_s;
        }))
      return false;
  return true;
}

// Whether an arm led the needle whenever it was in tissue; a force that a mouse cannot give is felt by nobody, and
// a simulated operator leads a virtual arm.
bool arm_led(const Signals& signals) {
  if (!signals.events) return true;
  std::optional<cases::HandKind> hand;
  bool punctured = false;
  auto event = signals.events->begin();
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    for (; event != signals.events->end() && event->t_s <= signals.poses[i].t_s; ++event)
      if (const auto by = cases::led_by(event->kind); by && by->tool == cases::LedTool::needle) hand = by->hand;
    if (!signals.passages[i].in_body) continue;
    if (hand && *hand != cases::HandKind::arm) return false;
    punctured = true;
  }
  return punctured || !hand || *hand == cases::HandKind::arm;
}

constexpr NeedInfo kNeeds[] = {
    {kXray, "fluoroscopy", "not_xray", &of_manner<kXray>},
    {kUltrasound, "ultrasound", "not_ultrasound", &of_manner<kUltrasound>},
    {kPicturePlane, "a slice or ultrasound", "not_meaningful_under_xray", &of_manner<kPicturePlane>},
    {kInPlane, "in plane (or fluoroscopy)", "not_meaningful_out_of_plane", &of_manner<kInPlane>},
    {kOutOfPlane, "out of plane", "not_meaningful_in_plane", &of_manner<kOutOfPlane>},
    {kCoreNeedle, "a core needle", "not_a_core_needle", &of_manner<kCoreNeedle>},
    {kEndpoint, "an endpoint", "no_endpoint", [](const Signals& s) { return s.endpoint.has_value(); }},
    {kTarget, "a target", "no_target", [](const Signals& s) { return s.setting.target.has_value(); }},
    {kPlan, "a planned entry", "no_plan", [](const Signals& s) { return s.setting.plan.has_value(); }},
    {kForces, "recorded forces", "no_device", [](const Signals& s) { return !s.forces.empty(); }},
    {kArmLed, "an arm that leads the needle", "no_arm", &arm_led},
    {kFreehand, "no needle guide in tissue", "needle_guide_was_on", &freehand},
    {kNoGo, "a structure to stay out of", "no_nogo_structure",
     [](const Signals& s) {
       return has(s, StructureRule::critical) || has(s, StructureRule::major) || has(s, StructureRule::advisory);
     }},
    {kNoGoCritical, "a critical structure", "no_critical_structure", &of_structures<StructureRule::critical>},
    {kNoGoMajor, "a major structure", "no_major_structure", &of_structures<StructureRule::major>},
    {kNoGoAdvisory, "an advisory structure", "no_advisory_structure", &of_structures<StructureRule::advisory>},
    {kMustCross, "a structure to be crossed", "no_must_cross_structure", &of_structures<StructureRule::must_cross>},
    {kOrgan, "the target's organ", "no_organ_structure", &of_structures<StructureRule::organ>},
    {kLumen, "the lumen to be reached", "no_target_structure", &of_structures<StructureRule::target>},
    {kPatient, "a patient", "no_patient",
     [](const Signals& s) { return s.setting.subject == cases::Subject::patient; }},
    {kBreathes, "a patient who breathes", "patient_lies_still",
     [](const Signals& s) { return s.setting.breathes; }},
    {kYields, "tissue that yields", "tissue_lies_still", [](const Signals& s) { return s.setting.yields; }},
    {kSkin, "skin", "no_skin", [](const Signals& s) { return !s.setting.skin->empty(); }},
    {kPictures, "pictures", "no_picture", [](const Signals& s) { return !s.frames.empty(); }},
    {kBeam, "the beam's record", "beam_not_recorded", &beam_recorded},
    {kNearPlane, "what was near the plane", "near_plane_not_recorded", &near_plane_recorded},
    {kMotion, "more than gaps", "only_gaps", [](const Signals& s) { return !s.only_gaps(); }},
    {kTissue, "the tip in tissue", "never_in_tissue", &in_tissue},
    {kEvents, "what was said", "events_not_recorded", [](const Signals& s) { return s.events.has_value(); }},
    {kCalipers, "what calipers measured", "calipers_not_recorded", &calipers_recorded},
    {kTrouble, "a mentor's event", "no_such_event", &trouble_made},
    {kProbeChosen, "a probe that was chosen", "probe_given",
     [](const Signals& s) { return s.setting.probe_suits.has_value(); }},
    {kDecision, "the right decision", "no_right_decision",
     [](const Signals& s) { return s.setting.defer_is_right.has_value(); }},
};

}  // namespace

std::span<const NeedInfo> needs() {
  return kNeeds;
}

Needs unmet_needs(const Signals& signals) {
  Needs bits = 0;
  for (const NeedInfo& info : kNeeds)
    if (!info.met(signals)) bits |= info.need;
  return bits;
}

bool applies(Needs needs, const Manner& manner) {
  return (needs & unmet(manner)) == 0;
}

bool absent_from_case(std::string_view reason) {
  constexpr Needs of_case = kTarget | kPlan | kNoGo | kNoGoCritical | kNoGoMajor | kNoGoAdvisory | kMustCross |
                            kOrgan | kLumen | kSkin | kForces | kArmLed | kDecision | kBreathes | kYields |
                            kPatient | kProbeChosen;
  return std::any_of(std::begin(kNeeds), std::end(kNeeds),
                     [&](const NeedInfo& info) { return (info.need & of_case) != 0 && reason == info.reason; });
}

}  // namespace seldinger::assessment
