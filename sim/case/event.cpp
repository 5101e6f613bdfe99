#include "sim/case/event.h"

namespace seldinger::cases {
namespace {

using enum EventKind;
using enum EventSource;

constexpr EventInfo kKinds[] = {
    {sign_in, trainee, "sign_in", "signed in", "identity, consent, imaging, allergy and coagulation are checked"},
    {proceed, trainee, "proceed", "decided to proceed", "the puncture is to be done now"},
    {defer, trainee, "defer", "deferred", "the puncture is not to be done now"},
    {probe_checked, trainee, "probe_checked", "checked the probe's orientation",
     "the right probe is chosen, and which side of the picture is which is known"},
    {note_plan, trainee, "note_plan", "noted entry and depth", "planned entry and depth are read off and kept"},
    {aspirate, trainee, "aspirate", "aspirated", "the anaesthetic's needle is shown to be in no vessel"},
    {anaesthetic, trainee, "anaesthetic", "gave local anaesthetic",
     "skin and way are numb where the needle points at the skin, and 15 mm about it"},
    {nick, trainee, "nick", "nicked the skin", "the skin is cut where the needle points at it"},
    {breath_hold_request, trainee, "breath_hold_request", "asked to hold the breath",
     "the patient is asked to hold the breath"},
    {breathe_again, trainee, "breathe_again", "let breathe again", "the patient may breathe again"},
    {depth_measured, trainee, "depth_measured", "measured a depth",
     "calipers were set in the picture from the skin down, and tell how deep they end"},
    {sign_out, trainee, "sign_out", "signed out", "what was done, counted and to be watched is told"},
    {cough, mentor, "cough", "the patient coughs", "a mentor lets the patient cough"},
    {bleeding, mentor, "bleeding", "bleeding", "a mentor lets the puncture bleed"},
    {pressure_drop, mentor, "pressure_drop", "the blood pressure drops", "a mentor lets the blood pressure drop"},
    {pain_skin, patient, "pain_skin", "pain: skin not numb", "the skin was punctured where it is not numb"},
    {pain_bone, patient, "pain_bone", "pain: bone", "the needle met bone"},
    {breath_held, patient, "breath_held", "holds the breath", "the patient has begun to hold the breath"},
    {breath_lost, patient, "breath_lost", "breathes again", "the patient could hold the breath no longer"},
    {resumed, workstation, "resumed", "went on after an interruption",
     "the program had ended too early, and the attempt goes on from what was stored of it"},
    {calipers_recorded, workstation, "calipers_recorded", "records what is measured",
     "from here on depths that are measured or planned are recorded; before, none of them is known"},
};

}  // namespace

std::span<const EventInfo> event_kinds() noexcept {
  return kKinds;
}

const EventInfo* find_event(EventKind kind) noexcept {
  for (const EventInfo& info : kKinds)
    if (info.kind == kind) return &info;
  return nullptr;
}

std::optional<EventKind> event_from(std::string_view name) noexcept {
  for (const EventInfo& info : kKinds)
    if (info.name == name) return info.kind;
  return std::nullopt;
}

std::string_view name_of(EventSource source) noexcept {
  constexpr std::string_view kNames[] = {"trainee", "mentor", "patient", "workstation"};
  return kNames[static_cast<std::size_t>(source)];
}

}  // namespace seldinger::cases
