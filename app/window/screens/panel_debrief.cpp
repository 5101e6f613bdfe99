#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "assessment/procedure/steps.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

ImVec4 colour_of(assessment::Verdict verdict) {
  if (verdict == assessment::Verdict::passed) return {0.45F, 0.85F, 0.55F, 1.0F};
  if (verdict == assessment::Verdict::failed) return {0.96F, 0.58F, 0.40F, 1.0F};
  return {0.80F, 0.82F, 0.84F, 1.0F};
}

const char* mark_of(const assessment::CriterionResult& result) {
  if (result.outcome == assessment::Outcome::met) return "met";
  if (result.critical_error()) return "critical error";
  return result.outcome == assessment::Outcome::missed ? "missed" : "not measured";
}

ImVec4 colour_of(const assessment::CriterionResult& result) {
  if (result.outcome == assessment::Outcome::met) return {0.45F, 0.85F, 0.55F, 1.0F};
  if (result.outcome == assessment::Outcome::missed) return {0.96F, 0.58F, 0.40F, 1.0F};
  return {0.80F, 0.82F, 0.84F, 1.0F};
}

// The experts' band on a line, where the trainee's value lies to it (a dot), and what was asked (a stroke).
void draw_band(const assessment::MetricBand& band, double value, const assessment::CriterionResult& result) {
  const double asked = result.criterion.value;
  const double low = std::min({band.low, value, asked}), high = std::max({band.high, value, asked});
  if (!(high > low)) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x - 6.0F, high_px = 14.0F, y = corner.y + 0.5F * high_px;
  const auto x = [&](double at) {
    return corner.x + 6.0F + (wide - 12.0F) * static_cast<float>((at - low) / (high - low));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine({x(low), y}, {x(high), y}, IM_COL32(90, 100, 110, 255));
  draw->AddRectFilled({x(band.low), y - 4.0F}, {std::max(x(band.high), x(band.low) + 2.0F), y + 4.0F},
                      IM_COL32(70, 130, 160, 255), 2.0F);
  draw->AddLine({x(asked), y - 7.0F}, {x(asked), y + 7.0F}, IM_COL32(230, 230, 230, 255), 1.5F);
  draw->AddCircleFilled({x(value), y}, 4.5F, ImGui::ColorConvertFloat4ToU32(colour_of(result)));
  ImGui::Dummy({wide, high_px});
}

void draw_criteria(const Debrief& debrief) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("criteria", 5, kTable)) return;
  ImGui::TableSetupColumn("To pass", ImGuiTableColumnFlags_WidthStretch, 2.6F);
  ImGui::TableSetupColumn("asked", ImGuiTableColumnFlags_WidthStretch, 1.3F);
  ImGui::TableSetupColumn("yours", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::TableSetupColumn("consultants", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableHeadersRow();
  for (const assessment::CriterionResult& result : debrief.grade.grade.criteria) {
    const assessment::Criterion& criterion = result.criterion;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", reports::metric_label(criterion.metric).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(assessment::limit_text(criterion, result.unit).c_str());
    ImGui::TableNextColumn();
    const casedb::MetricValue* value = reports::find_metric(debrief.attempt.metrics, criterion.metric);
    ImGui::TextUnformatted(value != nullptr ? reports::value_text(*value).c_str() : "–");
    ImGui::TableNextColumn();
    const std::string band = reports::band_text(debrief.grade.experts, criterion.metric, criterion.version);
    if (!band.empty()) {
      ImGui::TextUnformatted(band.c_str());
      quiet(reports::tolerance_text(debrief.grade.experts, criterion.metric, criterion.version).c_str());
      if (value != nullptr && value->value)
        draw_band(*debrief.grade.experts.find(criterion.metric, criterion.version), *value->value, result);
    }
    ImGui::TableNextColumn();
    ImGui::TextColored(colour_of(result), "%s", mark_of(result));
  }
  ImGui::EndTable();
  const assessment::ExpertSet& experts = debrief.grade.experts;
  quiet((reports::experts_text(experts) +
         (experts.standard() ? " Bar: 10th to 90th percentile; dot: yours; stroke: asked." : ""))
            .c_str());
}

void draw_steps(const Debrief& debrief) {
  for (const assessment::StepResult& step : debrief.steps) {
    if (step.state == assessment::StepState::not_asked) continue;
    const assessment::StepInfo* info = assessment::find_step(step.id);
    const char* mark = step.state == assessment::StepState::done      ? "✓"
                       : step.state == assessment::StepState::skipped ? "–"
                                                                      : "✗";
    ImGui::Text("%s", mark);
    ImGui::SameLine(28.0F);
    ImGui::TextWrapped("%s", info != nullptr ? info->words : step.id.c_str());
  }
}

}  // namespace

