
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/window/screens/panel_debrief.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "app/window/trainer/plan_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

bool passed(const Trainer& trainer) {
  return trainer.debrief()->grade.grade.verdict == assessment::Verdict::passed;
}

// After a pass there is always one: where no other case is open, this one again.
const Choice* next_of(const Trainer& trainer) {
  if (trainer.trying()) return nullptr;
  return passed(trainer) ? trainer.after_pass() : trainer.next();
}

ImU32 colour_of_verdict(assessment::Verdict verdict) {
  if (verdict == assessment::Verdict::passed) return IM_COL32(115, 215, 140, 255);
  if (verdict == assessment::Verdict::failed) return IM_COL32(245, 148, 102, 255);
  return IM_COL32(165, 170, 178, 255);
}

// Room for a drawing as wide as there is, on a ground of its own; its corner.
ImVec2 begin_drawing(const char* name, float height, float& width) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  width = std::min(ImGui::GetContentRegionAvail().x - 6.0F, scaled(420.0F));
  ImGui::Dummy({width, height});
  note_item(name);
  ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + height},
                                            IM_COL32(255, 255, 255, 12), 3.0F);
  return corner;
}

// Of one metric in an attempt that was graded by it.
const assessment::CriterionResult* result_of(const OwnAttempt& attempt, const std::string& metric_id, int version) {
  for (const assessment::CriterionResult& one : attempt.grade.criteria)
    if (one.criterion.metric == metric_id && one.criterion.version == version) return &one;
  return nullptr;
}

}  // namespace

void draw_plan_and_done(const Debrief& debrief) {
  const auto planned = casedb::planned_path(debrief.attempt.conditions);
  if (!planned) return;
  ImGui::Spacing();
  heading("Your plan, and what you did");
  for (const std::string& line : compared_words(*planned, debrief.path ? &debrief.path->path : nullptr)) {
    ImGui::Bullet();
    ImGui::TextWrapped("%s", line.c_str());
    note_item(line.c_str());
  }
}

void draw_own_attempts(const Debrief& debrief) {
  if (debrief.own.size() < 2) return;
  std::size_t most = 1;
  int passes = 0;
  for (const OwnAttempt& one : debrief.own) {
    most = std::max(most, one.grade.criteria.size());
    passes += one.grade.verdict == assessment::Verdict::passed ? 1 : 0;
  }
  ImGui::Spacing();
  heading("Your attempts here");
  const float high = scaled(72.0F), bar = scaled(14.0F);
  float wide = 0.0F;
  const ImVec2 corner = begin_drawing("Your attempts here", high, wide);
  const float step = std::min(scaled(36.0F), wide / static_cast<float>(debrief.own.size()));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < debrief.own.size(); ++i) {
    const OwnAttempt& one = debrief.own[i];
    const float x = corner.x + step * (static_cast<float>(i) + 0.5F), foot = corner.y + high - 4.0F;
    const float share = static_cast<float>(one.grade.met()) / static_cast<float>(most);
    const float top = foot - std::max(2.0F, share * (high - 8.0F));
    draw->AddRectFilled({x - 0.5F * std::min(bar, 0.7F * step), top}, {x + 0.5F * std::min(bar, 0.7F * step), foot},
                        colour_of_verdict(one.grade.verdict), 2.0F);
    if (one.attempt_id == debrief.attempt.attempt_id)
      draw->AddCircleFilled({x, std::max(corner.y + 3.0F, top - 5.0F)}, 2.5F, IM_COL32(230, 230, 230, 255));
  }
  const std::string words = "For each, oldest first, how many it met of the " + std::to_string(most) +
                            " things asked for; green: passed, " + std::to_string(passes) + " of " +
                            std::to_string(debrief.own.size()) + ". Dot: this one.";
  quiet(words.c_str());
  note_item(words.c_str());
}

