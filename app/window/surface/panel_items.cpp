#include "app/window/surface/panel_items.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "app/window/surface/key_focus.h"
#include "app/window/surface/screen_words.h"

namespace seldinger::app {
namespace {

// As Dear ImGui's own state: of the one window, in its thread.
struct Noted {
  bool wanted = false;
  std::vector<ShownItem> items;
};

Noted& noted() {
  static Noted all;
  return all;
}

}  // namespace

void note_items(bool wanted) {
  noted().wanted = wanted;
}

void forget_items() {
  noted().items.clear();
}

void note_item(const char* name) {
  gather_words();
  const ImVec2 from = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  note_part(name, from.x, from.y, size.x, size.y);
}

void note_part(const char* name, float left, float top, float width, float height) {
  if (!noted().wanted) return;
  if (!ImGui::IsItemVisible() || (ImGui::GetItemFlags() & ImGuiItemFlags_Disabled) != 0) return;
  note_place(name, left, top, width, height);
}

void note_place(const char* name, float left, float top, float width, float height) {
  if (!noted().wanted) return;
  std::string own(name);
  own.resize(std::min(own.size(), own.find("##")));
  std::vector<ShownItem>& items = noted().items;
  const auto same = std::count_if(items.begin(), items.end(), [&](const ShownItem& item) {
    return item.name == own || (item.name.starts_with(own) && item.name.compare(own.size(), 1, "#") == 0);
  });
  if (same > 0) own.append("#").append(std::to_string(same + 1));
  const ImVec2 window = ImGui::GetMainViewport()->Pos;
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  const ImGuiID on = g.ActiveId != 0 ? g.ActiveId : g.NavId;
  if (on != 0 && on == g.LastItemData.ID) note_focus(own);
  items.push_back({own, left - window.x, top - window.y, width, height});
}

const std::vector<ShownItem>& noted_items() {
  return noted().items;
}

bool noted_button(const char* label, float width) {
  const bool pressed = ImGui::Button(label, {width, 0.0F});
  note_item(label);
  return pressed;
}

}  // namespace seldinger::app
