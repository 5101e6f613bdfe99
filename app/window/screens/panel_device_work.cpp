// What is done with an arm at the device page: its self-test, its calibration, and the stylus that mouse and keys
// lead where there is no hardware.
#include <imgui.h>

#include <algorithm>

#include "app/hands/device_words.h"
#include "app/window/screens/panel_device.h"
#include "app/window/screens/panels.h"

namespace seldinger::app {
namespace {

using Work = DevicePage::Work;

const ImVec4 kDoneWell{0.55F, 0.88F, 0.60F, 1.0F}, kNotDone{0.95F, 0.70F, 0.45F, 1.0F},
    kOpen{0.62F, 0.66F, 0.70F, 1.0F};

}  // namespace

void DevicePanel::tell(DevicePage& page, TraceLine& line) const {
  const DevicePage::Seen& seen = page.seen();
  for (const ArmSeen& arm : seen.arms) line.arms.emplace_back(arm.reading.healthy ? "ok" : "lost");
  if (seen.work == Work::check) line.asks = check_asks(seen.check);
  if (seen.work == Work::calibrate) line.asks = taking_asks(seen.taking);
}

void DevicePanel::draw_check(const DevicePage::Seen& seen) {
  const devices::ArmCheck& check = seen.check;
  ImGui::TextWrapped("%s", check_asks(check).c_str());
  for (const CheckLine& line : check_lines(check)) {
    const bool open = line.state == CheckLine::State::open, holds = line.state == CheckLine::State::holds;
    ImGui::TextColored(open    ? kOpen
                       : holds ? kDoneWell
                               : kNotDone,
                       "%s  %s",
                       open    ? "·"
                       : holds ? "✓"
                               : "✗",
                       line.words.c_str());
  }
}

void DevicePanel::draw_calibration(Trainer& trainer, const Keys& keys, DevicePage& page) {
  const devices::PointTaking& taking = page.seen().taking;
  ImGui::TextWrapped("%s", taking_asks(taking).c_str());
  const auto asked = taking.asked();
  for (std::size_t i = 0; i < devices::kTemplatePoints; ++i) {
    const auto& taken = taking.taken_mm()[i];
    const ImVec4& colour = asked == i ? kNotDone : taken ? kDoneWell : kOpen;
    ImGui::TextColored(colour, "%s  %s", taken ? "✓" : asked == i ? "→" : "·", point_words(i).c_str());
    if (!taken) continue;
    ImGui::SameLine(scaled(290.0F));
    ImGui::TextDisabled("%.1f  %.1f  %.1f", taken->x, taken->y, taken->z);
    ImGui::SameLine(scaled(450.0F));
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton("take it again")) page.take_again(i);
    ImGui::PopID();
  }
  if (asked && !devices::template_points()[*asked].required && ImGui::Button("Leave it out (N)")) page.leave_out();
  if (asked && keys.pressed('N')) page.leave_out();
  if (asked) return;
  const auto calibration = devices::calibrate(taking.points());
  ImGui::PushStyleColor(ImGuiCol_Text, calibration ? kDoneWell : kNotDone);
  ImGui::TextWrapped("%s", calibration_words(calibration).c_str());
  ImGui::PopStyleColor();
  if (!calibration) {
    quiet("Take the wrong point again, or start again (C).");
    return;
  }
  if (!ImGui::Button("Keep it (Enter)") && !keys.pressed(kEnter)) return;
  if (trainer.keep_calibration(side_, *calibration)) {
    kept_ = std::string("The ") + kSideNames[side_] + " arm's calibration is kept.";
    page.look();
  }
}

void DevicePanel::draw_work(Trainer& trainer, const Keys& keys, DevicePage& page) {
  ImGui::Spacing();
  const DevicePage::Seen& seen = page.seen();
  const std::size_t before = side_;
  if (ImGui::RadioButton("left arm (1)", side_ == 0) || keys.pressed('1')) side_ = 0;
  ImGui::SameLine();
  if (ImGui::RadioButton("right arm (2)", side_ == 1) || keys.pressed('2')) side_ = 1;
  ImGui::SameLine();
  if (ImGui::Button("Self-test (T)") || keys.pressed('T')) page.check(side_);
  ImGui::SameLine();
  if (ImGui::Button("Calibrate (C)") || keys.pressed('C')) page.calibrate(side_);
  if (side_ != before) {
    gains_.reset();
    page.look();
  }
  if (keys.pressed(kSpace)) page.go_on();
  ImGui::Spacing();
  if (seen.work == Work::check && seen.side == side_)
    draw_check(seen);
  else if (seen.work == Work::calibrate && seen.side == side_)
    draw_calibration(trainer, keys, page);
  else
    quiet(
        "The self-test checks whether an arm answers, reaches far enough, pushes in the right direction, and how "
        "late it is; it takes a minute. The calibration finds the arm's position: you touch six points on the "
        "template with the stylus. Repeat both after moving an arm.");
}

void DevicePanel::lead_styli(const Keys& keys, LedArms& led, DevicePage& page) {
  const float pad_px = scaled(110.0F);
  constexpr double kMmPerPixel = 0.7, kWheelMm = 6.0, kKeyMmS = 120.0;
  const double now_s = session::clock_s(), elapsed_s = std::clamp(now_s - led_s_, 0.0, 0.5);
  led_s_ = now_s;
  ImGui::Spacing();
  heading("Move its stylus from here");
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton("stylus", {width, pad_px});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + pad_px}, IM_COL32(30, 42, 52, 255), 6.0F);
  draw->AddText(
      {corner.x + 8.0F, corner.y + 6.0F}, IM_COL32(200, 208, 216, 255),
      "drag: across the board · wheel: up and down\narrows, Page Up, Page Down: the same\nB: its button · "
      "V: to the point asked for");
  const std::size_t arm = LedArms::arm_of(page.status().ids[side_].arm, side_);
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
  const auto asked = page.seen().taking.asked();
  if (keys.pressed('V') && page.seen().work == Work::calibrate && asked)
    stylus.at_mm =
        devices::inverse_of(LedArms::template_from_device(arm))(devices::template_points()[*asked].template_mm);
  led.lead(arm, stylus);
}

}  // namespace seldinger::app
