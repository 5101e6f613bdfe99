// What happens at a moment of an attempt, beside what hands do: what the trainee says or asks for, what a mentor
// makes happen, how the patient reacts, and where the workstation failed and the attempt went on.
#pragma once

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
  note_plan = 5,
  aspirate = 6,
  anaesthetic = 7,
  nick = 8,
  breath_hold_request = 9,
  breathe_again = 10,
  sign_out = 11,
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

struct Event {
  double t_s = 0.0;
  EventKind kind = EventKind::none;
  bool operator==(const Event&) const = default;
};

}  // namespace seldinger::cases
