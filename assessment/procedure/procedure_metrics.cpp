// Metrics of the procedure around the puncture: what was decided, which steps were done, and what hurt.
#include <algorithm>

#include "assessment/metrics/tables.h"
#include "assessment/procedure/steps.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

Measured procedure_performed(const Signals& signals) {
  return Measured::of(performed(signals) ? 1.0 : 0.0);
}

bool said_to_defer(const Signals& signals) {
  return first_s(Evidence::deferred, signals, unmet_needs(signals)).has_value();
}

Measured decision_right(const Signals& signals) {
  const bool deferred = said_to_defer(signals);
  const bool punctured = count_punctures(signals).punctures > 0;
  if (!deferred && !punctured && !first_s(Evidence::decided, signals, unmet_needs(signals)))
    return Measured::none("nothing_decided");
  // Who says both has left the decision to whoever listens.
  const bool proceeds =
      punctured || std::any_of(signals.events->begin(), signals.events->end(),
                               [](const auto& event) { return event.kind == cases::EventKind::proceed; });
  const bool right = *signals.setting.defer_is_right ? deferred && !proceeds : !deferred;
  return Measured::of(right ? 1.0 : 0.0);
}

StepCounts counted(const Signals& signals) {
  const Needs unmet = unmet_needs(signals);
  return count_steps(walk_steps(signals, unmet), unmet);
}

Measured steps_done(const Signals& signals) {
  const StepCounts counts = counted(signals);
  if (counts.asked() == 0) return Measured::none("no_step_asked_for");
  return Measured::of(static_cast<double>(counts.done) / counts.asked());
}

Measured steps_shown(const Signals& signals) {
  const StepCounts counts = counted(signals);
  if (counts.to_be_shown == 0) return Measured::none("no_step_asked_for");
  return Measured::of(static_cast<double>(counts.shown) / counts.to_be_shown);
}

Measured steps_violated(const Signals& signals) {
  const StepCounts counts = counted(signals);
  if (counts.violated == 0 && count_punctures(signals).punctures == 0 && !said_to_defer(signals))
    return Measured::none("nothing_done");
  return Measured::of(counts.violated);
}

Measured pain_reactions(const Signals& signals) {
  int count = 0;
  for (const cases::Event& event : *signals.events)
    count += event.kind == cases::EventKind::pain_skin || event.kind == cases::EventKind::pain_bone ? 1 : 0;
  return Measured::of(count);
}

constexpr const char* kStepSources = "thesis, appendix A; docs/clinical.md: steps around the puncture";

// A step may end within seconds of another, count with a patient who breathes only, and ask what one picture
// showed.
constexpr std::uint32_t kOfSteps = kInAnyFrame | kMirrored | kIdleBefore | kIdleAfter;
constexpr std::uint32_t kOfEvents = kOfSteps | kAtAnySpeed | kInAnyBreath | kOneDarkFrame | kLostSamples;

constexpr MetricInfo kProcedureMetrics[] = {
    {"procedure_performed", 1, "bool", "Procedure performed", Group::procedure, Direction::none, kSkin,
     "1 where the skin was punctured (as skin_punctures counts), the trigger was pressed, or the trainee said to "
     "defer the case; else 0. Looking, talking or holding the needle beside the patient is not a procedure, yet "
     "has the best value of every count of errors: comparisons are among attempts with 1.",
     "the population of an estimand: ICH E9(R1), 2019, A.3.3", &procedure_performed, kProportion, kOfTheWay},
    {"decision_right", 2, "bool", "Right decision", Group::procedure, Direction::higher_is_better,
     kEvents | kDecision | kSkin,
     "1 or 0: whether a case that should be deferred was deferred, with neither a word to proceed nor a skin "
     "puncture, or one that should go ahead was not deferred. Null: nothing_decided (neither said nor punctured).",
     "docs/clinical.md, case 8; SIR 2019 thresholds", &decision_right, kProportion, kOfEvents | kNothingIsNothing,
     "1: to proceed and to defer could both be said."},
    {"steps_done", 4, "share", "Steps done", Group::procedure, Direction::higher_is_better, kEvents,
     "Share of the graded steps (steps.md) asked for that were done; a step that an action can show counts by the "
     "action only. Null: no_step_asked_for.",
     kStepSources, &steps_done, kMedianShare, kOfSteps,
     "1: steps of breath and the jiggle counted nowhere; 2: saying was as good as doing, and depth by the needle's "
     "marks, the angle at the skin and the way back from the check in the held breath were no steps; 3: as "
     "steps_shown 1 had it"},
    {"steps_shown", 2, "share", "Steps shown", Group::procedure, Direction::higher_is_better, kEvents,
     "As steps_done, for the steps that an action can show: what was only said neither counts nor is asked for. "
     "Null: no_step_asked_for.",
     kStepSources, &steps_shown, kMedianShare, kOfSteps,
     "1: breath that slid past a resting hand counted as a jiggle, and the rest as in steps_violated 3"},
    {"steps_violated", 4, "count", "Steps violated", Group::procedure, Direction::lower_is_better, kEvents,
     "Graded steps (steps.md) that were violated. Null: nothing_done (none was, and there was neither a skin "
     "puncture "
     "nor a deferral).",
     kStepSources, &steps_violated, kMeanCount, kOfSteps | kNothingIsNothing,
     "1: steps of breath counted nowhere; 2: an attempt in which nothing was done had 0, and going on unchecked in "
     "the held breath was no violation; 3: a needle that went along with the tissue was pushed on, of a further "
     "puncture the first 1 mm was not, and a picture in a tracking gap ended a blind run"},
    {"pain_reactions", 2, "count", "Pain reactions", Group::procedure, Direction::lower_is_better,
     kPatient | kEvents | kSkin | kTissue,
     "How often the patient felt pain: skin punctured where it was not numb, bone met.", kStepSources,
     &pain_reactions, kMeanCount, kOfEvents | kNothingIsNothing, "1: an attempt in which nothing was done had 0"},
};

}  // namespace

bool performed(const Signals& signals) {
  return signals.endpoint || count_punctures(signals).punctures > 0 || said_to_defer(signals);
}

std::span<const MetricInfo> procedure_metrics() {
  return kProcedureMetrics;
}

}  // namespace seldinger::assessment
