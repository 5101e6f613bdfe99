#include "app/window/screens/answering/panel_answering.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "session/monitor/monitor.h"

namespace seldinger::app {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::Item;
using questionnaire::ItemKind;

constexpr std::size_t kMostNumberBytes = 32;
constexpr float kCommentLines = 4.5F;

void wrapped_in(const ImVec4& colour, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", words.c_str());
  ImGui::PopStyleColor();
}

// A field for text of up to so many bytes; true: it was changed.
bool text_field(const char* label, std::string& text, std::size_t most, bool lines) {
  std::vector<char> typed(most + 1, '\0');
  text.copy(typed.data(), most);
  const bool changed = lines ? ImGui::InputTextMultiline(label, typed.data(), typed.size(),
                                                         {-1.0F, kCommentLines * ImGui::GetFontSize()})
                             : ImGui::InputText(label, typed.data(), typed.size());
  if (changed) text = typed.data();
  return changed;
}

}  // namespace

void AnsweringPanel::draw_item(Answering& answering, const Item& item) {
  const questionnaire::Form& form = answering.form();
  std::string typed = answering.typed(item.id);
  const auto type = [&](const std::string& text) { answering.type(item.id, text, session::clock_s()); };
  // One thing to tick, by its item and value: "8a: 4".
  const auto tick = [&](const std::string& value, const std::string& words, const std::string& name) {
    if (ImGui::RadioButton((words + "##" + value).c_str(), typed == value)) type(value);
    note_item((item.id + ": " + name).c_str());
  };
  ImGui::PushID(item.id.c_str());
  ImGui::Spacing();
  ImGui::TextWrapped("%s", item.text.c_str());
  if (const std::string problem = answering.problem(item.id); !problem.empty()) {
    wrapped_in({0.96F, 0.58F, 0.40F, 1.0F}, problem);
    note_item((item.id + ": problem").c_str());
  }
  ImGui::Indent();
  const std::string not_applicable(questionnaire::kNotApplicableWord);
  if (const questionnaire::Scale* scale = form.find_scale(item.scale))
    for (const questionnaire::ScalePoint& one : scale->points) {
      const std::string value = std::to_string(one.value);
      tick(value, one.label.empty() ? value : value + "  " + one.label, value);
    }
  for (const std::string& one : item.choices) tick(one, one, one);
  if (item.kind == ItemKind::number) {
    std::string number = typed == not_applicable ? std::string() : typed;
    ImGui::SetNextItemWidth(scaled(120.0F));
    if (text_field("##number", number, kMostNumberBytes, false)) type(number);
    note_item(item.id.c_str());
    ImGui::SameLine();
    quiet((item.unit + (item.whole ? ", a whole number from " : ", from ") +
           questionnaire::number_text(item.least) + " to " + questionnaire::number_text(item.most))
              .c_str());
  }
  if (item.kind == ItemKind::comment) {
    if (text_field("##comment", typed, questionnaire::kMostCommentBytes, true)) type(typed);
    note_item(item.id.c_str());
    quiet("Please do not name patients or colleagues.");
  }
  if (item.not_applicable) tick(not_applicable, "Not applicable", not_applicable);
  if (item.kind == ItemKind::scale || item.kind == ItemKind::choice) tick("", "No answer", "none");
  ImGui::Unindent();
  ImGui::PopID();
}

// What is there and what is not, before it is sent.
void AnsweringPanel::draw_last_look(Answering& answering) {
  const auto open = answering.open_items();
  ImGui::TextWrapped("%s",
                     open.empty() ? "Every question has an answer." : "Not answered (you may leave these blank):");
  for (const auto& [section, item] : open) {
    ImGui::PushID(item->id.c_str());
    if (ImGui::SmallButton("Answer it")) answering.go_to(section);
    note_item(("Answer " + item->id).c_str());
    ImGui::PopID();
    ImGui::SameLine();
    ImGui::TextWrapped("%s", item->text.c_str());
  }
  ImGui::Spacing();
  ImGui::TextWrapped("Once sent, your answers cannot be changed.");
}

void AnsweringPanel::draw(Trainer& trainer, const Keys& keys) {
  Answering& answering = *trainer.answering();
  const std::size_t section = answering.section(), sections = answering.sections().size();
  const bool last = answering.last_look();
  begin_screen("answer");
  heading(answering.form().title.c_str());
  ImGui::SameLine();
  quiet(kTrainingOnly);
  if (section == 0 && !answering.form().introduction.empty())
    ImGui::TextWrapped("%s", answering.form().introduction.c_str());
  quiet(
      (last ? std::string("Last look") : std::to_string(section + 1) + " of " + std::to_string(sections)).c_str());
  const std::string headed = last ? "Ready to send?" : answering.sections()[section].front()->section;
  if (!headed.empty()) heading(headed.c_str());
  begin_fields("items", 0.0F, ImGui::GetContentRegionAvail().y - buttons_px_);
  if (section != shown_) ImGui::SetScrollY(0.0F);
  shown_ = section;
  if (last)
    draw_last_look(answering);
  else
    for (const Item* item : answering.sections()[section]) draw_item(answering, *item);
  ImGui::EndChild();
  const float from_px = ImGui::GetCursorPosY();
  if (!trainer.refusal().empty()) {
    ImGui::TextWrapped("That did not work: %s", trainer.refusal().c_str());
    note_item("refused");
  }
  const bool forth = noted_button(last ? "Send" : "Next");
  ImGui::SameLine();
  ImGui::BeginDisabled(section == 0);
  const bool back = noted_button("Back");
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool later = noted_button("Later (Esc)") || keys.pressed(kEscape);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  quiet((std::string(answering.lost() ? "What you type is not being saved at the moment."
                                      : "What you type is saved, whatever happens to this window.") +
         " Your participant code: " + answering.respondent() + ".")
            .c_str());
  buttons_px_ = ImGui::GetCursorPosY() - from_px + ImGui::GetStyle().ItemSpacing.y;
  end_screen();
  if (back) answering.back();
  if (forth && !last) answering.next();
  if (later)
    trainer.leave_answers();
  else if (forth && last)
    trainer.send_answers();
}

}  // namespace seldinger::app
