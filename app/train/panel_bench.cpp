#include "app/train/panel_bench.h"

#include <imgui.h>

#include <algorithm>

#include "app/train/panel_items.h"
#include "app/train/panels.h"

namespace seldinger::app {
namespace {

struct ToolButton {
  BenchTool tool;
  int key;
  const char* label;
};
constexpr std::array<ToolButton, 5> kTools = {{{BenchTool::look, 'V', "Look (V)"},
                                               {BenchTool::lesion, 'L', "Lesion (L)"},
                                               {BenchTool::structure, 'T', "Structure (T)"},
                                               {BenchTool::entry, 'E', "Entry (E)"},
                                               {BenchTool::rule, 'R', "Case and rule (R)"}}};

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
    "Keys: V L T E R – tools · Z – undo · W – next window · Home – all of the CT · C – room cut away · Del – "
    "remove what is chosen · Enter, Esc – finish, drop a tube\n"
    "Each change is stored at once, and the checks run again.";

}  // namespace

void BenchPanel::read_keys(Trainer& trainer, const Keys& keys) {
  CaseBench& bench = *trainer.bench();
  if (keys.pressed('Z')) bench.undo();  // with Ctrl or without: a slow frame may not have seen it go down
  if (keys.control) return;
  for (const ToolButton& one : kTools)
    if (keys.pressed(one.key)) bench.tool = one.tool;
  if (keys.pressed('W')) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < kHuWindows.size(); ++i)
      if (kHuWindows[i].center_hu == bench.view.window.center_hu) next = (i + 1) % kHuWindows.size();
    bench.view.window = kHuWindows[next];
  }
  if (keys.pressed(kHome) && bench.scene()) bench.view.fit(bench.scene()->scene.volume, planes_.size_px());
  if (keys.pressed('C')) room_.toggle_glass();
  if (keys.pressed('H')) help_ = !help_;
  if (keys.pressed(kEnter)) bench.finish_drawing();
  if (keys.pressed(kEscape)) bench.drop_drawing();
  if (keys.pressed(kDelete)) {
    if (bench.tool == BenchTool::lesion) bench.remove_lesion(bench.lesion);
    if (bench.tool == BenchTool::structure) bench.remove_structure(bench.structure);
    if (bench.tool == BenchTool::entry && bench.row().planned_entry_lps_mm) bench.set_entry(std::nullopt);
  }
  if (bench.scene() && planes_.under_mouse()) {
    const volume::Volume& volume = bench.scene()->scene.volume;
    if (keys.pressed(kPageUp)) bench.view.scroll(volume, *planes_.under_mouse(), 1);
    if (keys.pressed(kPageDown)) bench.view.scroll(volume, *planes_.under_mouse(), -1);
  }
}

void BenchPanel::draw_top(Trainer& trainer) {
  CaseBench& bench = *trainer.bench();
  const casedb::CaseRow& row = bench.row();
  heading(row.title.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s, version %d   ·   %s", casedb::name_of(row.state).c_str(), row.version, kTrainingOnly);
  for (const ToolButton& one : kTools) {
    const bool in_hand = bench.tool == one.tool;
    if (in_hand) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.24F, 0.56F, 0.42F, 1.0F));
    if (noted_button(one.label)) bench.tool = one.tool;
    if (in_hand) ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  ImGui::BeginDisabled(!bench.can_undo() || !bench.locked().empty());
  if (noted_button("Undo (Z)")) bench.undo();
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered() && bench.can_undo()) ImGui::SetTooltip("%s", bench.undo_words().c_str());
  ImGui::SameLine();
  const HuWindow& stands = bench.view.window;
  char window[64];
  std::snprintf(window, sizeof window, "%s %.0f / %.0f", stands.name, stands.center_hu, stands.width_hu);
  ImGui::SetNextItemWidth(180.0F);
  if (ImGui::BeginCombo("##window", window)) {
    for (const HuWindow& one : kHuWindows)
      if (ImGui::Selectable(one.name, one.center_hu == stands.center_hu)) bench.view.window = one;
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  if (noted_button("Help (H)")) help_ = !help_;
  ImGui::SameLine();
  if (!bench.refusal().empty())
    ImGui::TextColored({1.0F, 0.55F, 0.40F, 1.0F}, "Not done: %s", bench.refusal().c_str());
  else if (!trainer.refusal().empty())
    ImGui::TextColored({1.0F, 0.55F, 0.40F, 1.0F}, "Not done: %s", trainer.refusal().c_str());
  else
    ImGui::TextDisabled("%s", bench.said().empty() ? "" : (bench.said() + " – stored").c_str());
}