// On a line from the least to the greatest of values and limit.
void draw_own_values(const Debrief& debrief, const std::string& metric_id, int version) {
  struct Dot {
    double value;
    assessment::Outcome outcome;
    bool is_this;
  };
  std::vector<std::optional<Dot>> dots;
  const assessment::CriterionResult* any = nullptr;
  std::size_t known = 0;
  for (const OwnAttempt& one : debrief.own) {
    const assessment::CriterionResult* result = result_of(one, metric_id, version);
    const bool measured = result != nullptr && result->value.has_value();
    dots.push_back(
        measured ? std::optional(Dot{*result->value, result->outcome, one.attempt_id == debrief.attempt.attempt_id})
                 : std::nullopt);
    if (!measured) continue;
    any = result;
    ++known;
  }
  if (known < 2) return;
  double low = any->criterion.value, high = low;
  for (const auto& dot : dots)
    if (dot) low = std::min(low, dot->value), high = std::max(high, dot->value);
  if (!(high > low)) high = low + 1.0;
  ImGui::Spacing();
  const float tall = scaled(84.0F);
  float wide = 0.0F;
  const ImVec2 corner = begin_drawing("Your values", tall, wide);
  const auto y = [&](double value) {
    return corner.y + tall - 8.0F - (tall - 16.0F) * static_cast<float>((value - low) / (high - low));
  };
  const float step = std::min(scaled(36.0F), wide / static_cast<float>(dots.size()));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine({corner.x, y(any->criterion.value)}, {corner.x + wide, y(any->criterion.value)},
                IM_COL32(230, 230, 230, 120), 1.0F);
  std::optional<ImVec2> before;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (!dots[i]) continue;
    const ImVec2 at{corner.x + step * (static_cast<float>(i) + 0.5F), y(dots[i]->value)};
    if (before) draw->AddLine(*before, at, IM_COL32(150, 170, 185, 160), 1.0F);
    const bool met = dots[i]->outcome == assessment::Outcome::met;
    draw->AddCircleFilled(at, dots[i]->is_this ? 5.5F : 3.5F,
                          colour_of_verdict(met ? assessment::Verdict::passed : assessment::Verdict::failed));
    before = at;
  }
  quiet(("Yours, attempt by attempt; from " + reports::number_text(low, 1) + " to " +
         reports::number_text(high, 1) + ". Line: " + assessment::limit_text(any->criterion, any->unit) +
         "; large dot: this one.")
            .c_str());
}

void draw_missing(const Trainer& trainer) {
  const Choice* own = trainer.own_choice();
  const assessment::Verdict verdict = trainer.debrief()->grade.grade.verdict;
  if (trainer.trying() || own == nullptr || verdict == assessment::Verdict::no_rule) return;
  ImGui::TextWrapped("%s", reports::proficiency_text(own->passes_missing).c_str());
  note_item("What is missing");
}

Wish draw_debrief_buttons(Trainer& trainer, const Keys& keys, bool escapes) {
  Wish wish = Wish::none;
  bool first = true;
  // In a second row where the window is too narrow for all of them.
  const auto button = [&](const std::string& words, int key, Wish its) {
    const float wide = ImGui::CalcTextSize(words.c_str()).x + 2.0F * ImGui::GetStyle().FramePadding.x;
    if (!first) {
      ImGui::SameLine();
      if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
    }
    first = false;
    if (noted_button(words.c_str()) || (key != 0 && keys.pressed(key))) wish = its;
  };
  if (!trainer.due_questionnaires().empty())
    button("Questionnaire: " + trainer.due_questionnaires().front().title + " (Q)", 'Q', Wish::answer);
  const Choice* next = next_of(trainer);
  if (next != nullptr && next->case_id != trainer.chosen().case_id)
    button("Next: " + next->title + " (Enter)", kEnter, Wish::next);
  else if (next != nullptr && passed(trainer) && trainer.once_more())
    button("Next: once more (Enter)", kEnter, Wish::again);
  ImGui::BeginDisabled(!trainer.once_more());
  button(trainer.once_more() ? "Again (F5)" : "No attempt left", kF5, Wish::again);
  ImGui::EndDisabled();
  if (!trainer.trying()) button("Watch it again (W)", 'W', Wish::watch);
  if (!trainer.expert_attempt().empty()) button("Watch an expert (E)", 'E', Wish::expert);
  if (!trainer.expert_attempt().empty() && !trainer.trying())
    button("Mine beside the expert’s (B)", 'B', Wish::both);
  if (trainer.trying())
    button("Back to the case editor (Esc)", escapes ? static_cast<int>(kEscape) : 0, Wish::cases);
  else
    button("Cases", 0, Wish::cases);
  button("Log out", 0, Wish::log_out);
  return wish;
}

void do_wish(Trainer& trainer, Wish wish) {
  if (wish == Wish::answer) trainer.answer(std::string(trainer.due_questionnaires().front().round_id));
  if (wish == Wish::next) trainer.choose(std::string(next_of(trainer)->case_id));
  if (wish == Wish::again) trainer.again();
  if (wish == Wish::watch) trainer.watch(std::string(trainer.debrief()->attempt.attempt_id));
  if (wish == Wish::expert) trainer.watch(std::string(trainer.expert_attempt()));
  if (wish == Wish::both) trainer.watch_beside_expert();
  if (wish == Wish::cases) trainer.back();
  if (wish == Wish::log_out) trainer.log_out();
}

}  // namespace seldinger::app
