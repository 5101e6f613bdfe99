#include "app/window/screens/panel_debrief_buttons.h"

#include <imgui.h>

#include <string>

#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "reports/words/grade_words.h"

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

}  // namespace

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
  if (trainer.trying())
    button("Back to the case editor (Esc)", escapes ? static_cast<int>(kEscape) : 0, Wish::cases);
  else
    button("Cases", 0, Wish::cases);
  button("Log out", 0, Wish::log_out);
  return wish;
}

void do_wish(Trainer& trainer, Wish wish) {
  if (wish == Wish::next) trainer.choose(std::string(next_of(trainer)->case_id));
  if (wish == Wish::again) trainer.again();
  if (wish == Wish::watch) trainer.watch(std::string(trainer.debrief()->attempt.attempt_id));
  if (wish == Wish::expert) trainer.watch(std::string(trainer.expert_attempt()));
  if (wish == Wish::cases) trainer.back();
  if (wish == Wish::log_out) trainer.log_out();
}

}  // namespace seldinger::app
