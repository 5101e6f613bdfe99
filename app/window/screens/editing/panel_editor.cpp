#include "app/window/screens/editing/panel_editor.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/attempts/rehearsal_words.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "reports/words/check_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

struct ToolButton {
  EditorTool tool;
  int key;
  const char* label;
};
constexpr std::array<ToolButton, 6> kTools = {{{EditorTool::look, 'V', "Look (V)"},
                                               {EditorTool::lesion, 'L', "Lesion (L)"},
                                               {EditorTool::structure, 'T', "Structure (T)"},
                                               {EditorTool::entry, 'E', "Entry (E)"},
                                               {EditorTool::rule, 'R', "Case and rule (R)"},
                                               {EditorTool::prepare, 'P', "CT (P)"}}};

constexpr int kHome = 268, kDelete = 261;  // as GLFW numbers them
constexpr float kRightPx = 400.0F;

constexpr const char* kHelp =
    "In a plane: click or drag – by the tool in hand · wheel – slice by slice · Ctrl and wheel – nearer · right "
    "drag – "
    "move the plane · middle drag – window\n"
    "In the room: drag – turn · right drag – move · wheel – nearer · click – there, with Entry in hand the planned "
    "entry\n"
    "Lesion: click – its middle; drag its middle or its rim. Structure: the same; a tube takes a point with each "
    "click "
    "and is done with Enter\n"
    "CT: left as it came, right as it is prepared; in the histogram – drag – the skin's value\n"
    "Keys: V L T E R P – tools · Z – undo · W – next window · Home – all of the CT · C – room cut away · Del – "
    "remove what is chosen · Enter, Esc – finish, drop a tube\n"
    "Without a mouse: Tab, Shift+Tab – to the next field, button or plane; in a plane arrows lead the cursor "
    "(Shift: "
    "by 10 mm), Page Up and Down go through it, Space clicks there\n"
    "Each change is stored at once, and the checks run again.";

}  // namespace

void EditorPanel::read_keys(Trainer& trainer, const Keys& keys) {
  CaseEditor& editor = *trainer.editor();
  if (keys.pressed('Z')) editor.undo();  // with Ctrl or without: a slow frame may not have seen it go down
  if (keys.control) return;
  for (const ToolButton& one : kTools)
    if (keys.pressed(one.key)) editor.tool = one.tool;
  if (keys.pressed('W')) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < session::kHuWindows.size(); ++i)
      if (session::kHuWindows[i].center_hu == editor.view.window.center_hu)
        next = (i + 1) % session::kHuWindows.size();
    editor.view.window = session::kHuWindows[next];
  }
  if (keys.pressed(kHome) && editor.scene()) editor.view.fit(editor.scene()->scene.volume, planes_.size_px());
  if (keys.pressed('C')) room_.toggle_glass();
  if (keys.pressed('H')) help_ = !help_;
  if (keys.pressed(kEnter)) editor.finish_drawing();
  if (keys.pressed(kEscape)) editor.drop_drawing();
  if (keys.pressed(kDelete)) {
    if (editor.tool == EditorTool::lesion) editor.remove_lesion(editor.lesion);
    if (editor.tool == EditorTool::structure) editor.remove_structure(editor.structure);
    if (editor.tool == EditorTool::entry && editor.row().planned_entry_lps_mm) editor.set_entry(std::nullopt);
  }
  lead_cursor(editor, keys);
  const auto through = planes_.by_keys() ? planes_.by_keys() : planes_.under_mouse();
  if (editor.scene() && through) {
    const volume::Volume& volume = editor.scene()->scene.volume;
    if (keys.pressed(kPageUp)) editor.view.scroll(volume, *through, 1);
    if (keys.pressed(kPageDown)) editor.view.scroll(volume, *through, -1);
  }
}

