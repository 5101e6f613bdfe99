// What happens at a moment of an attempt, beside what hands do: what the trainee says or asks for, what a mentor
// makes happen, how the patient reacts, and where the workstation failed and the attempt went on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace seldinger::cases {

// Stored in recordings: numbers stay as they are.
enum class EventKind : std::uint8_t {
  none = 0,
  // The trainee's (clinical.md, "Steps around the puncture"; thesis, appendix A).
  sign_in = 1,
  proceed = 2,
  defer = 3,
  probe_checked = 4,
  note_plan = 5,  // with a length since there are depths that are measured, where one was planned
  aspirate = 6,
  anaesthetic = 7,
  nick = 8,
  breath_hold_request = 9,
  breathe_again = 10,
  sign_out = 11,
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
  // The workstation's.
  resumed = 96,
  calipers_recorded = 112,
};

enum class EventSource : std::uint8_t { trainee, mentor, patient, workstation };

struct EventInfo {
  EventKind kind;
  EventSource source;
  const char* name;   // as answers and exports write it: "sign_in"
  const char* words;  // for pages: "signed in"
  const char* about;  // what it means, one sentence
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
  std::uint16_t tenths_mm = 0;
  std::optional<double> length_mm() const noexcept {
    return tenths_mm > 0 ? std::optional(0.1 * tenths_mm) : std::nullopt;
  }
  bool operator==(const Event&) const = default;
};

}  // namespace seldinger::cases
