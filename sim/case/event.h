// What happens at a moment of an attempt, beside what hands do: what the trainee says or asks for, what a mentor
// makes happen, how the patient reacts, and what became of hands and clock at the workstation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace seldinger::cases {

// Stored in recordings: numbers stay as they are.
enum class EventKind : std::uint8_t {
  none = 0,
  // The trainee's (docs/clinical.md, "Steps around the puncture"; thesis, appendix A).
  sign_in = 1,
  proceed = 2,
  defer = 3,
  probe_checked = 4,
  note_plan = 5,    // with a length since there are depths that are measured, where one was planned
  aspirate = 6,     // through the needle with a length: how far it is in
  anaesthetic = 7,  // through the needle with a length: how far it is in
  nick = 8,
  breath_hold_request = 9,
  breathe_again = 10,
  sign_out = 11,
  stylet_out = 12,
  stylet_in = 13,
  inject = 14,          // one push of contrast, engine/needle_flow
  depth_measured = 16,  // with a length
  // The mentor's.
  cough = 32,
  bleeding = 33,
  pressure_drop = 34,
  // The patient's.
  pain_skin = 64,
  pain_bone = 65,
  breath_held = 66,
  breath_lost = 67,
  urine_returns = 68,
  bile_returns = 69,
  dark_blood_returns = 70,
  bright_blood_returns = 71,
  fluid_returns = 72,
  // The workstation's.
  resumed = 96,
  paused = 97,
  guide_on = 98,
  guide_reached = 99,
  guide_off = 100,
  return_begun = 101,
  return_ended = 102,
  calipers_recorded = 103,
  needle_by_mouse = 112,
  needle_by_gamepad = 113,
  needle_by_space_mouse = 114,
  needle_by_arm = 115,
  probe_by_mouse = 116,
  probe_by_gamepad = 117,
  probe_by_space_mouse = 118,
  probe_by_arm = 119,
};

enum class EventSource : std::uint8_t { trainee, mentor, patient, workstation };

struct EventInfo {
  EventKind kind;
  EventSource source;
  const char* name;   // as answers and exports write it: "sign_in"
  const char* words;  // for pages: "signed in"
  const char* about;  // what it means, one sentence
  // Kept by the recorder beside the inputs: it changes nothing of the attempt, and a replay makes none of it.
  bool noted = false;
  // The program may itself have moved a tool at that moment, however far: no tracker lost it.
  bool snaps = false;
};

// All but `none`.
std::span<const EventInfo> event_kinds() noexcept;
const EventInfo* find_event(EventKind kind) noexcept;  // nullptr: none, or no such number
std::optional<EventKind> event_from(std::string_view name) noexcept;
std::string_view name_of(EventSource source) noexcept;

// A length that is told with an event, as it is recorded: in 0.1 mm, at most 6553.5 mm; 0: none.
inline std::uint16_t tenths_of(double mm) noexcept {
  return mm > 0.0 ? static_cast<std::uint16_t>(std::lround(std::min(10.0 * mm, 65535.0))) : std::uint16_t{0};
}

struct Event {
  double t_s = 0.0;
  EventKind kind = EventKind::none;
  double wall_s = 0.0;  // paused: for how long, by the wall's clock; else 0
  std::uint16_t tenths_mm = 0;
  std::optional<double> length_mm() const noexcept {
    return tenths_mm > 0 ? std::optional(0.1 * tenths_mm) : std::nullopt;
  }
  bool operator==(const Event&) const = default;
};

// From one event to another; what has no end in the events lasts to infinity.
struct EventSpan {
  double from_s = 0.0, to_s = 0.0;
};
// When the program may itself have moved a tool, by rising begin: at a moment (both the same), and as long as it
// brings the needle to its guide or both tools back to where they began. `events` by rising time, here and below.
std::vector<EventSpan> program_moves(std::span<const Event> events);
// As long as the needle guide was taken up; nothing: it never was, or it was not noted.
std::vector<EventSpan> guided_times(std::span<const Event> events);

}  // namespace seldinger::cases
