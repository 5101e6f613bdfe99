#include <imgui.h>

#include <algorithm>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"

namespace seldinger::app {

void LogInPanel::draw(Trainer& trainer) {
  begin_screen("log in");
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float width = std::clamp(0.33F * room.x, std::min(scaled(360.0F), room.x), scaled(620.0F));
  ImGui::SetCursorPos({0.5F * (room.x - width), 0.28F * room.y});
  begin_fields("account", width, 20.0F * ImGui::GetFontSize());
  ImGui::Spacing();
  heading("Seldinger");
  quiet("Image-guided needle puncture, practised where nobody gets hurt.");
  ImGui::Spacing();
  // Esc, or a click beside the fields, does not take the keyboard away: what is typed lands where it was meant for.
  constexpr int kIdleFrames = 4;  // Dear ImGui needs two to move the focus
  const bool back = idle_frames_ >= kIdleFrames;
  if (back) idle_frames_ = 0;
  ImGui::TextUnformatted("Name");
  ImGui::SetNextItemWidth(-1.0F);
  if (!begun_ || (back && !in_password_)) ImGui::SetKeyboardFocusHere();
  begun_ = true;
  const bool entered_name =
      ImGui::InputText("##name", name_.data(), name_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) in_password_ = false;
  note_item("Name");
  ImGui::TextUnformatted("Password");
  ImGui::SetNextItemWidth(-1.0F);
  if (entered_name || (back && in_password_)) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputText("##password", password_.data(), password_.size(),
                                        ImGuiInputTextFlags_Password | ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemActive()) in_password_ = true;
  note_item("Password");
  ImGui::Spacing();
  const bool pressed = noted_button("Log in", -1.0F);
  idle_frames_ = ImGui::IsAnyItemActive() || framed() ? 0 : idle_frames_ + 1;
  if (pressed || entered) {
    trainer.log_in(name_.data(), password_.data());
    password_.fill('\0');
    begun_ = in_password_ = false;
    if (trainer.screen() != TrainerScreen::log_in) name_.fill('\0');
  }
  if (!trainer.refusal().empty()) {
    ImGui::TextWrapped("%s", trainer.refusal().c_str());
    note_item("refused");
  }
  ImGui::Spacing();
  quiet(kTrainingOnly);
  ImGui::EndChild();
  end_screen();
}

}  // namespace seldinger::app
