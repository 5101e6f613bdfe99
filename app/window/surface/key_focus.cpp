#include "app/window/surface/key_focus.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <utility>

namespace seldinger::app {
namespace {

// As Dear ImGui's own state: of the one window, in its thread.
struct Way {
  bool framed = false;  // since Tab or an arrow, until the mouse is pressed
  bool kept = false;    // by the item that had the focus in the frame before
  bool begun = false;
  bool alive = false;        // what has the focus was drawn in the frame before
  std::string focus, named;  // of this frame so far, of the one before
};

Way& way() {
  static Way its;
  return its;
}

}  // namespace

bool walk_by_keys(bool walks, bool tab, bool press, bool by_mouse) {
  ImGuiIO& io = ImGui::GetIO();
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  Way& its = way();
  const bool kept = std::exchange(its.kept, false);
  if (by_mouse || !walks) its.framed = false;
  if (walks && !kept)
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  else
    io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  if (walks && (tab || !g.NavDisableHighlight)) its.framed = its.framed || tab || !by_mouse;
  its.named = std::exchange(its.focus, {});
  its.alive = g.NavIdIsAlive;
  const bool presses =
      press && walks && !kept && its.framed && g.NavId != 0 && g.ActiveId == 0 && !io.WantTextInput;
  if (presses) ImGui::ActivateItem(g.NavId);
  return presses;
}

void go_on_from_focus(bool back) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  const bool asked = g.NavMoveSubmitted && (g.NavMoveFlags & ImGuiNavMoveFlags_Tabbing) != 0;
  if (asked && way().alive && g.NavId != 0) g.NavTabbingDir = back ? -1 : +1;
}

bool walking() {
  return way().framed;
}

void begin_way() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  way().begun = (g.IO.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0 || way().framed;
  if (!way().begun) return;
  if (way().framed) g.NavDisableHighlight = false;
  ImGui::PushItemFlag(ImGuiItemFlags_Inputable, true);  // Tab stops at buttons too
}

void end_way() {
  if (std::exchange(way().begun, false)) ImGui::PopItemFlag();
}

void header_row() {
  ImGui::PushItemFlag(ImGuiItemFlags_NoNav | ImGuiItemFlags_NoTabStop, true);
  ImGui::TableHeadersRow();
  ImGui::PopItemFlag();
}

void focus_here() {
  if (!way().framed) return;
  ImGuiContext& g = *ImGui::GetCurrentContext();
  ImGui::SetFocusID(g.LastItemData.ID, g.CurrentWindow);
  g.NavDisableHighlight = false;
}

bool framed() {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  return way().framed && g.NavId != 0 && g.NavId == g.LastItemData.ID;
}

bool keep_keys() {
  if (!framed()) return false;
  way().kept = true;
  return true;
}

void note_focus(const std::string& name) {
  way().focus = name;
}

const std::string& focus() {
  return way().focus.empty() ? way().named : way().focus;
}

}  // namespace seldinger::app