void DebriefPanel::draw(Trainer& trainer, const Keys& keys, const gpu::ScreenPicture* picture) {
  const Debrief& debrief = *trainer.debrief();
  begin_screen("debrief");
  heading(trainer.chosen().title.c_str());
  ImGui::SetWindowFontScale(1.6F);
  ImGui::TextColored(colour_of(debrief.grade.grade.verdict), "%s",
                     reports::verdict_text(debrief.grade.grade).c_str());
  ImGui::SetWindowFontScale(1.0F);
  if (debrief.grade.provisional) quiet("Provisional: no standard of consultants has been set for this case.");
  ImGui::Spacing();
  for (const assessment::Sentence& sentence : debrief.grade.debrief) {
    ImGui::Bullet();
    ImGui::TextWrapped("%s", sentence.text.c_str());
  }
  ImGui::Spacing();
  const float high = ImGui::GetContentRegionAvail().y - 50.0F;
  const float wide = ImGui::GetContentRegionAvail().x;
  ImGui::BeginChild("criteria", {0.60F * wide - 8.0F, high}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_criteria(debrief);
  ImGui::Spacing();
  if (picture != nullptr && picture->width_px() > 0) {
    const float across = std::min(ImGui::GetContentRegionAvail().x, 420.0F);
    quiet(debrief.attempt.end == casedb::AttemptEnd::fired ? "The picture when the trigger fell:"
                                                           : "The last picture:");
    ImGui::Image(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture->name())),
        {across, across * static_cast<float>(picture->height_px()) / static_cast<float>(picture->width_px())});
  }
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("steps", {0.0F, high}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  heading("Steps");
  draw_steps(debrief);
  ImGui::EndChild();
  // Done after the screen is drawn: what it shows goes with the debrief.
  enum class Wish { none, next, again, watch, expert, cases, log_out } wish = Wish::none;
  const auto button = [&](const char* words, int key, Wish its) {
    if (noted_button(words) || (key != 0 && keys.pressed(key))) wish = its;
    ImGui::SameLine();
  };
  const Choice* next = trainer.next();
  if (next != nullptr && !trainer.trying() && next->case_id != trainer.chosen().case_id)
    button(("Next: " + next->title + " (Enter)").c_str(), kEnter, Wish::next);
  ImGui::BeginDisabled(!trainer.once_more());
  button(trainer.once_more() ? "Again (F5)" : "No attempt left", kF5, Wish::again);
  ImGui::EndDisabled();
  if (!trainer.trying()) button("Watch it again (W)", 'W', Wish::watch);
  if (!trainer.expert_attempt().empty()) button("Watch an expert (E)", 'E', Wish::expert);
  if (trainer.trying())
    button("Back to the bench (Esc)", kEscape, Wish::cases);
  else
    button("Cases", 0, Wish::cases);
  button("Log out", 0, Wish::log_out);
  quiet(kTrainingOnly);
  end_screen();
  if (wish == Wish::next) trainer.choose(std::string(next->case_id));
  if (wish == Wish::again) trainer.again();
  if (wish == Wish::watch) trainer.watch(std::string(debrief.attempt.attempt_id));
  if (wish == Wish::expert) trainer.watch(std::string(trainer.expert_attempt()));
  if (wish == Wish::cases) trainer.back();
  if (wish == Wish::log_out) trainer.log_out();
}

}  // namespace seldinger::app
