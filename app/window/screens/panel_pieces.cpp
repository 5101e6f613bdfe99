#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "app/window/surface/screen_words.h"
#include "casedb/cases/setting_table.h"

namespace seldinger::app {

void begin_screen(const char* name) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  const bool walks = (ImGui::GetIO().ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0 || walking();
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   (walks ? 0 : ImGuiWindowFlags_NoNav));
  begin_way();
  gather_words();
}

void end_screen() {
  end_way();
  ImGui::End();
}

void begin_fields(const char* name, float width, float height) {
  ImGui::BeginChild(name, {width, height}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NavFlattened);
}

void begin_picture(const char* name, float width, float height) {
  ImGui::BeginChild(
      name, {width, height}, false,
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
          ImGuiWindowFlags_NoNav);  // Tab changes the tool; it would take a slider's number for a field
}

float scaled(float px) {
  return px * ImGui::GetFontSize() / 16.0F;
}

void begin_part(const char* name, const Part& part, float left, float top) {
  ImGui::SetCursorPos({left + part.left, top + part.top});
  begin_picture(name, part.width, part.height);
}

void begin_words(const char* name, const Part& part, float left, float top) {
  ImGui::SetCursorPos({left + part.left, top + part.top});
  ImGui::BeginChild(name, {part.width, part.height}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav);
}

void heading(const char* text) {
  gather_words();
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62F, 0.86F, 0.97F, 1.0F));
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void quiet(const char* text) {
  gather_words();
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62F, 0.66F, 0.70F, 1.0F));
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
}

void Question::ask(std::string words, std::string yes, std::string no) {
  words_ = std::move(words);
  yes_ = std::move(yes);
  no_ = std::move(no);
}

bool Question::draw(const Keys& keys) {
  if (!open()) return false;
  constexpr const char* kName = "##question";
  if (!ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(scaled(560.0F), viewport->WorkSize.x - 40.0F), 0.0F});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove)) return false;
  gather_words();
  ImGui::TextWrapped("%s", words_.c_str());
  ImGui::Spacing();
  const bool yes = noted_button(yes_.c_str());
  ImGui::SameLine();
  const bool no = noted_button((no_ + " (Esc)").c_str()) || keys.pressed(kEscape);
  ImGui::SetItemDefaultFocus();  // a second Enter takes nothing back
  if (yes || no) {
    drop();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return yes;
}

void draw_notice(const std::string& words, bool in_room) {
  constexpr float kClockPx = 170.0F;  // what stands at the right of the room's top line
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const float free = viewport->WorkSize.x - size.x;
  const ImVec2 at{viewport->WorkPos.x + (in_room ? free - scaled(kClockPx) : 0.5F * free),
                  viewport->WorkPos.y + 8.0F};
  ImDrawList* draw = ImGui::GetForegroundDrawList();
  draw->AddRectFilled({at.x - 14.0F, at.y - 4.0F}, {at.x + size.x + 14.0F, at.y + size.y + 4.0F},
                      IM_COL32(30, 50, 62, 235), 6.0F);
  draw->AddText(at, IM_COL32(225, 240, 248, 255), words.c_str());
  note_place("notice", at.x - 14.0F, at.y - 4.0F, size.x + 28.0F, size.y + 8.0F);
}

unsigned int colour_of_rule(cases::StructureRule rule) {
  switch (rule) {
    case cases::StructureRule::critical:
      return IM_COL32(255, 90, 80, 255);
    case cases::StructureRule::major:
      return IM_COL32(255, 160, 70, 255);
    case cases::StructureRule::must_cross:
      return IM_COL32(235, 215, 90, 255);
    case cases::StructureRule::organ:
      return IM_COL32(190, 130, 110, 255);
    case cases::StructureRule::target:
      return kTargetColour;
    case cases::StructureRule::advisory:
      break;
  }
  return IM_COL32(165, 175, 185, 255);
}

std::string modality_words(cases::Modality modality) {
  return std::string(base::name_of(casedb::kModalityWords, modality));
}

}  // namespace seldinger::app