// What the mouse does in a plane.
void EditorPanel::lead_cursor(CaseEditor& editor, const Keys& keys) {
  if (!editor.scene() || !planes_.by_keys()) return;
  const volume::Volume& volume = editor.scene()->scene.volume;
  const PlaneKind& plane = plane_kinds()[*planes_.by_keys()];
  const double step_mm = keys.shift ? 10.0 : 1.0;
  const auto by = [&](int forth, int back) {
    return step_mm * ((keys.held(forth) ? 1.0 : 0.0) - (keys.held(back) ? 1.0 : 0.0));
  };
  const glm::dvec3 way = plane.u * by(kRight, kLeft) + plane.v * by(kDown, kUp);
  if (way != glm::dvec3(0.0)) editor.view.set_cursor(volume, editor.view.cursor_lps_mm() + way);
  if (keys.pressed(kSpace)) editor.click(editor.view.cursor_lps_mm());
}

void EditorPanel::draw_top(Trainer& trainer) {
  CaseEditor& editor = *trainer.editor();
  const casedb::CaseRow& row = editor.row();
  heading(row.title.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s, version %d   ·   %s", casedb::name_of(row.state).c_str(), row.version, kTrainingOnly);
  for (const ToolButton& one : kTools) {
    const bool in_hand = editor.tool == one.tool;
    if (in_hand) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.24F, 0.56F, 0.42F, 1.0F));
    if (noted_button(one.label)) editor.tool = one.tool;
    if (in_hand) ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  ImGui::BeginDisabled(!editor.can_undo() || !editor.locked().empty());
  if (noted_button("Undo (Z)")) editor.undo();
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered() && editor.can_undo()) ImGui::SetTooltip("%s", editor.undo_words().c_str());
  ImGui::SameLine();
  const session::HuWindow& stands = editor.view.window;
  char window[64];
  std::snprintf(window, sizeof window, "%s %.0f/%.0f", stands.name, stands.center_hu, stands.width_hu);
  ImGui::SetNextItemWidth(scaled(155.0F));
  if (ImGui::BeginCombo("##window", window)) {
    for (const session::HuWindow& one : session::kHuWindows)
      if (ImGui::Selectable(one.name, one.center_hu == stands.center_hu)) editor.view.window = one;
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  if (noted_button("Help (H)")) help_ = !help_;
  ImGui::SameLine();
  if (!editor.refusal().empty())
    ImGui::TextColored({1.0F, 0.55F, 0.40F, 1.0F}, "Not done: %s", editor.refusal().c_str());
  else if (!trainer.refusal().empty())
    ImGui::TextColored({1.0F, 0.55F, 0.40F, 1.0F}, "Not done: %s", trainer.refusal().c_str());
  else
    ImGui::TextDisabled("%s", editor.said().empty() ? "" : (editor.said() + " – stored").c_str());
}

// How far it is, or what it found; above the checks, since it is asked for.
void EditorPanel::draw_rehearsal(CaseEditor& editor) {
  DraftRehearsal* rehearsal = editor.rehearsal();
  DraftRehearsal::Now now;
  now.running = false;
  if (rehearsal != nullptr) now = rehearsal->now();
  if (now.running) {
    const std::string text = rehearsal->stopping() ? "stopping …"
                             : now.of == 0
                                 ? "preparing the case …"
                                 : std::to_string(now.made) + " of " + std::to_string(now.of) + " have tried it";
    const float share = now.of > 0 ? static_cast<float>(now.made) / static_cast<float>(now.of) : 0.0F;
    ImGui::ProgressBar(share, {scaled(230.0F), 0.0F}, text.c_str());
    note_item("can it be met: running");
    ImGui::SameLine();  // the same button to the keyboard, which stays on it
    if (noted_button("Stop###rehearsal")) rehearsal->stop();
    return;
  }
  ImGui::BeginDisabled(editor.lesions().empty() || editor.row().rule.criteria.empty());
  if (noted_button("Can it be met?###rehearsal")) editor.rehearse();
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("simulated operators try it as it is; graded, not kept. It needs a lesion and a rule");
  if (now.error) ImGui::TextWrapped("It could not be tried: %s", now.error->text.c_str());
  if (!now.found) return;
  const RehearsalWords words = words_of(*now.found);
  const bool met = now.found->passed() > 0;
  ImGui::PushStyleColor(ImGuiCol_Text, met ? ImVec4(0.45F, 0.85F, 0.55F, 1.0F) : ImVec4(1.0F, 0.45F, 0.35F, 1.0F));
  ImGui::TextWrapped("%s", words.found.c_str());
  ImGui::PopStyleColor();
  note_item("can it be met: found");
  if (!editor.checking() && !editor.is_of_now(*now.found)) quiet("This was before the case was last changed.");
  for (const std::string& line : words.levels) ImGui::BulletText("%s", line.c_str());
  for (const std::string& line : words.missed) ImGui::TextWrapped("%s", line.c_str());
  quiet(words.operators.c_str());
  ImGui::Separator();
}

