// The steps of a puncture as its task analysis tells them (thesis, appendix A; docs/clinical.md, "Steps around the
// puncture"), as data: which evidence completes a step, by when, and which violates it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/procedure/evidence.h"

namespace seldinger::assessment {

// Higher when a row below changes its meaning: stored results keep theirs. 2: a held breath and a jiggle count
// where tissue moves. 3: what a deed can show is done by the deed, not by being said.
// 4: what breath does to a needle at rest, in the room or in the tissue, is neither a jiggle nor pushed on; of a
// further puncture the first 1 mm counts, too, and a picture in a tracking gap ends no blind run.
constexpr int kStepsVersion = 4;

struct StepInfo {
  const char* id;
  const char* words;  // as a checklist says it
  Needs needs;        // Need, or-ed: of the manner and the case; without one the step is not asked for
  Evidence completes;
  Evidence by;        // done later than this it is skipped; none: any time will do
  Evidence violates;  // none: it cannot be violated
  // Counts in steps_done and steps_violated where these Needs, or-ed, are met; 0: everywhere.
  Needs graded_with;
  const char* source;
  Evidence said = Evidence::none;        // of a step that a deed shows: what is said about it, told and not counted
  Evidence asked_when = Evidence::none;  // it was there, else the step is not asked for; none: always
  // Whether a deed completes it; else it is taken at its word.
  constexpr bool shown() const noexcept { return !is_said(completes); }
};

// In the order in which they are to be done.
std::span<const StepInfo> procedure_steps();
const StepInfo* find_step(std::string_view id);

enum class StepState : std::uint8_t { done, skipped, violated, not_asked };
enum class StepHow : std::uint8_t { shown, said };

struct StepResult {
  std::string id;
  int version = kStepsVersion;
  StepState state = StepState::not_asked;
  std::optional<double> t_s;  // when it was done (skipped: too late) or violated
  std::string reason;         // of not_asked: a need's reason, `deferred` or `no_such_event`; else empty
  // Of done: by deed, or said. Of skipped: said, where a deed would have shown it. Else nothing, and of what was
  // stored before version 3.
  std::optional<StepHow> how{};
  bool operator==(const StepResult&) const = default;
};

std::string_view name_of(StepState state) noexcept;
std::optional<StepState> step_state_from(std::string_view name) noexcept;
std::string_view name_of(StepHow how) noexcept;
std::optional<StepHow> step_how_from(std::string_view name) noexcept;

// Every step, in order; `unmet` as unmet_needs() says.
std::vector<StepResult> walk_steps(const Signals& signals, Needs unmet);
std::vector<StepResult> walk_steps(const Signals& signals);

// Of those that are graded and were asked for.
struct StepCounts {
  int done = 0, skipped = 0, violated = 0;
  int shown = 0, to_be_shown = 0;  // of those that a deed can show: done, and asked for
  int asked() const noexcept { return done + skipped + violated; }
};
StepCounts count_steps(std::span<const StepResult> results, Needs unmet);

// docs/steps.md, from the tables.
std::string steps_markdown();

}  // namespace seldinger::assessment
