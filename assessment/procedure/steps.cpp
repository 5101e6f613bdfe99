#include "assessment/procedure/steps.h"

#include "assessment/signals/need_words.h"
#include "assessment/signals/signals.h"
#include "sim/base/check.h"
#include "sim/base/names.h"

namespace seldinger::assessment {
namespace {

using enum Evidence;

constexpr const char* kAround = "docs/clinical.md: steps around the puncture";
constexpr const char* kTask(int step) {
  constexpr const char* kSteps[] = {
      "thesis, appendix A, step 1",        "thesis, appendix A, step 2",  "thesis, appendix A, step 3",
      "thesis, appendix A, steps 4 and 5", "thesis, appendix A, step 5",  "thesis, appendix A, step 6",
      "thesis, appendix A, step 7",        "thesis, appendix A, step 8",  "thesis, appendix A, step 9",
      "thesis, appendix A, step 10",       "thesis, appendix A, step 11", "thesis, appendix A, step 12"};
  return kSteps[step - 1];
}
constexpr const char* kOutOf = "docs/clinical.md: out of plane the probe goes first";
constexpr const char* kBullsEye = "docs/clinical.md, case 6: bull's-eye, then depth view";

constexpr std::uint32_t kAlways = 0;  // graded

constexpr StepInfo kSteps[] = {
    {"sign_in", "Sign in: identity, consent, imaging, allergy, INR, platelets", kPatient | kEvents, signed_in,
     punctured, none, kAlways, kAround},
    {"decide", "Decide to proceed or to defer", kPatient | kEvents, decided, punctured, none, kAlways, kAround},
    {"check_probe", "Choose the probe and check its orientation: move it and look", kUltrasound | kPictures | kSkin,
     orientation_tested, punctured, none, kAlways, kAround, probe_checked},
    {"place_probe", "Place the probe on the skin at the entry", kPicturePlane | kSkin, probe_on_skin, punctured,
     none, kAlways, kTask(1)},
    {"find_target", "Find the target in the picture", kPicturePlane | kPictures | kTarget, target_seen, punctured,
     none, kAlways, kTask(2)},
    {"find_target_under_beam", "Find the target under fluoroscopy", kXray | kPictures | kTarget, target_under_beam,
     punctured, none, kAlways, kBullsEye},
    {"note_depth", "Measure the target's depth in the picture, with calipers",
     kEvents | kPicturePlane | kPictures | kTarget | kCalipers, depth_measured, punctured, none, kAlways, kTask(3),
     plan_noted},
    {"note_depth_under_beam", "Note planned entry and depth, and the needle's markings", kEvents | kXray,
     plan_noted, punctured, none, kAlways, kTask(3)},
    {"anaesthetise", "Give local anaesthetic, after aspiration", kPatient | kEvents, anaesthetised, punctured,
     anaesthetised_unaspirated, kAlways, kAround},
    {"nick", "Nick the skin", kPatient | kEvents | kCoreNeedle, nicked, punctured, none, kAlways, kAround},
    {"hold_at_entry", "Hold the needle at the entry", kSkin, needle_at_skin, none, none, kAlways, kTask(4)},
    {"aim_along_beam", "Aim along the beam: bull's-eye view", kXray | kPictures | kBeam, looked_along_needle,
     at_target, hand_in_beam, kAlways, kBullsEye},
    {"insert", "Insert the needle; a patient's skin must be numb", kSkin, punctured, none, skin_pain, kAlways,
     kTask(6)},
    {"enter_at_angle", "Enter the skin at the planned angle", kSkin | kPlan, angle_kept, none, none, kAlways,
     kTask(6)},
    {"needle_in_plane", "Bring needle and picture together: see the tip in tissue",
     kPicturePlane | kPictures | kSkin | kInPlane, tip_seen, fired, none, kAlways, kTask(7)},
    {"jiggle", "Jiggle the needle gently to find it in the picture", kUltrasound | kSkin, jiggled, fired, none,
     kYields, kTask(8)},
    {"see_both", "See needle and target in one picture", kPicturePlane | kPictures | kTarget | kSkin | kInPlane,
     both_seen, fired, none, kAlways, kTask(8)},
    {"advance_seen", "Advance slowly towards the target, the tip in the picture",
     kPicturePlane | kPictures | kTarget | kSkin | kInPlane, at_target, fired, blind_run, kAlways, kTask(9)},
    {"advance_to_plane", "Advance no further than the picture's plane: the probe goes first",
     kPicturePlane | kTarget | kSkin | kOutOfPlane, at_target, fired, beyond_plane, kAlways, kOutOf},
    {"keep_off_bone", "Keep off bone", kPatient | kEvents | kSkin, at_target, fired, bone_pain, kAlways, kAround},
    {"judge_depth", "Judge the depth from a second view", kXray | kPictures | kBeam | kTarget | kSkin,
     looked_across_needle, fired, none, kAlways, kBullsEye},
    {"exchange_stylet",
     "Through an introducer: at the target's edge withdraw its stylet, and go on with the needle",
     kPatient | kEvents | kCoreNeedle | kTarget | kSkin, stylet_exchanged, fired, fired_on_stylet, kAlways, kAround,
     none, introducer_used},
    {"reach_target", "Reach the target; with a core needle, its edge", kTarget | kSkin, at_target, fired, none,
     kAlways, kTask(10)},
    {"insert_to_depth", "Insert to the planned depth, by the needle's marks",
     kEvents | kPicturePlane | kSkin | kCalipers, at_planned_depth, fired, none, kAlways, kTask(4)},
    {"stop_in_trouble", "Stop when the patient coughs, bleeds or loses pressure",
     kPatient | kEvents | kTrouble | kSkin, stopped_in_trouble, none, went_on_in_trouble, kAlways, kAround},
    {"ask_breath_hold", "Ask the patient to hold the breath", kPatient | kEvents, breath_hold_asked, fired, none,
     kBreathes, kTask(11)},
    {"hold_before_organ", "Have the breath held before entering the organ, and while advancing in it",
     kEvents | kBreathes | kTarget | kSkin, pushed_in_hold, none, pushed_in_breath, kAlways, kTask(11)},
    {"check_in_breath_hold", "Check needle and target while the breath is held",
     kPatient | kEvents | kPicturePlane | kPictures | kTarget | kSkin, seen_in_breath_hold, fired, on_unchecked,
     kBreathes, kTask(12)},
    {"find_again", "Where the check does not show the tip, go back: find it before going on",
     kPatient | kEvents | kPicturePlane | kPictures | kSkin, found_again, none, on_unfound, kBreathes, kTask(12),
     none, unseen_in_breath_hold},
    {"fire_in_breath_hold", "Take the sample, or declare access, with the breath held", kEvents | kBreathes, fired,
     none, fired_in_breath, kAlways, kTask(12)},
    {"sample", "Take the sample, or declare access, with the tip in the picture",
     kPicturePlane | kPictures | kInPlane, fired, none, fired_unseen, kAlways, kAround},
    {"declare", "Declare that the place is reached", kXray, fired, none, none, kAlways, kAround},
    {"declare_out_of_plane", "Declare that the place is reached", kOutOfPlane, fired, none, none, kAlways, kAround},
    {"needle_out", "Take the needle out", kEvents | kCoreNeedle | kSkin, needle_out, none, none, kAlways, kAround},
    {"scan_after", "Scan once more with the needle out",
     kEvents | kCoreNeedle | kPicturePlane | kPictures | kTarget | kSkin, scanned_after, none, none, kAlways,
     kAround},
    {"sign_out", "Sign out", kPatient | kEvents, signed_out, none, none, kAlways, kAround},
};

constexpr auto kStates = base::names<StepState>({{StepState::done, "done"},
                                                 {StepState::skipped, "skipped"},
                                                 {StepState::violated, "violated"},
                                                 {StepState::not_asked, "not_asked"}});

constexpr auto kHows = base::names<StepHow>({{StepHow::shown, "shown"}, {StepHow::said, "said"}});

StepResult walk(const StepInfo& step, const Signals& signals, Needs unmet, bool stopped_by_defer) {
  StepResult result;
  result.id = step.id;
  const Needs needs = step.needs | about(step.completes).needs;
  for (const NeedInfo& need : assessment::needs())
    if ((needs & unmet & need.need) != 0) {
      result.reason = need.reason;
      return result;
    }
  // Who defers does nothing of what follows.
  if (stopped_by_defer && step.completes != signed_in && step.completes != decided &&
      step.completes != signed_out) {
    result.reason = "deferred";
    return result;
  }
  if (step.asked_when != none && !first_s(step.asked_when, signals, unmet)) {
    result.reason = "no_such_event";
    return result;
  }
  const auto violated_s = first_s(step.violates, signals, unmet), done_s = first_s(step.completes, signals, unmet),
             by_s = first_s(step.by, signals, unmet);
  result.t_s = violated_s ? violated_s : done_s;
  result.state = violated_s                             ? StepState::violated
                 : done_s && !(by_s && *done_s > *by_s) ? StepState::done
                                                        : StepState::skipped;
  if (result.state == StepState::done) result.how = step.shown() ? StepHow::shown : StepHow::said;
  if (result.state == StepState::skipped && first_s(step.said, signals, unmet)) result.how = StepHow::said;
  return result;
}

}  // namespace

std::span<const StepInfo> procedure_steps() {
  return kSteps;
}

const StepInfo* find_step(std::string_view id) {
  for (const StepInfo& step : kSteps)
    if (id == step.id) return &step;
  return nullptr;
}

std::string_view name_of(StepState state) noexcept {
  return base::name_of(kStates, state);
}

std::optional<StepState> step_state_from(std::string_view name) noexcept {
  return base::from_name(kStates, name);
}

std::string_view name_of(StepHow how) noexcept {
  return base::name_of(kHows, how);
}

std::optional<StepHow> step_how_from(std::string_view name) noexcept {
  return base::from_name(kHows, name);
}

std::vector<StepResult> walk_steps(const Signals& signals, Needs unmet) {
  const bool stopped_by_defer = first_s(deferred, signals, unmet) && !first_s(punctured, signals, unmet);
  std::vector<StepResult> results;
  for (const StepInfo& step : kSteps) results.push_back(walk(step, signals, unmet, stopped_by_defer));
  return results;
}

std::vector<StepResult> walk_steps(const Signals& signals) {
  return walk_steps(signals, unmet_needs(signals));
}

StepCounts count_steps(std::span<const StepResult> results, Needs unmet) {
  StepCounts counts;
  for (const StepResult& result : results) {
    const StepInfo* step = find_step(result.id);
    if (step == nullptr || (step->graded_with & unmet) != 0) continue;
    counts.done += result.state == StepState::done ? 1 : 0;
    counts.skipped += result.state == StepState::skipped ? 1 : 0;
    counts.violated += result.state == StepState::violated ? 1 : 0;
    if (!step->shown() || result.state == StepState::not_asked) continue;
    ++counts.to_be_shown;
    counts.shown += result.state == StepState::done ? 1 : 0;
  }
  return counts;
}

std::string steps_markdown() {
  const auto words = [](Evidence of) { return of == none ? std::string("–") : std::string(about(of).words); };
  std::string text =
      "# Steps of a puncture\n\nMade from the tables in `assessment/procedure/` by `seldinger help --steps`; a "
      "test compares.\nA step is done when its evidence came in time, skipped when it never came or came too late, "
      "violated\nwhere it was done wrongly, whatever else was done, and not asked for where the guidance, the "
      "needle, the case or the\nrecording lacks what it needs. Steps that are graded with something count in cases "
      "that have it; elsewhere they are\nlisted and do not count (docs/clinical.md).\n\nA step is *shown* where an "
      "action completes it: hands, pictures and patient are the evidence. What is said about it is\nlisted and "
      "does not count. Where no action can show it, the step is *said*: the trainee is taken at his or her "
      "word.\n`steps_shown` is the share of the shown steps that were done.\n\nThe angle at the skin is right or "
      "wrong for a planned path only, and no case states limits of its own: where no\nentry is planned, "
      "`enter_at_angle` is not asked for.\n\n| id | step | by | asked for with | done when | before | violated "
      "when | graded | source |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const StepInfo& step : kSteps) {
    const std::string needs = words_of_needs(step.needs), graded_with = words_of_needs(step.graded_with);
    const std::string when = step.asked_when == none ? "" : "; where " + words(step.asked_when);
    text += "| `" + std::string(step.id) + "` | " + step.words + " | " +
            std::string(name_of(step.shown() ? StepHow::shown : StepHow::said)) + " | " +
            (needs.empty() ? "–" : needs) + when + " | " + words(step.completes) + " | " + words(step.by) + " | " +
            words(step.violates) + " | " + (graded_with.empty() ? "yes" : "with " + graded_with) + " | " +
            step.source + " |\n";
  }
  return text;
}

}  // namespace seldinger::assessment