void EditorPanel::draw_checks(CaseEditor& editor) {
  const auto scene = editor.scene();
  heading(editor.checking() ? "Checks … running" : "Checks");
  if (!scene) return;
  draw_rehearsal(editor);
  const ImVec4 bad{1.0F, 0.45F, 0.35F, 1.0F}, good{0.45F, 0.85F, 0.55F, 1.0F}, note{0.95F, 0.80F, 0.40F, 1.0F};
  int id = 0;
  const auto line = [&](const ImVec4& colour, const char* mark, const std::string& name, const std::string& text,
                        const std::optional<glm::dvec3>& place) {
    ImGui::PushID(id++);
    const ImVec2 from = ImGui::GetCursorPos();
    ImGui::TextColored(colour, "%s %s", mark, name.c_str());
    ImGui::SameLine();
    ImGui::TextWrapped("%s", text.c_str());
    if (place) {
      const ImVec2 to = ImGui::GetCursorPos();
      ImGui::SetCursorPos(from);
      if (ImGui::InvisibleButton("there", {ImGui::GetContentRegionAvail().x, std::max(4.0F, to.y - from.y - 4.0F)}))
        editor.view.go_to(scene->scene.volume, *place);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("click: the cursor goes there");
      ImGui::SetCursorPos(to);
    }
    ImGui::PopID();
  };
  for (const bool holds : {false, true}) {
    for (const casedb::Check& one : scene->check.checks)
      if (one.holds == holds)
        line(holds ? good : bad, holds ? "✓" : "✗", reports::check_label(one.name), reports::check_words(one),
             one.place_lps_mm);
    if (holds) break;
    // What publishing does not ask, and a mentor wants to know.
    if (scene->way) {
      for (const session::WayPart& part : scene->way->parts) {
        char text[96];
        std::snprintf(text, sizeof text, "%.1f mm of it, from %.1f mm below the entry", part.length_mm,
                      part.from_mm);
        if (part.forbidden) line(note, "!", "planned line through " + part.what, text, part.place_lps_mm);
      }
      for (const std::string& one : scene->way->not_crossed)
        line(note, "!", "planned line misses " + one, "which must be crossed", scene->way->target_lps_mm);
      if (scene->way->too_long)
        line(note, "!", "planned line", "is longer than the needle", scene->way->entry_lps_mm);
    }
    if (editor.row().origin == "import" && !editor.row().burned_in_checked)
      line(note, "!", reports::check_label("burned_in_unchecked"),
           "nobody has confirmed that the pictures hold no text", std::nullopt);
  }
}

