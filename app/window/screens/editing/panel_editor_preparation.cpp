// The CT prepared anew: its histogram with the skin's value under the mouse, the settings, what they cost.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/window/screens/editing/panel_editor.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"

namespace seldinger::app {
namespace {

constexpr float kHistogramPx = 92.0F;
constexpr ImU32 kBars = IM_COL32(150, 175, 190, 255), kClamped = IM_COL32(80, 90, 98, 255),
                kIso = IM_COL32(255, 215, 90, 255), kAxis = IM_COL32(150, 160, 170, 255);

const casedb::PreparationRow& skin_row() {
  return *std::find_if(casedb::kPreparationRows.begin(), casedb::kPreparationRows.end(),
                       [](const auto& row) { return row.value == &casedb::Preparation::skin_hu; });
}

}  // namespace

void EditorPanel::draw_histogram(DraftPreparation& preparing, casedb::Preparation& settings, bool& in_hand) {
  const auto histogram = preparing.histogram();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x, high = scaled(kHistogramPx);
  ImGui::InvisibleButton("histogram", {wide, high});
  note_item("histogram");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + wide, corner.y + high}, IM_COL32(16, 19, 22, 255));
  if (!histogram) return;
  constexpr double kSpanHu = HuHistogram::kHighHu - HuHistogram::kLowHu;
  const auto x_of = [&](double hu) {
    return corner.x + wide * static_cast<float>((hu - HuHistogram::kLowHu) / kSpanHu);
  };
  for (std::size_t bin = 0; bin < HuHistogram::kBins; ++bin) {
    const double hu = HuHistogram::kLowHu + HuHistogram::kBinHu * static_cast<double>(bin);
    const bool kept = hu >= settings.clamp_low_hu && hu <= settings.clamp_high_hu;
    const float top = corner.y + high * (1.0F - static_cast<float>(histogram->height(bin)));
    draw->AddRectFilled({x_of(hu), top}, {x_of(hu + HuHistogram::kBinHu), corner.y + high},
                        kept ? kBars : kClamped);
  }
  for (const double hu : {-1000.0, -500.0, 0.0, 500.0, 1000.0, 1500.0}) {
    char text[16];
    std::snprintf(text, sizeof text, "%.0f", hu);
    draw->AddLine({x_of(hu), corner.y}, {x_of(hu), corner.y + 4.0F}, kAxis);
    draw->AddText({x_of(hu) + 2.0F, corner.y}, kAxis, text);
  }
  draw->AddLine({x_of(settings.skin_hu), corner.y}, {x_of(settings.skin_hu), corner.y + high}, kIso, 2.0F);
  const double under =
      HuHistogram::kLowHu + kSpanHu * static_cast<double>((ImGui::GetMousePos().x - corner.x) / wide);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetTooltip("%.0f HU: %zu voxels", under, histogram->counts[HuHistogram::bin_of(under)]);
  if (!ImGui::IsItemActive()) return;
  const casedb::PreparationRow& row = skin_row();
  settings.skin_hu = std::clamp(std::round(under), row.least, row.most);
  in_hand = true;
}

void EditorPanel::draw_preparation(CaseEditor& editor) {
  DraftPreparation& preparing = editor.preparing();
  const bool was_in_hand = preparation_in_hand_;
  if (!was_in_hand) preparation_ = preparing.settings();
  preparation_in_hand_ = false;
  heading("Prepare the CT again");
  draw_histogram(preparing, preparation_, preparation_in_hand_);
  const auto made = preparing.newest();
  if (const auto error = preparing.error()) {
    ImGui::TextColored({1.0F, 0.55F, 0.40F, 1.0F}, "%s", error->text.c_str());
    for (const base::Problem& one : error->findings) ImGui::TextWrapped("%s", one.text.c_str());
  } else if (preparing.busy() || !made) {
    ImGui::TextUnformatted("preparing …");
  } else {
    const casedb::Fidelity& cost = made->fidelity;
    if (cost.compares_skin) {
      ImGui::Text("from the full surface: %.2f mm on average,", cost.mean_mm);
      ImGui::Text("95 %% within %.2f, at most %.2f mm", cost.most_95_mm, cost.most_mm);
    } else {
      ImGui::TextUnformatted("no skin to compare with the full surface");
    }
    // On one line: the sliders below stay in sight.
    const bool less = !casedb::less_decimated(made->settings, cost).empty();
    ImGui::Text("%zu triangles of %zu%s", cost.triangles, cost.full_triangles,
                less ? ": fewer would leave holes" : "");
    ImGui::Text("HU differ by %.1f on average, 95 %% by %.0f", cost.mean_hu, cost.most_95_hu);
    note_item("what it costs");
  }
  const bool kept = made && made->settings == preparing.stored();
  ImGui::BeginDisabled(preparing.busy() || preparing.error() || !made || kept);
  if (noted_button("Keep as a new draft")) kept_preparation_ = editor.keep_preparation();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(preparing.settings() == casedb::Preparation{});
  const bool back = noted_button("As it came");
  ImGui::EndDisabled();
  for (const casedb::PreparationRow& row : casedb::kPreparationRows) {
    const std::string format = "%." + std::to_string(row.digits) + "f";
    number_field(row.words, preparation_.*row.value, row.step, format.c_str(), preparation_in_hand_);
  }
  if (back) preparation_ = {};
  // Once the mouse or the keyboard lets go: what is being typed or dragged is not prepared yet.
  if (!preparation_in_hand_ && !(preparation_ == preparing.settings())) preparing.wish(preparation_);
}

}  // namespace seldinger::app
