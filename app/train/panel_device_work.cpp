// What is done with an arm at the device page: its self-test, its calibration, and the stylus that mouse and keys
// lead where there is no hardware.
#include <imgui.h>

#include <algorithm>

#include "app/device_words.h"
#include "app/train/panel_device.h"
#include "app/train/panels.h"

namespace seldinger::app {
namespace {

using Work = DeviceBench::Work;

const ImVec4 kWell{0.55F, 0.88F, 0.60F, 1.0F}, kNot{0.95F, 0.70F, 0.45F, 1.0F}, kOpen{0.62F, 0.66F, 0.70F, 1.0F};

}  // namespace

void DevicePanel::tell(DeviceBench& bench, TraceLine& line) const {
  const DeviceBench::Seen& seen = bench.seen();
  for (const ArmSeen& arm : seen.arms) line.arms.emplace_back(arm.reading.healthy ? "ok" : "lost");
  if (seen.work == Work::check) line.asks = check_asks(seen.check);
  if (seen.work == Work::calibrate) line.asks = taking_asks(seen.taking);
}

void DevicePanel::draw_check(const DeviceBench::Seen& seen) {
  const devices::DeviceCheck& check = seen.check;
  ImGui::TextWrapped("%s", check_asks(check).c_str());
  for (const CheckLine& line : check_lines(check)) {
    const bool open = line.state == CheckLine::State::open, holds = line.state == CheckLine::State::holds;
    ImGui::TextColored(open    ? kOpen
                       : holds ? kWell
                               : kNot,
                       "%s  %s",
                       open    ? "·"
                       : holds ? "✓"
                               : "✗",
                       line.words.c_str());
  }
}

void DevicePanel::draw_calibration(Trainer& trainer, const Keys& keys, DeviceBench& bench) {
  const devices::PointTaking& taking = bench.seen().taking;
  ImGui::TextWrapped("%s", taking_asks(taking).c_str());
  const auto asked = taking.asked();
  for (std::size_t i = 0; i < devices::kTemplatePoints; ++i) {
    const auto& taken = taking.taken_mm()[i];
    const ImVec4& colour = asked == i ? kNot : taken ? kWell : kOpen;
    ImGui::TextColored(colour, "%s  %s", taken ? "✓" : asked == i ? "→" : "·", point_words(i).c_str());
    if (!taken) continue;
    ImGui::SameLine(290.0F);
    ImGui::TextDisabled("%.1f  %.1f  %.1f", taken->x, taken->y, taken->z);
    ImGui::SameLine(450.0F);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton("take it again")) bench.take_again(i);
    ImGui::PopID();
  }
  if (asked && !devices::template_points()[*asked].required && ImGui::Button("Leave it out (N)")) bench.leave_out();
  if (asked && keys.pressed('N')) bench.leave_out();
  if (asked) return;
  const auto calibration = devices::calibrate(taking.points());
  ImGui::PushStyleColor(ImGuiCol_Text, calibration ? kWell : kNot);
  ImGui::TextWrapped("%s", calibration_words(calibration).c_str());
  ImGui::PopStyleColor();
  if (!calibration) {
    quiet("Take the point again that is wrong, or begin anew (C).");
    return;
  }
  if (!ImGui::Button("Keep it (Enter)") && !keys.pressed(kEnter)) return;
  if (trainer.keep_calibration(side_, *calibration)) {
    kept_ = std::string("The ") + kSideNames[side_] + " arm's calibration is kept.";
    bench.look();
  }
}

void DevicePanel::draw_work(Trainer& trainer, const Keys& keys, DeviceBench& bench) {
  ImGui::Spacing();
  const DeviceBench::Seen& seen = bench.seen();
  const std::size_t before = side_;
  if (ImGui::RadioButton("left arm (1)", side_ == 0) || keys.pressed('1')) side_ = 0;
  ImGui::SameLine();
  if (ImGui::RadioButton("right arm (2)", side_ == 1) || keys.pressed('2')) side_ = 1;
  ImGui::SameLine();
  if (ImGui::Button("Self-test (T)") || keys.pressed('T')) bench.check(side_);
  ImGui::SameLine();
  if (ImGui::Button("Calibrate (C)") || keys.pressed('C')) bench.calibrate(side_);
  if (side_ != before) {
    gains_.reset();
    bench.look();
  }
  if (keys.pressed(kSpace)) bench.go_on();
  ImGui::Spacing();
  if (seen.work == Work::check && seen.side == side_)
    draw_check(seen);
  else if (seen.work == Work::calibrate && seen.side == side_)
    draw_calibration(trainer, keys, bench);
  else
    quiet(
        "The self-test tells whether an arm answers, reaches, pushes where it is told to, and how late it is; it "
        "takes a minute. A calibration tells where an arm stands: on the template, six points are touched with the "
        "stylus. Both are done again after an arm was moved.");
}

void DevicePanel::lead_styli(const Keys& keys, LedArms& led, DeviceBench& bench) {
  constexpr float kPadPx = 110.0F;
  constexpr double kMmPerPixel = 0.7, kWheelMm = 6.0, kKeyMmS = 120.0;
  const double now_s = clock_s(), elapsed_s = std::clamp(now_s - led_s_, 0.0, 0.5);
  led_s_ = now_s;
  ImGui::Spacing();
  heading("Its stylus is led from here");
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton("stylus", {width, kPadPx});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + kPadPx}, IM_COL32(30, 42, 52, 255), 6.0F);
  draw->AddText(
      {corner.x + 8.0F, corner.y + 6.0F}, IM_COL32(200, 208, 216, 255),
      "drag: across the board · wheel: up and down\narrows, Page Up, Page Down: the same\nB: its button · "
      "V: to the point that is asked for");
  const std::size_t arm = LedArms::arm_of(bench.status().ids[side_].arm, side_);
  LedStylus& stylus = styli_[arm];
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive())
    stylus.at_mm +=
        kMmPerPixel * glm::dvec3(static_cast<double>(io.MouseDelta.x), 0.0, static_cast<double>(io.MouseDelta.y));
  if (ImGui::IsItemHovered()) stylus.at_mm.y += kWheelMm * static_cast<double>(io.MouseWheel);
  const auto axis = [&](int more, int less) {
    return (keys.held(more) ? kKeyMmS : 0.0) - (keys.held(less) ? kKeyMmS : 0.0);
  };
  stylus.at_mm += elapsed_s * glm::dvec3(axis(kRight, kLeft), axis(kPageUp, kPageDown), axis(kDown, kUp));
  stylus.button = keys.held('B');
  const auto asked = bench.seen().taking.asked();
  if (keys.pressed('V') && bench.seen().work == Work::calibrate && asked)
    stylus.at_mm =
        devices::inverse_of(LedArms::template_from_device(arm))(devices::template_points()[*asked].template_mm);
  led.lead(arm, stylus);
}

}  // namespace seldinger::app
