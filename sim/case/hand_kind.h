// What leads a tool: named in events, conditions of an attempt and exports.
#pragma once

#include <optional>

#include "sim/base/names.h"
#include "sim/case/event.h"

namespace seldinger::cases {

enum class HandKind { mouse, gamepad, space_mouse, arm, simulated };  // mouse: with keys; arm: with force feedback
inline constexpr auto kHandKindNames = base::names<HandKind>({{HandKind::mouse, "mouse"},
                                                              {HandKind::gamepad, "gamepad"},
                                                              {HandKind::space_mouse, "space_mouse"},
                                                              {HandKind::arm, "arm"},
                                                              {HandKind::simulated, "simulated"}});

enum class LedTool { needle, probe };

struct LedBy {
  LedTool tool = LedTool::needle;
  HandKind hand = HandKind::mouse;
};

// The event by which a recorder notes that from now on a hand leads a tool; none: `simulated`, which leads both all
// the time.
struct LedEvent {
  EventKind event;
  LedBy by;
};
inline constexpr LedEvent kLedEvents[] = {
    {EventKind::needle_by_mouse, {LedTool::needle, HandKind::mouse}},
    {EventKind::needle_by_gamepad, {LedTool::needle, HandKind::gamepad}},
    {EventKind::needle_by_space_mouse, {LedTool::needle, HandKind::space_mouse}},
    {EventKind::needle_by_arm, {LedTool::needle, HandKind::arm}},
    {EventKind::probe_by_mouse, {LedTool::probe, HandKind::mouse}},
    {EventKind::probe_by_gamepad, {LedTool::probe, HandKind::gamepad}},
    {EventKind::probe_by_space_mouse, {LedTool::probe, HandKind::space_mouse}},
    {EventKind::probe_by_arm, {LedTool::probe, HandKind::arm}},
};

constexpr EventKind led_by(LedTool tool, HandKind hand) noexcept {
  for (const LedEvent& one : kLedEvents)
    if (one.by.tool == tool && one.by.hand == hand) return one.event;
  return EventKind::none;
}
constexpr std::optional<LedBy> led_by(EventKind kind) noexcept {  // nothing: another event
  for (const LedEvent& one : kLedEvents)
    if (one.event == kind) return one.by;
  return std::nullopt;
}

}  // namespace seldinger::cases
