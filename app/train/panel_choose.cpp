#include <imgui.h>

#include "app/train/panels.h"

namespace seldinger::app {
namespace {

std::string state_words(const Choice& choice) {
  if (!choice.open) return choice.attempts_left.value_or(1) > 0 ? "not open yet" : "no attempt left";
  std::string words = choice.due ? "next" : "";
  if (!choice.reached.empty()) words += (words.empty() ? "" : " · ") + choice.reached;
  if (choice.attempts_left) words += " · " + std::to_string(*choice.attempts_left) + " left";
  return words;
}

void draw_choices(Trainer& trainer, const Keys& keys, const std::string& curriculum) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable(("cases of " + curriculum).c_str(), 6, kTable)) return;
  ImGui::TableSetupColumn("Case", ImGuiTableColumnFlags_WidthStretch, 4.0F);
  ImGui::TableSetupColumn("Guidance", ImGuiTableColumnFlags_WidthStretch, 1.3F);
  ImGui::TableSetupColumn("Difficulty", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn("Passed", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.0F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::TableHeadersRow();
  std::string chosen;
  for (const Choice& choice : trainer.choices()) {
    if (choice.curriculum != curriculum) continue;
    ImGui::PushID(choice.case_id.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(choice.title.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(modality_words(choice.modality).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(casedb::kDifficultyNames[static_cast<std::size_t>(choice.difficulty)].data());
    ImGui::TableNextColumn();
    if (choice.attempts > 0)
      ImGui::Text("%d of %d", choice.passes, choice.attempts);
    else
      ImGui::TextDisabled("–");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(state_words(choice).c_str());
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(!choice.open);
    const bool next = trainer.next() == &choice;
    if (ImGui::Button(next ? "Next (Enter)" : "Open", {-1.0F, 0.0F}) || (next && keys.pressed(kEnter)))
      chosen = choice.case_id;
    ImGui::EndDisabled();
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (!chosen.empty()) trainer.choose(chosen);
}

}  // namespace

void ChoosePanel::draw(Trainer& trainer, const Keys& keys) {
  begin_screen("choose");
  heading(("Good to see you, " + trainer.account().login_name).c_str());
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - 90.0F);
  const bool out = ImGui::Button("Log out");
  quiet(kTrainingOnly);
  if (!trainer.refusal().empty()) {
    ImGui::Spacing();
    ImGui::TextWrapped("That did not work: %s", trainer.refusal().c_str());
  }
  ImGui::Spacing();
  if (trainer.choices().empty())
    ImGui::TextWrapped(
        "There is no case to practise yet. A mentor publishes them; `seldinger demo --cases` makes the graded "
        "cases "
        "that the program brings along.");
  std::string curriculum;
  bool first = true;
  const auto choices = trainer.choices();  // a button may change them
  for (const Choice& choice : choices) {
    if (!first && choice.curriculum == curriculum) continue;
    first = false;
    curriculum = choice.curriculum;
    ImGui::Spacing();
    heading(curriculum.empty() ? "Free practice" : curriculum.c_str());
    draw_choices(trainer, keys, curriculum);
  }
  if (out) trainer.log_out();
  end_screen();
}

}  // namespace seldinger::app
