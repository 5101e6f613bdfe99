#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "casedb/cases/setting_table.h"

namespace seldinger::app {
namespace {

std::string state_words(const Choice& choice) {
  if (!choice.open) return choice.attempts_left.value_or(1) > 0 ? "not open yet" : "no attempt left";
  std::string words = choice.due ? "next" : "";
  if (choice.reached) {
    std::string reached(assessment::name_of(*choice.reached));  // "not_started"
    std::replace(reached.begin(), reached.end(), '_', ' ');
    words += (words.empty() ? "" : " · ") + reached;
  }
  if (choice.attempts_left) words += " · " + std::to_string(*choice.attempts_left) + " left";
  return words;
}

constexpr float kThumbnailEm = 2.4F;  // of a row's picture, and so its height

// A cell's words, or a button, at the middle of the row's height.
void next_cell() {
  ImGui::TableNextColumn();
  const float over = kThumbnailEm * ImGui::GetFontSize() - ImGui::GetFrameHeight();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 0.5F * std::max(0.0F, over));
  ImGui::AlignTextToFramePadding();
}

}  // namespace

// Made meanwhile: a row without one has its room.
void ChoosePanel::draw_thumbnail(const Trainer& trainer, const std::string& case_id) {
  const float side = kThumbnailEm * ImGui::GetFontSize();
  const auto thumbnail = trainer.thumbnail(case_id);
  if (!thumbnail) {
    thumbnails_.erase(case_id);
    ImGui::Dummy({side, side});
    return;
  }
  auto& [shown, picture] = thumbnails_.try_emplace(case_id, context_).first->second;
  if (shown != thumbnail) picture.show(CaseThumbnail::kSidePx, CaseThumbnail::kSidePx, thumbnail->grey);
  shown = thumbnail;
  ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture.name())), {side, side});
  note_item("thumbnail");
  if (!thumbnail->target) return;
  const ImVec2 corner = ImGui::GetItemRectMin();
  ImGui::GetWindowDrawList()->AddCircle({corner.x + static_cast<float>(thumbnail->target->x) * side,
                                         corner.y + static_cast<float>(thumbnail->target->y) * side},
                                        0.09F * side, kTargetColour, 16, 1.5F);
}

