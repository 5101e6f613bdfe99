#include "app/window/screens/panel_device.h"

#include <imgui.h>

#include <algorithm>

#include "app/hands/device_words.h"
#include "app/window/screens/panels.h"

namespace seldinger::app {
namespace {

const ImVec4 kWell{0.55F, 0.88F, 0.60F, 1.0F}, kNot{0.95F, 0.70F, 0.45F, 1.0F};

void hand(const char* name, bool there, const std::string& words) {
  ImGui::TextColored(there ? kWell : kNot, "%s", there ? "✓" : "✗");
  ImGui::SameLine();
  ImGui::TextWrapped("%s: %s", name, words.c_str());
}

StationDevice device_of(const Arms& arms, std::size_t side) {
  const auto known = arms.station.find(kSideNames[side]);
  return known == arms.station.end() ? StationDevice{} : known->second;
}

std::string stands_words(const devices::Calibration& calibration) {
  if (calibration.points.empty()) return "not calibrated: its axes are assumed to be the template's";
  char words[96];
  std::snprintf(words, sizeof words, "calibrated, off by %.2f mm at most", calibration.residual_max_mm);
  return words;
}

}  // namespace

void DevicePanel::draw_hands(Trainer& trainer, const OtherHands& other) {
  heading("What hands can use here");
  hand("Mouse and keys", true, "always");
  hand("Gamepad", other.gamepad.has_value(),
       other.gamepad ? "beside the mouse" : "none that is known is plugged in");
  hand("3-D mouse", other.space_mouse.has_value(),
       other.space_mouse ? "beside the mouse" : "none: spacenavd does not answer");
  if (!trainer.arms()) {
    hand("Arms with force", false,
         "not asked for. `seldinger train --device haply` uses two arms of a Haply Inverse service, `--device "
         "virtual` two simulated ones.");
    return;
  }
  DevicePage& page = *trainer.device_page();
  const Arms& arms = *trainer.arms();
  const devices::HaplyStatus status = page.status();
  hand(arms.led ? "Simulated service" : "Haply Inverse service", status.connected,
       arms.place.host + ":" + std::to_string(arms.place.port) + (status.connected ? "" : " does not answer"));
  const ArmsSeen& seen = page.seen().arms;
  for (std::size_t side = 0; side < 2; ++side) {
    hand(side == 0 ? "Left" : "Right", seen[side].reading.healthy, arm_words(seen[side], status.ids[side], status));
    quiet(("      " + stands_words(device_of(arms, side).calibration)).c_str());
  }
  if (ImGui::Button("Exchange left and right (X)")) {
    trainer.exchange_arms();
    if (trainer.refusal().empty()) kept_ = "Left and right are exchanged.";
  }
}

void DevicePanel::draw_gains(Trainer& trainer) {
  const StationDevice device = device_of(*trainer.arms(), side_);
  devices::DeviceGains gains = gains_.value_or(device.gains);
  ImGui::Spacing();
  heading(side_ == 0 ? "How the left arm is set" : "How the right arm is set");
  auto motion = static_cast<float>(gains.motion_scale), share = static_cast<float>(100.0 * gains.force_share),
       most = static_cast<float>(gains.most_force_n);
  bool done = false;
  const auto slider = [&](const char* words, float& value, float least, float greatest, const char* format) {
    ImGui::SetNextItemWidth(0.5F * ImGui::GetContentRegionAvail().x);
    const bool moved = ImGui::SliderFloat(words, &value, least, greatest, format, ImGuiSliderFlags_AlwaysClamp);
    done = done || ImGui::IsItemDeactivatedAfterEdit();
    return moved;
  };
  bool moved = slider("travel of the tool", motion, static_cast<float>(devices::kLeastMotionScale),
                      static_cast<float>(devices::kMostMotionScale), "%.2f × the hand's");
  moved = slider("force", share, 0.0F, static_cast<float>(100.0 * devices::kMostForceShare), "%.0f %%") || moved;
  moved = slider("most force", most, 0.0F, static_cast<float>(devices::kMostForceN), "%.1f N") || moved;
  if (moved)
    gains_ = devices::DeviceGains{static_cast<double>(motion), 0.01 * static_cast<double>(share),
                                  static_cast<double>(most)};
  const double usable =
      devices::usable_share(gains, gains.motion_scale * device.calibration.template_from_device.scale);
  if (usable < gains.force_share) {
    char words[120];
    std::snprintf(words, sizeof words,
                  "To keep the hand stable, this longer travel of the tool allows at most %.0f %% of the force.",
                  100.0 * usable);
    quiet(words);
  }
  if (!done || !gains_) return;
  const devices::DeviceGains kept = *gains_;
  gains_.reset();
  if (trainer.change_station([&](Station& station) { station[kSideNames[side_]].gains = kept; }))
    kept_ = "These settings apply from the next attempt on.";
}

void DevicePanel::draw(Trainer& trainer, const Keys& keys, const OtherHands& other) {
  if (trainer.device_page() != page_) {
    page_ = trainer.device_page();
    gains_.reset();
    styli_ = {};
    led_s_ = session::clock_s();
  }
  begin_screen("devices");
  heading("The hands at this desk");
  ImGui::SameLine(ImGui::GetContentRegionMax().x - scaled(150.0F));
  const bool leave =
      ImGui::Button("Back (Esc)", {scaled(140.0F), 0.0F}) || keys.pressed(kEscape) || keys.pressed(kF1 + 9);
  quiet(kTrainingOnly);
  const ImVec2 all = ImGui::GetContentRegionAvail();
  begin_fields("there", 0.36F * all.x, all.y);
  draw_hands(trainer, other);
  DevicePage* page = trainer.device_page();  // an exchange made another
  if (page != nullptr) {
    draw_gains(trainer);
    if (!trainer.refusal().empty()) ImGui::TextColored(kNot, "That did not work: %s", trainer.refusal().c_str());
    if (!kept_.empty()) ImGui::TextColored(kWell, "%s", kept_.c_str());
    const Arms& arms = *trainer.arms();
    quiet(arms.station_file.empty() ? "What is changed here holds until the program ends; --station FILE keeps it."
                                    : ("Kept in " + arms.station_file.filename().string() + ".").c_str());
    if (arms.led) lead_styli(keys, *arms.led, *page);
  }
  ImGui::EndChild();
  ImGui::SameLine();
  begin_fields("work", 0.0F, all.y);
  if (page != nullptr) {
    draw_arm_traces(page->seen().arms, 0.45F * all.y);
    draw_work(trainer, keys, *page);
  } else {
    ImGui::TextWrapped("Two arms that push back can be looked at, calibrated and tested here.");
  }
  ImGui::EndChild();
  end_screen();
  if (page != nullptr && keys.pressed('X')) {
    trainer.exchange_arms();
    if (trainer.refusal().empty()) kept_ = "Left and right are exchanged.";
  }
  if (!leave) return;
  kept_.clear();
  trainer.leave_devices();
}

}  // namespace seldinger::app
