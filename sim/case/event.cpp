#include "sim/case/event.h"

#include <limits>

namespace seldinger::cases {
namespace {

using enum EventKind;
using enum EventSource;

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

constexpr EventInfo kKinds[] = {
    {sign_in, trainee, "sign_in", "signed in", "identity, consent, imaging, allergy and coagulation are checked"},
    {proceed, trainee, "proceed", "decided to proceed", "the puncture is to be done now"},
    {defer, trainee, "defer", "deferred", "the puncture is not to be done now"},
    {probe_checked, trainee, "probe_checked", "checked the probe's orientation",
     "the right probe is chosen, and which side of the picture is which is known"},
    {note_plan, trainee, "note_plan", "noted entry and depth", "planned entry and depth are read off and kept"},
    {aspirate, trainee, "aspirate", "aspirated",
     "it is looked for blood before anaesthetic is given: with the anaesthetic's own needle, or, with a length, "
     "through "
     "the needle so deep in tissue"},
    {anaesthetic, trainee, "anaesthetic", "gave local anaesthetic",
     "numb are 15 mm about where the needle points at the skin, or, with a length, about its tip so deep in "
     "tissue"},
    {nick, trainee, "nick", "nicked the skin", "the skin is cut where the needle points at it"},
    {breath_hold_request, trainee, "breath_hold_request", "asked to hold the breath",
     "the patient is asked to hold the breath"},
    {breathe_again, trainee, "breathe_again", "let breathe again", "the patient may breathe again"},
    {depth_measured, trainee, "depth_measured", "measured a depth",
     "calipers were set in the picture from the skin down, and tell how deep they end"},
    {stylet_out, trainee, "stylet_out", "drew the stylet",
     "the needle is open: what its tip lies in runs back; of a core needle it is the introducer's, which stays "
     "where it is"},
    {stylet_in, trainee, "stylet_in", "put the stylet back",
     "the needle is closed again; a core needle's introducer is taken up, or pushed on"},
    {inject, trainee, "inject", "injected contrast",
     "2 ml of contrast are pushed through the open needle, in 2 s, into whatever its tip lies in"},
    {sign_out, trainee, "sign_out", "signed out", "what was done, counted and to be watched is told"},
    {cough, mentor, "cough", "the patient coughs", "a mentor lets the patient cough"},
    {bleeding, mentor, "bleeding", "bleeding", "a mentor lets the puncture bleed"},
    {pressure_drop, mentor, "pressure_drop", "the blood pressure drops", "a mentor lets the blood pressure drop"},
    {pain_skin, patient, "pain_skin", "pain: skin not numb", "the skin was punctured where it is not numb"},
    {pain_bone, patient, "pain_bone", "pain: bone", "the needle met bone"},
    {breath_held, patient, "breath_held", "holds the breath", "the patient has begun to hold the breath"},
    {breath_lost, patient, "breath_lost", "breathes again", "the patient could hold the breath no longer"},
    {urine_returns, patient, "urine_returns", "urine comes back", "urine has run up the open needle to its hub"},
    {bile_returns, patient, "bile_returns", "bile comes back", "bile has run up the open needle to its hub"},
    {dark_blood_returns, patient, "dark_blood_returns", "dark blood comes back",
     "a vein's blood has run up the open needle to its hub"},
    {bright_blood_returns, patient, "bright_blood_returns", "bright blood spurts back",
     "an artery's blood has run up the open needle to its hub"},
    {fluid_returns, patient, "fluid_returns", "fluid comes back",
     "the fluid of a cyst, an abscess or an effusion has run up the open needle to its hub"},
    {resumed, workstation, "resumed", "went on after an interruption",
     "the program had ended too early, and the attempt goes on from what was stored of it", false, true},
    {paused, workstation, "paused", "paused", "the attempt's clock stood still here, by the trainee's wish", true,
     true},
    {guide_on, workstation, "guide_on", "took up the needle guide",
     "from here on the needle is brought to its guide", true, true},
    {guide_reached, workstation, "guide_reached", "needle in the guide", "from here on the guide leads the needle",
     true, true},
    {guide_off, workstation, "guide_off", "put the needle guide aside", "from here on the needle is free", true},
    {return_begun, workstation, "return_begun", "tools go back to the start",
     "from here on the program brings both tools back to where they began", true, true},
    {return_ended, workstation, "return_ended", "tools are free again",
     "the tools are where they began, or the hand has moved one on the way", true, true},
    {needle_by_mouse, workstation, "needle_by_mouse", "mouse and keys lead the needle",
     "from here on mouse and keys lead the needle", true, true},
    {needle_by_gamepad, workstation, "needle_by_gamepad", "a gamepad leads the needle",
     "from here on a gamepad leads the needle", true, true},
    {needle_by_space_mouse, workstation, "needle_by_space_mouse", "a 3-D mouse leads the needle",
     "from here on a 3-D mouse leads the needle", true, true},
    {needle_by_arm, workstation, "needle_by_arm", "an arm leads the needle",
     "from here on an arm with force feedback leads the needle", true, true},
    {probe_by_mouse, workstation, "probe_by_mouse", "mouse and keys lead the probe",
     "from here on mouse and keys lead the probe", true, true},
    {probe_by_gamepad, workstation, "probe_by_gamepad", "a gamepad leads the probe",
     "from here on a gamepad leads the probe", true, true},
    {probe_by_space_mouse, workstation, "probe_by_space_mouse", "a 3-D mouse leads the probe",
     "from here on a 3-D mouse leads the probe", true, true},
    {probe_by_arm, workstation, "probe_by_arm", "an arm leads the probe",
     "from here on an arm with force feedback leads the probe", true, true},
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

std::vector<EventSpan> program_moves(std::span<const Event> events) {
  std::vector<EventSpan> moves;
  std::optional<std::size_t> under_way;  // the move that lasts
  for (const Event& event : events) {
    const EventInfo* info = find_event(event.kind);
    const bool begins = event.kind == guide_on || event.kind == return_begun;
    const bool ends = event.kind == guide_reached || event.kind == guide_off || event.kind == return_ended ||
                      event.kind == resumed;
    if (under_way && (ends || begins)) {
      moves[*under_way].to_s = event.t_s;
      under_way.reset();
    }
    if (begins) {
      under_way = moves.size();
      moves.push_back({event.t_s, kNoEnd});
    } else if (info != nullptr && info->snaps) {
      moves.push_back({event.t_s, event.t_s});
    }
  }
  return moves;
}

// Whoever goes on with an attempt that was interrupted takes the tools up without a guide.
std::vector<EventSpan> guided_times(std::span<const Event> events) {
  std::vector<EventSpan> times;
  for (const Event& event : events) {
    const bool on = !times.empty() && times.back().to_s == kNoEnd;
    if (event.kind == guide_on && !on) times.push_back({event.t_s, kNoEnd});
    if ((event.kind == guide_off || event.kind == resumed) && on) times.back().to_s = event.t_s;
  }
  return times;
}

}  // namespace seldinger::cases
