#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "app/train/panels.h"
#include "assessment/procedure/steps.h"
#include "reports/grade_words.h"
#include "reports/metric_words.h"

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

void draw_criteria(const Debrief& debrief) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("criteria", 5, kTable)) return;
  ImGui::TableSetupColumn("To pass", ImGuiTableColumnFlags_WidthStretch, 2.6F);
  ImGui::TableSetupColumn("asked", ImGuiTableColumnFlags_WidthStretch, 1.3F);
  ImGui::TableSetupColumn("yours", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::TableSetupColumn("experts", ImGuiTableColumnFlags_WidthStretch, 1.2F);
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
    ImGui::TextUnformatted(reports::band_text(debrief.grade.experts, criterion.metric, criterion.version).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(mark_of(result));
  }
  ImGui::EndTable();
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
  if (debrief.grade.provisional)
    quiet("Provisional: fewer than eight consultants have set the standard for this case.");
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
    quiet("The picture when the trigger fell:");
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
  if (ImGui::Button("Again (F5)") || keys.pressed(kF5)) trainer.again();
  ImGui::SameLine();
  if (!trainer.trying()) {
    const bool watch = ImGui::Button("Watch it again (W)") || keys.pressed('W');
    if (watch) trainer.watch(debrief.attempt.attempt_id);
    ImGui::SameLine();
  }
  if (ImGui::Button(trainer.trying() ? "Back to the bench (Esc)" : "Cases") ||
      (trainer.trying() && keys.pressed(kEscape))) {
    trainer.back();
    end_screen();
    return;
  }
  ImGui::SameLine();
  if (ImGui::Button("Log out")) trainer.log_out();
  ImGui::SameLine();
  quiet(kTrainingOnly);
  end_screen();
}

}  // namespace seldinger::app
