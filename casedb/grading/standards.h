// Standards: what consultants do on a task, frozen when a director sets it. Only values of people who were
// consultants when the attempt began enter; what was simulated never does.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/standard.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"

namespace seldinger::casedb {

// What is done alike: only attempts at one task are held against each other.
struct Task {
  std::string case_id, lesion_id;
  cases::Modality modality = cases::Modality::mpr;
  cases::Approach approach = cases::Approach::in_plane;
  cases::InstrumentKind instrument = cases::InstrumentKind::access;
  auto operator<=>(const Task&) const = default;
};
Task task_of(const AttemptHead& attempt);

// Whether it was ended as the case wants it: fired, or where deferring is right given up without a shot.
bool completed(const AttemptRow& attempt, const CaseSetting& setting) noexcept;
// The newest versions first, so that whoever looks for one by id alone finds that.
std::vector<MetricValue> every_version(const AttemptRow& attempt);
// How an attempt ended through no decision of whoever made it; empty otherwise.
std::string_view cut_off_of(const AttemptRow& attempt) noexcept;

// Those whose attempts would make a standard of the task now, with the bands that it would have.
assessment::ExpertSet consultants_of(Library& library, const Task& task);

struct Standard {
  std::string lesion_id;
  std::string modality, approach, instrument;  // by name
  assessment::ExpertSet set;
  bool by_operator = false;  // who entered it in a director's name
};
// Freezes consultants_of the task; with the case's own approach and needle, and its guidance and target unless
// told. By a director whose attempts are not among them. Answers its id. Refused: `no_user`, `no_case`,
// `no_lesion`, `no_rule`, `too_few_consultants`, `not_allowed`, `same_standard` (it would be the one in force).
base::Result<std::string> set_standard(Library& library, const std::string& case_id, const std::string& lesion_id,
                                       std::optional<cases::Modality> modality, const std::string& by);

std::vector<Standard> list_standards(Library& library, const std::string& case_id);  // newest first
// The one in force: the newest of the task.
std::optional<assessment::ExpertSet> standard_of(Library& library, const Task& task);

}  // namespace seldinger::casedb