void EditorPanel::draw_actions(Trainer& trainer) {
  CaseEditor& editor = *trainer.editor();
  const casedb::CaseRow& row = editor.row();
  const bool draft = row.state == casedb::CaseState::draft, review = row.state == casedb::CaseState::review;
  if (!editor.locked().empty() && draft) quiet(editor.locked().c_str());
  if ((draft || review) && row.origin == "import" && !row.burned_in_checked &&
      noted_button("I looked: no slice holds text", -1.0F))
    editor.confirm_no_burned_in_text();
  if (draft || review) {
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##note", "a note for the decision, if any", note_.data(), note_.size());
  }
  const bool holds = editor.scene() && editor.scene()->check.holds() && !editor.checking();
  const float half = 0.5F * (ImGui::GetContentRegionAvail().x - 8.0F);
  ImGui::BeginDisabled(!draft || editor.lesions().empty());
  if (noted_button("Try it", half)) {
    trainer.try_draft();
    ImGui::EndDisabled();
    return;
  }
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("an attempt that is graded and not kept: the draft stays a draft");
  ImGui::SameLine();
  if (draft) {
    ImGui::BeginDisabled(!holds);
    if (noted_button("Submit for review", half)) editor.submit(note_.data());
    if (noted_button("Publish to my cohort", half)) ask_to_publish(editor, true);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("a case no second person has seen goes only to your own cohort; every check must hold");
  } else if (review) {
    if (noted_button("Return to draft", half)) editor.judge(false, note_.data());
    const bool approved = casedb::review_of(editor.decisions()).has_value();
    if (!approved) {
      if (noted_button("Approve", half)) editor.judge(true, note_.data());
    } else {
      ImGui::BeginDisabled(!holds);
      if (noted_button("Publish", half)) ask_to_publish(editor, false);
      ImGui::EndDisabled();
    }
  } else {
    ImGui::Dummy({half, 0.0F});
  }
  if (draft || review) ImGui::SameLine();
  if (!review && (!draft || !editor.locked().empty()) && noted_button("New version", half)) {
    const std::string case_id = row.case_id;
    trainer.new_version(case_id);
    return;
  }
  if (noted_button("Cases", half)) trainer.leave_editor();
}

void EditorPanel::ask_to_publish(const CaseEditor& editor, bool own_cohort) {
  const casedb::CaseRow& row = editor.row();
  to_own_cohort_ = own_cohort;
  std::string words = "Publish “" + row.title + "”, version " + std::to_string(row.version) + ", " +
                      (own_cohort ? "to the cohorts that you lead now?" : "to everybody?") +
                      " It can be practised at once, and never changes again: a correction is a new version.";
  if (row.version > 1) words += " It takes the place of the version before it in every list.";
  question_.ask(std::move(words), "Publish it", "Not yet");
}

void EditorPanel::draw_history(const CaseEditor& editor) {
  if (editor.decisions().empty()) return;
  ImGui::Spacing();
  heading("History");
  for (const casedb::Decision& one : editor.decisions()) {
    const std::string note = one.note.empty() ? "" : ": " + one.note;
    ImGui::TextWrapped("%s", (reports::utc_text(one.decided_us) + "  " + casedb::name_of(one.kind) + " by " +
                              editor.who(one) + note)
                                 .c_str());
  }
  note_item("History");
}