void BenchPanel::draw_checks(CaseBench& bench) {
  const auto scene = bench.scene();
  heading(bench.checking() ? "Checks … running" : "Checks");
  if (!scene) return;
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
        bench.view.go_to(scene->scene.volume, *place);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("click: the cursor goes there");
      ImGui::SetCursorPos(to);
    }
    ImGui::PopID();
  };
  for (const bool holds : {false, true}) {
    for (const Check& one : scene->check.checks)
      if (one.holds == holds) line(holds ? good : bad, holds ? "✓" : "✗", one.name, one.text, one.place_lps_mm);
    if (holds) break;
    // What publishing does not ask, and a mentor wants to know.
    if (scene->way) {
      for (const WayPart& part : scene->way->parts) {
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
    if (bench.row().origin == "import" && !bench.row().burned_in_checked)
      line(note, "!", "burned_in_unchecked", "nobody has confirmed that the pictures hold no text", std::nullopt);
  }
}

void BenchPanel::draw_actions(Trainer& trainer) {
  CaseBench& bench = *trainer.bench();
  const casedb::CaseRow& row = bench.row();
  const bool draft = row.state == casedb::CaseState::draft, review = row.state == casedb::CaseState::review;
  if (!bench.locked().empty() && draft) quiet(bench.locked().c_str());
  if (draft && row.origin == "import" && !row.burned_in_checked &&
      noted_button("I looked: no slice holds text", -1.0F))
    bench.confirm_no_burned_in_text();
  if (draft || review) {
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##note", "a note for the decision, if any", note_.data(), note_.size());
  }
  const bool holds = bench.scene() && bench.scene()->check.holds() && !bench.checking();
  const float half = 0.5F * (ImGui::GetContentRegionAvail().x - 8.0F);
  ImGui::BeginDisabled(!draft || bench.lesions().empty());
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
    if (noted_button("Submit for review", half)) bench.submit(note_.data());
    if (noted_button("Publish to my cohort", half)) bench.publish(true, note_.data());
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("what no second person has seen is for your own cohort; every check must hold");
  } else if (review) {
    if (noted_button("Return to draft", half)) bench.judge(false, note_.data());
    const bool approved = casedb::review_of(bench.decisions()).has_value();
    if (!approved) {
      if (noted_button("Approve", half)) bench.judge(true, note_.data());
    } else {
      ImGui::BeginDisabled(!holds);
      if (noted_button("Publish", half)) bench.publish(false, note_.data());
      ImGui::EndDisabled();
    }
  } else {
    ImGui::Dummy({half, 0.0F});
  }
  if (draft || review) ImGui::SameLine();
  if (!review && (!draft || !bench.locked().empty()) && noted_button("New version", half)) {
    const std::string case_id = row.case_id;
    trainer.new_version(case_id);
    return;
  }
  if (noted_button("Cases", half)) trainer.leave_bench();
}

void BenchPanel::draw_help() {
  if (!help_) return;
  ImGui::SetNextWindowPos({60.0F, 120.0F}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({760.0F, 0.0F});
  ImGui::Begin("The bench", &help_, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextWrapped("%s", kHelp);
  ImGui::End();
}

void BenchPanel::tell(const CaseBench& bench, TraceLine& line) {
  BenchTrace told;
  told.state = casedb::name_of(bench.row().state);
  told.checking = bench.checking();
  told.lesions = bench.lesions().size();
  told.structures = bench.structures().size();
  told.entry = bench.row().planned_entry_lps_mm.has_value();
  told.cursor_lps_mm = bench.view.cursor_lps_mm();
  told.mm_per_pixel = bench.view.mm_per_pixel();
  told.refusal = bench.refusal();
  if (const auto scene = bench.scene())
    for (const Check& one : scene->check.checks) (one.holds ? told.holding : told.failing).push_back(one.name);
  line.bench = std::move(told);
}

void BenchPanel::draw(Trainer& trainer, const Keys& keys) {
  CaseBench& bench = *trainer.bench();
  if (case_id_ != bench.row().case_id) {
    case_id_ = bench.row().case_id;
    planes_.begin();
    room_.begin();
    note_.fill('\0');
    title_of_.clear();
    name_of_.clear();
    texts_.clear();
    setting_in_hand_ = form_in_hand_ = structure_in_hand_ = false;
  }
  begin_screen("bench");
  draw_top(trainer);
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const float wide = std::floor(0.5F * (all.x - kRightPx - 12.0F)), high = std::floor(0.5F * (all.y - 6.0F));
  ImGui::BeginChild("planes", {2.0F * wide + 4.0F, all.y}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {4.0F, 4.0F});
  planes_.draw(0, bench, keys, wide, high);
  ImGui::SameLine();
  planes_.draw(2, bench, keys, wide, high);
  planes_.draw(1, bench, keys, wide, high);
  ImGui::SameLine();
  room_.draw(bench, keys, wide, high);
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginGroup();
  constexpr float kActionsPx = 150.0F;
  ImGui::BeginChild("tool", {0.0F, 0.5F * (all.y - kActionsPx)}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_tool(bench);
  ImGui::EndChild();
  ImGui::BeginChild("checks", {0.0F, 0.5F * (all.y - kActionsPx) - 12.0F}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_checks(bench);
  ImGui::EndChild();
  ImGui::BeginChild("actions", {0.0F, 0.0F}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  draw_actions(trainer);
  ImGui::EndChild();
  ImGui::EndGroup();
  end_screen();
  if (trainer.screen() != TrainerScreen::bench) return;
  draw_help();
  read_keys(trainer, keys);
}

}  // namespace seldinger::app
