#include "app/window/screens/panel_device.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/window/screens/panels.h"

namespace seldinger::app {
namespace {

using devices::LiveTrace;

constexpr std::array<ImU32, 3> kAxisColours = {IM_COL32(240, 120, 100, 255), IM_COL32(120, 220, 130, 255),
                                               IM_COL32(110, 170, 255, 255)};
constexpr ImU32 kForceColour = IM_COL32(250, 210, 90, 255), kFrame = IM_COL32(70, 80, 92, 255),
                kBack = IM_COL32(16, 20, 26, 255);
constexpr float kLeastSpanMm = 60.0F, kLeastSpanN = 2.0F;

struct Range {
  float least = 0.0F, most = 0.0F;
  bool told = false;
  void hold(const LiveTrace& trace) {
    for (std::size_t i = 0; i < devices::kTraceBins; ++i) {
      const LiveTrace::Bin& bin = trace.bin(i);
      if (!bin.filled) continue;
      least = told ? std::min(least, bin.least) : bin.least;
      most = told ? std::max(most, bin.most) : bin.most;
      told = true;
    }
  }
  void widen_to(float span) {
    const float missing = std::max(0.0F, span - (most - least));
    const float rim = 0.05F * std::max(span, most - least);
    least -= 0.5F * missing + rim;
    most += 0.5F * missing + rim;
  }
};

// The newest at the right; a gap stays one.
void draw(const LiveTrace& trace, const Range& range, const ImVec2& corner, const ImVec2& size, ImU32 colour) {
  ImDrawList* to = ImGui::GetWindowDrawList();
  const auto y = [&](float value) {
    return corner.y + size.y * (1.0F - (value - range.least) / (range.most - range.least));
  };
  const float step = size.x / static_cast<float>(devices::kTraceBins - 1);
  for (std::size_t i = 1; i + 1 < devices::kTraceBins; ++i) {
    const LiveTrace::Bin &now = trace.bin(i), &before = trace.bin(i + 1);
    if (!now.filled) continue;
    const float x = corner.x + size.x - step * static_cast<float>(i);
    const float from = before.filled ? 0.5F * (before.least + before.most) : now.least;
    to->AddLine({x - step, y(from)}, {x, y(0.5F * (now.least + now.most))}, colour);
    if (now.most > now.least) to->AddLine({x, y(now.least)}, {x, y(now.most)}, colour);
  }
}

ImVec2 frame(float width, float height, const char* words) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList* to = ImGui::GetWindowDrawList();
  to->AddRectFilled(corner, {corner.x + width, corner.y + height}, kBack);
  to->AddRect(corner, {corner.x + width, corner.y + height}, kFrame);
  ImGui::Dummy({width, height});
  to->AddText({corner.x + 6.0F, corner.y + 3.0F}, IM_COL32(200, 208, 216, 255), words);
  return corner;
}

void draw_arm(const char* name, const ArmSeen& arm, float width, float height) {
  ImGui::BeginGroup();
  char words[160];
  if (arm.reading.healthy)
    std::snprintf(words, sizeof words, "%s, mm%s", name, arm.reading.buttons[0] ? " · button" : "");
  else
    std::snprintf(words, sizeof words, "%s: nothing is read", name);
  Range place, force;
  for (const LiveTrace& axis : arm.at_mm) place.hold(axis);
  force.hold(arm.force_n);
  place.widen_to(kLeastSpanMm);
  force.most = std::max(force.most, kLeastSpanN);
  force.least = 0.0F;
  const float above = 0.6F * height;
  ImVec2 corner = frame(width, above, words);
  float at_px = corner.x + width;
  constexpr float kNumbersPx = 340.0F;  // in less there is no room for them
  for (std::size_t axis = 3; arm.reading.healthy && width > scaled(kNumbersPx) && axis-- > 0;) {
    char number[24];
    std::snprintf(number, sizeof number, "%c %.1f", "xyz"[axis], arm.reading.position_mm[static_cast<int>(axis)]);
    at_px -= scaled(74.0F);
    ImGui::GetWindowDrawList()->AddText({at_px, corner.y + 3.0F}, kAxisColours[axis], number);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    draw(arm.at_mm[axis], place, {corner.x, corner.y + scaled(24.0F)}, {width, above - scaled(28.0F)},
         kAxisColours[axis]);
  std::snprintf(words, sizeof words, "force requested, N: %.2f", static_cast<double>(arm.force_n.bin(1).most));
  corner = frame(width, height - above, words);
  draw(arm.force_n, force, {corner.x, corner.y + scaled(24.0F)}, {width, height - above - scaled(28.0F)},
       kForceColour);
  ImGui::EndGroup();
}

}  // namespace

void draw_arm_traces(const ArmsSeen& arms, float height_px) {
  const float width = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  draw_arm("left arm", arms[0], width, height_px);
  ImGui::SameLine();
  draw_arm("right arm", arms[1], width, height_px);
}

}  // namespace seldinger::app
