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

// The event by which a recorder notes that from now on this leads the tool; none: `simulated`, which leads both all
// the time.
EventKind led_by(LedTool tool, HandKind hand) noexcept;

struct LedBy {
  LedTool tool = LedTool::needle;
  HandKind hand = HandKind::mouse;
};
std::optional<LedBy> led_by(EventKind kind) noexcept;  // nothing: another event

}  // namespace seldinger::cases
