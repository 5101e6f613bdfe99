#include <imgui.h>

#include "app/window/screens/panels.h"
#include "casedb/cases/setting_table.h"

namespace seldinger::app {

void begin_screen(const char* name) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoNav);
}

void end_screen() {
  ImGui::End();
}

void begin_picture(const char* name, float width, float height) {
  ImGui::BeginChild(
      name, {width, height}, false,
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
          ImGuiWindowFlags_NoNav);  // Tab changes the tool; it would take a slider's number for a field
}

void heading(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62F, 0.86F, 0.97F, 1.0F));
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void quiet(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62F, 0.66F, 0.70F, 1.0F));
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
}

void draw_notice(const std::string& words) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const ImVec2 at{viewport->WorkPos.x + 0.5F * (viewport->WorkSize.x - size.x),
                  viewport->WorkPos.y + viewport->WorkSize.y - size.y - 22.0F};
  ImDrawList* draw = ImGui::GetForegroundDrawList();
  draw->AddRectFilled({at.x - 14.0F, at.y - 8.0F}, {at.x + size.x + 14.0F, at.y + size.y + 8.0F},
                      IM_COL32(30, 50, 62, 235), 6.0F);
  draw->AddText(at, IM_COL32(225, 240, 248, 255), words.c_str());
}

std::string modality_words(cases::Modality modality) {
  return std::string(base::name_of(casedb::kModalityWords, modality));
}

}  // namespace seldinger::app
