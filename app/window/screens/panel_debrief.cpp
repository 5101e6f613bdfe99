#include "app/window/screens/panel_debrief.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "assessment/fault_moments.h"
#include "assessment/grading/plain_words.h"
#include "assessment/grading/reason_words.h"
#include "assessment/procedure/steps.h"
#include "reports/words/attempt_words.h"
#include "reports/words/condition_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_card.h"
#include "reports/words/metric_words.h"
#include "reports/words/shown_metrics.h"
#include "reports/words/step_card.h"

namespace seldinger::app {
namespace {

constexpr double kLeadS = 3.0;    // a moment is played from so long before: how it came about is what teaches
constexpr float kSignPx = 28.0F;  // where a step's words begin, behind its sign
const ImVec4 kQuiet = {0.62F, 0.66F, 0.70F, 1.0F}, kLink = {0.62F, 0.86F, 0.97F, 1.0F};

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

// The value that was held against the limit, with as many digits as tell the two apart; or why there is none.
std::string value_text(const assessment::CriterionResult& result) {
  if (!result.value) return "—";
  if (result.unit == "bool") return *result.value != 0.0 ? "yes" : "no";
  return assessment::plain_apart(*result.value, result.criterion.value, result.unit).first;
}

// The experts' band on a line, where the trainee's value lies to it (a dot), and what was asked (a stroke).
void draw_band(const assessment::MetricBand& band, double value, const assessment::CriterionResult& result) {
  const double asked = result.criterion.value;
  const double low = std::min({band.low, value, asked}), high = std::max({band.high, value, asked});
  if (!(high > low)) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x - 6.0F, high_px = scaled(14.0F),
              y = corner.y + 0.5F * high_px;
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

void wrapped(const ImVec4& colour, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", words.c_str());
  ImGui::PopStyleColor();
}

ImVec4 colour_of(assessment::StepState state) {
  if (state == assessment::StepState::done) return {0.45F, 0.85F, 0.55F, 1.0F};
  if (state == assessment::StepState::violated) return {0.96F, 0.58F, 0.40F, 1.0F};
  return {0.80F, 0.82F, 0.84F, 1.0F};
}

std::optional<double> when(const assessment::FaultMoment* fault) {
  return fault != nullptr ? std::optional(fault->t_s) : std::nullopt;
}

bool was_asked(const assessment::StepResult& step) {
  return step.state != assessment::StepState::not_asked;
}

void draw_legend(const std::vector<assessment::StepResult>& steps) {
  for (const reports::StepMark* mark : reports::step_legend(steps)) {
    ImGui::TextColored(kQuiet, "%s", mark->sign);
    ImGui::SameLine(scaled(kSignPx));
    const std::string words = mark->told ? "(" + std::string(mark->words) + ")" : mark->words;
    wrapped(kQuiet, words + ": " + mark->meaning);
  }
  note_item("Legend of the steps");
  ImGui::Separator();
}

void draw_picture(const Debrief& debrief, const gpu::ScreenPicture* picture) {
  if (picture == nullptr || picture->width_px() <= 0) return;
  ImGui::Spacing();
  const float across = std::min(ImGui::GetContentRegionAvail().x, scaled(420.0F));
  quiet(debrief.attempt.end == casedb::AttemptEnd::fired ? "The picture at the moment of firing:"
                                                         : "The last picture:");
  ImGui::Image(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture->name())),
      {across, across * static_cast<float>(picture->height_px()) / static_cast<float>(picture->width_px())});
}

}  // namespace

void DebriefPanel::line(const char* name, Line line, bool underlined) {
  lines_.push_back(std::move(line));
  hear(name, static_cast<int>(lines_.size()) - 1, underlined);
}