void EditorPanel::draw_help() {
  if (!help_) return;
  ImGui::SetNextWindowPos({scaled(60.0F), scaled(120.0F)}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({scaled(760.0F), 0.0F});
  ImGui::Begin("The case editor", &help_, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextWrapped("%s", kHelp);
  ImGui::End();
}

void EditorPanel::tell(CaseEditor& editor, TraceLine& line) {
  EditorTrace told;
  told.state = casedb::name_of(editor.row().state);
  told.checking = editor.checking();
  told.lesions = editor.lesions().size();
  told.structures = editor.structures().size();
  told.entry = editor.row().planned_entry_lps_mm.has_value();
  told.cursor_lps_mm = editor.view.cursor_lps_mm();
  told.mm_per_pixel = editor.view.mm_per_pixel();
  told.refusal = editor.refusal();
  if (const auto scene = editor.scene())
    for (const casedb::Check& one : scene->check.checks)
      (one.holds ? told.holding : told.failing).push_back(one.name);
  if (const DraftRehearsal* rehearsal = editor.rehearsal()) {
    if (const auto found = rehearsal->now().found) {
      told.rehearsed = found->attempts();
      told.met = found->passed();
    }
  }
  if (const DraftPreparation* preparing = editor.preparation(); preparing != nullptr && !preparing->busy()) {
    if (const auto made = preparing->newest()) {
      told.prepared = casedb::text_of(made->settings);
      told.triangles = made->fidelity.triangles;
      told.most_mm = made->fidelity.most_mm;
    }
  }
  line.editor = std::move(told);
}

// Three planes and the room; of a CT that is prepared anew one plane and the room of each, beside each other.
void EditorPanel::draw_pictures(CaseEditor& editor, const Keys& keys, float wide, float high) {
  if (editor.tool != EditorTool::prepare) {
    const EditorLook stored{editor.scene()};
    planes_.draw(0, editor, stored, keys, wide, high);
    ImGui::SameLine();
    planes_.draw(2, editor, stored, keys, wide, high);
    planes_.draw(1, editor, stored, keys, wide, high);
    ImGui::SameLine();
    room_.draw(editor, stored, wide, high);
    return;
  }
  const auto made = editor.preparing().newest();
  const EditorLook came{editor.preparing().original(), nullptr, "as it came"},
      prepared{made ? made->shown : nullptr, came.of, "prepared; blue: as it came"};
  planes_.draw(0, editor, came, keys, wide, high);
  ImGui::SameLine();
  ImGui::PushID("prepared");
  prepared_planes_.draw(0, editor, prepared, keys, wide, high);
  ImGui::PopID();
  came_room_.draw(editor, {came.of, nullptr, "The skin of the CT as it came"}, wide, high);
  ImGui::SameLine();
  ImGui::PushID("prepared");
  prepared_room_.draw(editor, {prepared.of, nullptr, "The skin as it is prepared"}, wide, high);
  ImGui::PopID();
}

void EditorPanel::end() {
  case_id_.clear();
  for (EditorPlanes* planes : {&planes_, &prepared_planes_}) planes->end();
  for (EditorRoom* room : {&room_, &came_room_, &prepared_room_}) room->end();
}

void EditorPanel::draw(Trainer& trainer, const Keys& keys) {
  CaseEditor& editor = *trainer.editor();
  if (case_id_ != editor.row().case_id) {
    case_id_ = editor.row().case_id;
    planes_.begin();
    room_.begin();
    note_.fill('\0');
    question_.drop();
    title_of_.clear();
    name_of_.clear();
    texts_.clear();
    setting_in_hand_ = form_in_hand_ = structure_in_hand_ = preparation_in_hand_ = false;
    prepared_planes_.begin();
    came_room_.begin();
    prepared_room_.begin();
  }
  begin_screen("editor");
  draw_top(trainer);
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const float wide = std::floor(0.5F * (all.x - scaled(kRightPx) - 12.0F)),
              high = std::floor(0.5F * (all.y - 6.0F));
  ImGui::BeginChild(
      "planes", {2.0F * wide + 4.0F, all.y}, false,
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NavFlattened);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F, 4.0F});
  draw_pictures(editor, keys, wide, high);
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginGroup();
  const float actions_px = scaled(150.0F);
  // Checks are of what is stored: beside a CT that is prepared they say nothing.
  const bool checks = editor.tool != EditorTool::prepare;
  begin_fields("tool", 0.0F, checks ? 0.5F * (all.y - actions_px) : all.y - actions_px - 12.0F);
  draw_tool(editor);
  ImGui::EndChild();
  if (checks) {
    begin_fields("checks", 0.0F, 0.5F * (all.y - actions_px) - 12.0F);
    draw_checks(editor);
    ImGui::EndChild();
  }
  begin_fields("actions", 0.0F, 0.0F);
  draw_actions(trainer);
  ImGui::EndChild();
  ImGui::EndGroup();
  const bool asked = question_.open();
  if (question_.draw(keys)) editor.publish(to_own_cohort_, note_.data());
  end_screen();
  if (trainer.screen() != TrainerScreen::editor) return;
  draw_help();
  if (!asked) read_keys(trainer, keys);
  if (const auto kept = std::exchange(kept_preparation_, std::nullopt)) trainer.open_made_draft(*kept);
}

}  // namespace seldinger::app
