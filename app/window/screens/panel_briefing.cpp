#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "app/window/trainer/plan_words.h"
#include "assessment/grading/debrief.h"
#include "assessment/registry.h"
#include "casedb/cases/setting_table.h"
#include "reports/words/attempt_words.h"
#include "reports/words/dependability_words.h"
#include "reports/words/metric_card.h"
#include "reports/words/metric_words.h"
#include "session/case/planned_way.h"
#include "sim/imaging/probe.h"
#include "sim/volume/organs/find_organs.h"

namespace seldinger::app {
namespace {

constexpr std::array<const char*, 5> kSignIn = {"Identity", "Consent", "Imaging seen", "Allergies",
                                                "INR and platelets"};

// A line of a list, wrapped.
void line(const std::string& words) {
  ImGui::Bullet();
  ImGui::TextWrapped("%s", words.c_str());
}

void laboratory(const char* what, const std::optional<double>& value, const char* unit, int digits) {
  line(std::string(what) + ": " + (value ? reports::number_text(*value, digits) + unit : "none reported"));
}

void fact(const char* what, const std::string& value) {
  line(std::string(what) + ": " + value);
}

// What the hands do, for who has not done it before.
void draw_hands(const casedb::CaseRow& row) {
  struct Line {
    const char *key, *words, *without_probe;  // empty: the probe's alone
  };
  constexpr const char *kFiner = "makes everything ten times finer",
                       *kFires = "fires; with an access needle, says that you are there",
                       *kViews = "views of the room; with Alt the mouse turns the view",
                       *kSwap = "swap room and picture; fold the console", *kPause = "pause; begin again";
  constexpr Line kLines[] = {
      {"Tab", "switches tool: needle or probe", ""},
      {"left drag", "moves it; the probe follows the skin", "moves the needle"},
      {"right drag", "turns the needle; tilts and rocks the probe", "turns the needle"},
      {"middle drag", "rotates the probe", ""},
      {"wheel", "advances the needle and pulls it back; presses the probe",
       "advances the needle and pulls it back"},
      {"Shift", kFiner, kFiner},
      {"G", "puts the needle into the probe's guide", ""},
      {"P", "", "the pedal; arrows turn the C-arm, H takes the hand out of the beam"},
      {"Space", kFires, kFires},
      {"1 – 8", kViews, kViews},
      {"Enter, Home", kSwap, kSwap},
      {"Esc, F5", kPause, kPause},
  };
  heading("Your hands");
  const bool probe = row.modality != cases::Modality::xray;
  for (const Line& one : kLines) {
    const char* words = probe ? one.words : one.without_probe;
    if (*words == '\0') continue;
    ImGui::TextColored({0.86F, 0.80F, 0.58F, 1.0F}, "%s", one.key);
    ImGui::SameLine(7.0F * ImGui::GetFontSize());
    ImGui::TextWrapped("%s", words);
  }
}

// Of whole pieces: what came after the last of them is lost.
std::string interrupted_words(const casedb::OpenAttempt& attempt) {
  return "Your attempt at this case was interrupted after " +
         reports::number_text(cases::kChunkSeconds * attempt.chunks, 0) +
         " s. If you start a new one, the interrupted one is stored as it is.";
}

// What the line before asks for, while the mouse is on it.
void explain(const std::string& metric_id) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(30.0F * ImGui::GetFontSize());
  ImGui::TextUnformatted(reports::metric_card(metric_id).definition.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string unit_of(const std::string& metric_id) {
  const assessment::MetricInfo* info = assessment::find_metric(metric_id);
  return info != nullptr ? info->unit : "";
}

// "left kidney, as far as the CT shows (93 % sure)".
std::string organ_words(const volume::OrganFound& organ) {
  std::string name(base::name_of(volume::kFoundOrganNames, organ.organ));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + ", as far as the CT shows (" + reports::number_text(100.0 * organ.confidence, 0) + " % sure)";
}

// Where the target lies, and the way that was planned to it.
void draw_plan(const session::Task& task) {
  const cases::Lesion& target = task.lesion.lesion;
  const double depth_mm = -task.scene.skin_index.closest(target.center_lps_mm).distance_mm;
  fact("Target", reports::number_text(2.0 * target.radius_mm, 0) + " mm across, its middle " +
                     reports::number_text(depth_mm, 0) + " mm below the nearest skin");
  if (task.organ) fact("Organ", organ_words(*task.organ));
  const auto way = session::planned_way(task.scene);
  if (!way) return;
  fact("Proposed path", way_words(*way));
}

// Where whoever attempts the case chooses: what each probe is, not which one suits.
void draw_probes(Trainer& trainer) {
  const std::vector<std::string> offered = trainer.probes();
  if (offered.empty()) return;
  ImGui::Spacing();
  heading("Your probe");
  for (const std::string& name : offered) {
    const imaging::Probe& probe = *imaging::probe_named(name);
    const std::string words = (probe.radius_mm > 0.0 ? "curvilinear " : "linear ") + name + ", " +
                              reports::number_text(probe.least_mhz, 0) + " to " +
                              reports::number_text(probe.most_mhz, 0) + " MHz";
    if (ImGui::RadioButton(words.c_str(), trainer.chosen_probe() == name)) trainer.choose_probe(name);
    note_item(words.c_str());
  }
  if (trainer.chosen_probe().empty()) quiet("Choose one: it is kept for the attempt.");
}

}  // namespace

bool BriefingPanel::draw_sign_in(const casedb::CaseRow& row) {
  heading("Sign-in");
  laboratory("INR", row.clinic.inr, "", 1);
  laboratory("Platelets", row.clinic.platelets_per_nl, " · 10⁹/l", 0);
  fact("Allergy", row.clinic.allergy.empty() ? "none reported" : row.clinic.allergy);
  ImGui::Spacing();
  bool all = true;
  for (std::size_t i = 0; i < kSignIn.size(); ++i) {
    ImGui::Checkbox(kSignIn[i], &checked_[i]);
    note_item(kSignIn[i]);
    all = all && checked_[i];
  }
  if (noted_button("All checked")) checked_.fill(true);
  ImGui::Spacing();
  quiet(
      "SIR 2019, high-risk punctures: INR at most 1.5 to 1.8, platelets at least 50 · 10⁹/l. You decide in the "
      "room: proceed or defer.");
  ImGui::Spacing();
  draw_hands(row);
  return all;
}

void BriefingPanel::draw_task(Trainer& trainer) {
  const casedb::CaseRow& row = trainer.chosen();
  heading("The task");
  if (!row.clinic.indication.empty()) ImGui::TextWrapped("%s", row.clinic.indication.c_str());
  fact("Guidance", modality_words(row.modality));
  if (row.modality != cases::Modality::xray) fact("Approach", reports::approach_text(row.approach));
  if (row.modality == cases::Modality::xray && row.sight_law >= cases::SightLaw::scatter)
    fact("Field", "scatter from the patient hazes the picture; narrowing the collimator makes it clearer");
  fact("Needle", reports::instrument_text(row.instrument) + ", " + reports::instrument_size_text(row.instrument));
  fact("Needle tip", std::string(base::name_of(casedb::kTipWords, row.touch.tip)));
  const bool phantom = row.subject == cases::Subject::phantom;
  if (phantom)
    fact("On the table", "a gel block, no patient: no sign-in, no anaesthetic, no breath-hold");
  else
    fact("Patient", reports::position_text(row.position));
  if (row.motion.breathing()) fact("Breathing", "the organ moves with every breath");
  if (row.time_limit_s) fact("Time limit", reports::number_text(*row.time_limit_s, 0) + " s");
  const bool ready = trainer.attempt() != nullptr && trainer.attempt()->phase() == PersonAttempt::Phase::ready;
  const std::shared_ptr<const session::Task> prepared = ready ? trainer.attempt()->task() : nullptr;
  if (prepared) draw_plan(*prepared);
  draw_probes(trainer);
  ImGui::Spacing();
  heading("To pass");
  if (row.rule.criteria.empty()) ImGui::TextWrapped("This case has no pass rule: it is practised, not graded.");
  for (const assessment::Criterion& criterion : row.rule.criteria) {
    line(reports::metric_label(criterion.metric) + ": " +
         assessment::limit_text(criterion, unit_of(criterion.metric)) + (criterion.critical ? " (critical)" : ""));
    explain(criterion.metric);
  }
  if (!row.rule.criteria.empty() && trainer.provisional())
    quiet("Provisional: no consultant standard has been set for this case.");
  if (trainer.dependability())
    quiet(reports::dependability_line(*trainer.dependability(), casedb::Learners::people).c_str());
  ImGui::Spacing();
  heading(phantom ? "The block, cut through the target" : "The planning CT");
  if (prepared) {
    if (noted_button(trainer.plan() ? "Your plan (P)" : "Look closer and plan (P)")) planning_.set_open(true);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    quiet("in three planes and in 3-D; what you plan is compared with what you do");
  }
  planning_.draw_small(trainer, prepared);
}

// The button, or what is still missing.
bool BriefingPanel::draw_enter(Trainer& trainer, const Keys& keys, bool all, bool at_back) {
  const bool ready = trainer.attempt() != nullptr && trainer.attempt()->phase() == PersonAttempt::Phase::ready;
  const bool probe = trainer.probes().empty() || !trainer.chosen_probe().empty();
  const bool may_begin = ready && all && probe;
  ImGui::BeginDisabled(!may_begin);
  const bool begin = noted_button("Enter the room (Enter)") || (may_begin && keys.pressed(kEnter));
  if (may_begin) ImGui::SetItemDefaultFocus();
  if (at_back && may_begin && !could_begin_) focus_here();  // Enter would lead out
  could_begin_ = may_begin;
  ImGui::EndDisabled();
  if (ready && !may_begin) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const char* words = !all ? "Complete the sign-in first." : "Choose a probe first.";
    quiet(words);
    note_item(words);
  }
  if (!ready) {
    ImGui::SameLine();
    ImGui::ProgressBar(static_cast<float>(trainer.prepared()), {scaled(220.0F), 0.0F}, "preparing the case …");
  }
  return begin;
}

bool BriefingPanel::draw(Trainer& trainer, const Keys& keys) {
  const casedb::CaseRow& row = trainer.chosen();
  if (case_id_ != row.case_id) {
    case_id_ = row.case_id;
    checked_.fill(false);
    planning_.end();
  }
  begin_screen("briefing");
  heading(row.title.c_str());
  quiet(kTrainingOnly);
  ImGui::Spacing();
  const bool prepared = trainer.attempt() != nullptr && trainer.attempt()->phase() == PersonAttempt::Phase::ready;
  if (prepared && !trainer.resuming() && (keys.pressed('P') || (planning_.open() && keys.pressed(kEscape))))
    planning_.set_open(!planning_.open());
  if (planning_.open() && prepared && !trainer.resuming()) {
    planning_.draw_large(trainer, keys, trainer.attempt()->task());
    end_screen();
    return false;
  }
  const float half = 0.5F * ImGui::GetContentRegionAvail().x - 8.0F;
  const bool left = trainer.interrupted() && !trainer.resuming();
  const float high =
      ImGui::GetContentRegionAvail().y - scaled(60.0F) - (left ? ImGui::GetTextLineHeightWithSpacing() : 0.0F);
  begin_fields("task", half, high);
  draw_task(trainer);
  ImGui::EndChild();
  ImGui::SameLine();
  begin_fields("sign-in", half, high);
  const bool phantom = row.subject == cases::Subject::phantom;
  const bool all = phantom || draw_sign_in(row);
  if (phantom) draw_hands(row);
  ImGui::EndChild();
  const bool ready = trainer.attempt() != nullptr && trainer.attempt()->phase() == PersonAttempt::Phase::ready;
  if (trainer.resuming()) {
    ImGui::TextUnformatted("Going through the recording …");
    end_screen();
    return false;
  }
  if (left) quiet(interrupted_words(*trainer.interrupted()).c_str());
  if (noted_button("Back")) {
    trainer.back();
    end_screen();
    return false;
  }
  const bool at_back = framed();
  if (!trainer.expert_attempt().empty()) {
    ImGui::SameLine();
    if (noted_button("Watch an expert (E)") || keys.pressed('E')) {
      trainer.watch(trainer.expert_attempt());
      end_screen();
      return false;
    }
  }
  if (trainer.interrupted()) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!ready);
    if (noted_button("Go on with the interrupted attempt (R)") || (ready && keys.pressed('R'))) resume_ = true;
    ImGui::EndDisabled();
  }
  ImGui::SameLine();
  const bool begin = draw_enter(trainer, keys, all, at_back);
  end_screen();
  return begin;
}

}  // namespace seldinger::app