void DebriefPanel::hear(const char* name, int own, bool underlined) {
  note_item(name);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (underlined) draw->AddLine({from.x, to.y}, {to.x, to.y}, IM_COL32(158, 219, 247, 110));
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (hovered || asked_ == own)
    draw->AddRectFilled({from.x - 4.0F, from.y - 2.0F}, {to.x + 4.0F, to.y + 2.0F},
                        asked_ == own ? IM_COL32(110, 180, 215, 60) : IM_COL32(110, 180, 215, 30), 3.0F);
  if (asked_ == own && sought_) {
    ImGui::SetScrollHereY();
    sought_ = false;
  }
  if (ImGui::IsItemClicked()) asked_ = own;
}

// Escape closes the definition before it leaves the screen; Down and Up go through what was measured.
void DebriefPanel::read_keys(const Keys& keys) {
  const int all = static_cast<int>(lines_.size());
  if (keys.pressed('A')) {
    all_ = !all_;
    asked_ = -1;
    return;
  }
  const int step = (keys.pressed(kDown) ? 1 : 0) - (keys.pressed(kUp) ? 1 : 0);
  if (step != 0 && all > 0) {
    asked_ = asked_ < 0 ? (step > 0 ? 0 : all - 1) : std::clamp(asked_ + step, 0, all - 1);
    sought_ = true;
  }
  if (keys.pressed('P') && asked_ >= 0 && asked_ < all && !attempt_id_.empty())
    play_s_ = lines_[static_cast<std::size_t>(asked_)].t_s;
  if (keys.pressed(kEscape)) asked_ = -1;
}

// When it happened and what it was; one click plays it, where the attempt is kept.
void DebriefPanel::fault(const std::string& of, const std::string& words, double t_s) {
  if (attempt_id_.empty()) {
    quiet((words + ", " + reports::clock_text(t_s)).c_str());
    return;
  }
  ImGui::PushID(of.c_str());
  if (ImGui::SmallButton(("Play " + reports::clock_text(t_s)).c_str())) play_s_ = t_s;
  note_item(("Play " + of).c_str());
  ImGui::PopID();
  ImGui::SameLine();
  wrapped(kQuiet, words);
}

void DebriefPanel::draw_sentences(const Debrief& debrief) {
  int number = 0;
  for (const assessment::Sentence& sentence : debrief.grade.debrief) {
    const std::string name = "Sentence " + std::to_string(++number);
    ImGui::Bullet();
    ImGui::TextWrapped("%s", sentence.text.c_str());
    if (!sentence.metric_id.empty()) line(name.c_str(), {Of::metric, sentence.metric_id, sentence.text}, false);
  }
}