void ChoosePanel::draw_choices(Trainer& trainer, const Keys& keys, const std::string& curriculum) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  const float em_px = ImGui::GetFontSize(), open_px = 7.6F * em_px, edit_px = 3.6F * em_px;  // of their words
  const bool edits = trainer.may(casedb::Action::make_case_version);
  if (!ImGui::BeginTable(("cases of " + curriculum).c_str(), 7, kTable)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, kThumbnailEm * em_px);
  ImGui::TableSetupColumn("Case", ImGuiTableColumnFlags_WidthStretch, 4.0F);
  ImGui::TableSetupColumn("Guidance", ImGuiTableColumnFlags_WidthStretch, 1.3F);
  ImGui::TableSetupColumn("Difficulty", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn("Passed", ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.0F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, edits ? open_px + 8.0F + edit_px : open_px);
  header_row();
  const auto open_one = std::ranges::find(trainer.choices(), true, &Choice::open);
  const Choice* const first = trainer.next() != nullptr             ? trainer.next()
                              : open_one != trainer.choices().end() ? &*open_one
                                                                    : nullptr;
  std::string chosen, versioned;
  for (const Choice& choice : trainer.choices()) {
    if (choice.curriculum != curriculum) continue;
    ImGui::PushID(choice.case_id.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_thumbnail(trainer, choice.case_id);
    next_cell();
    ImGui::TextUnformatted(choice.title.c_str());
    next_cell();
    ImGui::TextUnformatted(modality_words(choice.modality).c_str());
    next_cell();
    ImGui::TextUnformatted(base::name_of(casedb::kDifficultyNames, choice.difficulty).data());
    next_cell();
    if (choice.attempts > 0)
      ImGui::Text("%d of %d", choice.passes, choice.attempts);
    else
      ImGui::TextDisabled("–");
    next_cell();
    ImGui::TextUnformatted(state_words(choice).c_str());
    next_cell();
    ImGui::BeginDisabled(!choice.open);
    const bool next = trainer.next() == &choice;
    const bool open = ImGui::Button(next ? "Next (Enter)" : "Open", {open_px, 0.0F});
    if (first == &choice) ImGui::SetItemDefaultFocus();  // after a log-in by keys Enter begins to practise
    note_item("Practise");
    if (framed()) note_focus("Practise: " + choice.title);
    if (open || (next && keys.pressed(kEnter))) chosen = choice.case_id;
    ImGui::EndDisabled();
    if (edits) {
      ImGui::SameLine();
      if (noted_button("Edit", edit_px)) versioned = choice.case_id;
      if (framed()) note_focus("Edit: " + choice.title);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("Opens a new version of it as a draft in the case editor");
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (!chosen.empty()) trainer.choose(chosen);
  if (!versioned.empty()) trainer.new_version(versioned);
}

void ChoosePanel::draw_drafts(Trainer& trainer) {
  constexpr ImGuiTableFlags kTable = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  ImGui::Spacing();
  heading("Drafts and reviews");
  if (!ImGui::BeginTable("drafts", 7, kTable)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, kThumbnailEm * ImGui::GetFontSize());
  ImGui::TableSetupColumn("Draft", ImGuiTableColumnFlags_WidthStretch, 5.3F);
  ImGui::TableSetupColumn("Guidance", ImGuiTableColumnFlags_WidthStretch, 1.2F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 3.0F);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 6.2F * ImGui::GetFontSize());
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 5.6F * ImGui::GetFontSize());
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 4.4F * ImGui::GetFontSize());
  header_row();
  std::string opened, duplicated;
  for (const CaseDraft& draft : trainer.drafts()) {
    ImGui::PushID(draft.case_id.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_thumbnail(trainer, draft.case_id);
    next_cell();
    ImGui::TextUnformatted(draft.title.c_str());
    next_cell();
    ImGui::TextUnformatted(modality_words(draft.modality).c_str());
    next_cell();
    ImGui::Text("%s, version %d", draft.state == casedb::CaseState::review ? "in review" : "draft", draft.version);
    next_cell();
    if (noted_button("Open draft", -1.0F)) opened = draft.case_id;
    if (framed()) note_focus("Open draft: " + draft.title);
    next_cell();
    if (trainer.may(casedb::Action::make_case_version)) {
      if (noted_button("Duplicate", -1.0F)) duplicated = draft.case_id;
      if (framed()) note_focus("Duplicate: " + draft.title);
    }
    next_cell();
    if (trainer.may_delete(draft) && noted_button("Delete", -1.0F)) {
      to_delete_ = draft.case_id;
      question_.ask(
          "Delete the draft “" + draft.title + "”, version " + std::to_string(draft.version) +
              ", for good? What was drawn, its rule and its settings are lost; the CT stays with the cases "
              "that share it.",
          "Delete it", "Keep it");
    }
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (!opened.empty()) trainer.open_editor(opened);
  if (!duplicated.empty()) trainer.duplicate_draft(duplicated);
}

// What `seldinger import` asks, as a form; what it reads may be dropped on the window, too.
void ChoosePanel::draw_import(Trainer& trainer, const Keys& keys) {
  if (!importing_) return;
  constexpr const char* kName = "##import";
  if (!ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(scaled(640.0F), viewport->WorkSize.x - 40.0F), 0.0F});
  if (!ImGui::BeginPopupModal(kName, nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove)) return;
  heading("Import a CT");
  quiet("A folder of DICOM slices, or a file: DICOM, NIfTI, NRRD, MetaImage. Identifying data are left out.");
  ImGui::TextUnformatted("Folder or file (may be dropped on the window)");
  ImGui::SetNextItemWidth(-1.0F);
  if (std::exchange(import_begins_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::InputText("##source", source_.data(), source_.size());
  note_item("Folder or file");
  ImGui::TextUnformatted("Title, without anything of the patient");
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::InputText("##title", import_title_.data(), import_title_.size());
  note_item("Title");
  for (std::size_t i = 0; i < casedb::kModalityWords.size(); ++i) {
    const std::string words(casedb::kModalityWords[i].name);
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(words.c_str(), import_guidance_ == i)) import_guidance_ = i;
    note_item(words.c_str());
  }
  ImGui::Spacing();
  ImGui::BeginDisabled(source_[0] == '\0');
  const bool yes = noted_button("Import it");
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool no = noted_button("Not now (Esc)") || keys.pressed(kEscape);
  if (yes || no) {
    importing_ = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  if (yes)
    trainer.import_case({source_.data(), import_title_.data(), casedb::kModalityWords[import_guidance_].value});
}

void ChoosePanel::draw(Trainer& trainer, const Keys& pressed, const std::string& dropped) {
  const Keys none;
  const bool begins = !dropped.empty() && trainer.may_import() && !trainer.importing() && !question_.open();
  if (begins) {
    importing_ = import_begins_ = true;
    source_.fill('\0');
    dropped.copy(source_.data(), source_.size() - 1);
  }
  const Keys& keys = question_.open() || importing_ ? none : pressed;  // a question is answered first
  begin_screen("choose");
  heading(("Good to see you, " + trainer.account().login_name).c_str());
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - scaled(200.0F));
  const bool devices = noted_button("Hands (F10)");
  ImGui::SameLine();
  const bool out = noted_button("Log out");
  quiet(kTrainingOnly);
  if (trainer.importing()) {
    ImGui::TextUnformatted("A CT is being imported …");
  } else if (trainer.may_import() && noted_button("Import a CT")) {
    importing_ = import_begins_ = true;
    source_.fill('\0');
    import_title_.fill('\0');
  }
  if (!trainer.imported().empty()) {
    ImGui::TextWrapped("%s", trainer.imported().c_str());
    note_item("imported");
  }
  if (!trainer.refusal().empty()) {
    ImGui::Spacing();
    ImGui::TextWrapped("That did not work: %s", trainer.refusal().c_str());
    note_item("refused");
  }
  std::string answered;
  for (const casedb::Round& due : trainer.due_questionnaires())
    if (noted_button(("Questionnaire: " + due.title).c_str())) answered = due.round_id;
  ImGui::Spacing();
  if (trainer.choices().empty())
    ImGui::TextWrapped(
        "There is no case to practise yet. A mentor publishes them; `seldinger demo --cases` makes the graded "
        "cases "
        "that the program brings along.");
  std::string looked_at;
  if (!trainer.in_room().empty()) {
    ImGui::Spacing();
    heading("In the room now");
    for (const InRoom& one : trainer.in_room())
      if (noted_button(("Look in: " + one.who + ", " + one.case_title).c_str())) looked_at = one.attempt_id;
  }
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
  if (!trainer.drafts().empty()) draw_drafts(trainer);
  draw_import(trainer, pressed);
  if (question_.draw(pressed)) trainer.delete_draft(to_delete_);
  if (out) trainer.log_out();
  if (!answered.empty() && !out) trainer.answer(answered);
  if (!looked_at.empty() && !out) trainer.look_in(looked_at);
  if (devices && !out) trainer.show_devices();
  end_screen();
}

}  // namespace seldinger::app
