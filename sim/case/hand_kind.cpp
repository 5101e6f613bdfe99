#include "sim/case/hand_kind.h"

namespace seldinger::cases {
namespace {

struct Row {
  EventKind event;
  LedBy by;
};
constexpr Row kRows[] = {
    {EventKind::needle_by_mouse, {LedTool::needle, HandKind::mouse}},
    {EventKind::needle_by_gamepad, {LedTool::needle, HandKind::gamepad}},
    {EventKind::needle_by_space_mouse, {LedTool::needle, HandKind::space_mouse}},
    {EventKind::needle_by_arm, {LedTool::needle, HandKind::arm}},
    {EventKind::probe_by_mouse, {LedTool::probe, HandKind::mouse}},
    {EventKind::probe_by_gamepad, {LedTool::probe, HandKind::gamepad}},
    {EventKind::probe_by_space_mouse, {LedTool::probe, HandKind::space_mouse}},
    {EventKind::probe_by_arm, {LedTool::probe, HandKind::arm}},
};

}  // namespace

EventKind led_by(LedTool tool, HandKind hand) noexcept {
  for (const Row& row : kRows)
    if (row.by.tool == tool && row.by.hand == hand) return row.event;
  return EventKind::none;
}

std::optional<LedBy> led_by(EventKind kind) noexcept {
  for (const Row& row : kRows)
    if (row.event == kind) return row.by;
  return std::nullopt;
}

}  // namespace seldinger::cases