void DebriefPanel::draw_criteria(const Debrief& debrief) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (debrief.grade.grade.criteria.empty()) return;
  const assessment::ExpertSet& experts = debrief.grade.experts;
  const bool banded = experts.standard();
  if (!ImGui::BeginTable("criteria", banded ? 5 : 4, kTable)) return;
  ImGui::TableSetupColumn("To pass", ImGuiTableColumnFlags_WidthStretch, 2.6F);
  ImGui::TableSetupColumn("Asked", ImGuiTableColumnFlags_WidthStretch, 1.3F);
  ImGui::TableSetupColumn("Yours", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  if (banded) ImGui::TableSetupColumn("Consultants", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn("Result", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  header_row();
  for (const assessment::CriterionResult& result : debrief.grade.grade.criteria) {
    const assessment::Criterion& criterion = result.criterion;
    const std::string label = reports::metric_label(criterion.metric), own = value_text(result);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    wrapped(kLink, label);
    const std::string yours =
        result.value ? "Yours: " + own : "Yours: no value, as " + assessment::reason_words(result.reason);
    const assessment::FaultMoment* wrong = nullptr;
    if (result.outcome == assessment::Outcome::missed)
      wrong = assessment::find_fault(debrief.faults, criterion.metric, criterion.value);
    line(label.c_str(), {Of::metric, criterion.metric, yours, criterion.version, when(wrong)}, true);
    if (wrong != nullptr) fault(label, wrong->words, wrong->t_s);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", assessment::limit_text(criterion, result.unit).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(own.c_str());
    if (banded) ImGui::TableNextColumn();
    const std::string band = reports::band_text(experts, criterion.metric, criterion.version);
    if (!band.empty()) {
      ImGui::TextWrapped("%s", band.c_str());
      quiet(reports::tolerance_text(experts, criterion.metric, criterion.version).c_str());
      if (result.value) draw_band(*experts.find(criterion.metric, criterion.version), *result.value, result);
    }
    ImGui::TableNextColumn();
    wrapped(colour_of(result), mark_of(result));
  }
  ImGui::EndTable();
  // Without one the screen's head says that the grade is provisional, and no more: how many are missing is no
  // trainee's concern.
  if (banded)
    quiet(
        (reports::experts_text(experts) + " Bar: 10th to 90th percentile; dot: yours; stroke: the limit.").c_str());
}

void DebriefPanel::draw_values(const Debrief& debrief) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  for (const std::string& group : reports::metric_groups()) {
    const auto metrics = reports::shown_metrics(debrief.attempt, group);
    if (metrics.empty() || !ImGui::BeginTable(group.c_str(), 2, kTable)) continue;
    ImGui::TableSetupColumn(group.c_str(), ImGuiTableColumnFlags_WidthStretch, 1.0F);
    ImGui::TableSetupColumn("Yours", ImGuiTableColumnFlags_WidthStretch, 1.0F);
    header_row();
    for (const casedb::MetricValue* metric : metrics) {
      const std::string label = reports::metric_label(metric->id), why = reports::reason_text(*metric);
      const std::string own = reports::value_text(*metric);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      wrapped(kLink, label);
      const std::string yours = why.empty() ? "Yours: " + own : "Yours: no value, as " + why;
      line(label.c_str(), {Of::metric, metric->id, yours, metric->version}, true);
      ImGui::TableNextColumn();
      if (why.empty())
        ImGui::TextWrapped("%s", own.c_str());
      else
        wrapped(kQuiet, "— " + why);
    }
    ImGui::EndTable();
    ImGui::Spacing();
  }
}

void DebriefPanel::draw_measured(const Debrief& debrief, const gpu::ScreenPicture* picture) {
  if (all_)
    draw_values(debrief);
  else
    draw_criteria(debrief);
  draw_plan_and_done(debrief);
  draw_own_attempts(debrief);
  draw_picture(debrief, picture);
}

void DebriefPanel::add_steps(const Debrief& debrief) {
  for (const assessment::StepResult& step : debrief.steps)
    if (was_asked(step))
      lines_.push_back({Of::step, step.id, reports::step_result_text(step), step.version,
                        reports::step_fault_text(step).empty() ? std::nullopt : step.t_s});
}

void DebriefPanel::draw_steps(const Debrief& debrief, int first) {
  heading("Steps");
  if (std::none_of(debrief.steps.begin(), debrief.steps.end(), was_asked)) {
    quiet("None is required here.");
    return;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8.0F, 3.0F});  // a whole procedure at a glance
  draw_legend(debrief.steps);
  for (const assessment::StepResult& step : debrief.steps) {
    if (!was_asked(step)) continue;
    ImGui::TextColored(colour_of(step.state), "%s", reports::step_mark(step).sign);
    ImGui::SameLine(scaled(kSignPx));
    ImGui::TextWrapped("%s", reports::step_text(step).c_str());
    hear(reports::step_label(step.id).c_str(), first++, false);
    if (const std::string why = reports::step_fault_text(step); !why.empty()) {
      ImGui::Dummy({scaled(kSignPx) - ImGui::GetStyle().ItemSpacing.x, 0.0F});
      ImGui::SameLine(scaled(kSignPx));
      fault(reports::step_label(step.id), why, *step.t_s);
    }
  }
  ImGui::PopStyleVar();
}

void DebriefPanel::draw_definition(const Debrief& debrief) {
  const Line& about = lines_[static_cast<std::size_t>(asked_)];
  if (about_ != about) {
    card_ = about.of == Of::step ? reports::step_card(about.id, about.version)
                                 : reports::metric_card(about.id, about.version);
    about_ = about;
    ImGui::SetScrollY(0.0F);
  }
  wrapped(kLink, card_.label);
  note_item(("Definition of " + card_.label).c_str());
  // In sight however small the window.
  if (about.t_s && !attempt_id_.empty()) {
    if (noted_button(("Play this moment, " + reports::clock_text(*about.t_s) + " (P)").c_str()))
      play_s_ = about.t_s;
    ImGui::SameLine();
  }
  if (noted_button("Back to the steps (Esc)")) asked_ = -1;
  ImGui::TextWrapped("%s", about_.words.c_str());
  ImGui::Spacing();
  ImGui::TextWrapped("%s", card_.definition.c_str());
  if (about_.of == Of::metric) draw_own_values(debrief, about_.id, about_.version);
  for (const reports::CardLine& one : card_.lines) {
    ImGui::Spacing();
    wrapped(kQuiet, one.name);
    ImGui::TextWrapped("%s", one.text.c_str());
  }
}

void DebriefPanel::draw(Trainer& trainer, const Keys& keys, const gpu::ScreenPicture* picture) {
  const Debrief& debrief = *trainer.debrief();
  if (attempt_id_ != debrief.attempt.attempt_id) {
    attempt_id_ = debrief.attempt.attempt_id;
    lines_.clear();
    asked_ = -1;
    all_ = false;
  }
  const bool escapes = asked_ < 0;
  play_s_.reset();
  read_keys(keys);
  lines_.clear();
  begin_screen("debrief");
  heading(trainer.chosen().title.c_str());
  ImGui::SameLine();
  quiet(kTrainingOnly);
  ImGui::SetWindowFontScale(1.6F);
  ImGui::TextColored(colour_of(debrief.grade.grade.verdict), "%s",
                     reports::verdict_text(debrief.grade.grade).c_str());
  ImGui::SetWindowFontScale(1.0F);
  if (debrief.grade.provisional) quiet("Provisional: no consultant standard has been set for this case.");
  if (trainer.dependability())
    quiet(reports::dependability_line(*trainer.dependability(), casedb::Learners::people).c_str());
  if (const std::string away = reports::away_text(debrief.attempt); !away.empty()) quiet(away.c_str());
  const std::string made = reports::conditions_text(debrief.attempt.conditions, std::nullopt);
  if (!made.empty()) quiet(("Made with " + made + ".").c_str());
  draw_missing(trainer);
  ImGui::Spacing();
  draw_sentences(debrief);
  ImGui::Spacing();
  if (noted_button(all_ ? "To pass (A)" : "All values (A)")) {
    all_ = !all_;
    asked_ = -1;
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  quiet("Click on a line or a step, or press Down, for what it means and how it is measured.");
  const float high = ImGui::GetContentRegionAvail().y - buttons_px_;
  const float wide = ImGui::GetContentRegionAvail().x;
  begin_fields("criteria", 0.60F * wide - 8.0F, high);
  draw_measured(debrief, picture);
  ImGui::EndChild();
  ImGui::SameLine();
  const int first_step = static_cast<int>(lines_.size());
  add_steps(debrief);
  asked_ = std::min(asked_, static_cast<int>(lines_.size()) - 1);
  if (asked_ >= first_step) sought_ = false;  // its definition is what is seen
  begin_fields(asked_ < 0 ? "steps" : "definition", 0.0F, high);
  if (asked_ < 0)
    draw_steps(debrief, first_step);
  else
    draw_definition(debrief);
  ImGui::EndChild();
  const float from_px = ImGui::GetCursorPosY();
  const Wish wish = draw_debrief_buttons(trainer, keys, escapes);
  buttons_px_ = ImGui::GetCursorPosY() - from_px + ImGui::GetStyle().ItemSpacing.y;
  end_screen();
  if (play_s_ && wish == Wish::none)
    trainer.watch(std::string(debrief.attempt.attempt_id), std::max(0.0, *play_s_ - kLeadS));
  do_wish(trainer, wish);
}

}  // namespace seldinger::app
