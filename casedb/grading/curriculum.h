// What is learnt in which order: items, each a case in whatever version is published, and gates between them. Made
// by mentors, published by a director (docs/grading.md), from there on as it is. One transaction a write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/progress.h"
#include "casedb/cases/case_state.h"
#include "casedb/database/library.h"

namespace seldinger::casedb {

struct CurriculumItem {
  std::string family_id;             // of the case: that of its version 1
  std::optional<int> attempt_limit;  // in place of the case's own
  std::vector<assessment::Gate> gates;
};

struct Curriculum {
  std::string curriculum_id, title;
  CurriculumState state = CurriculumState::draft;
  std::int64_t made_us = 0;
  std::vector<CurriculumItem> items;
};

// All of these: `no_user` (disabled too), `not_allowed`. By a mentor; `bad_title` (1 to 200 bytes on one line).
base::Result<std::string> add_curriculum(Library& library, const std::string& title, const std::string& by);
// At the end. By a mentor; `no_curriculum`, `not_a_draft`, `no_case`, `not_published` (the case), `no_rule`,
// `case_taken` (an item has it), `bad_item` (limit not 1 to 1000, a gate that names no earlier item). Answers its
// number, from 1.
base::Result<int> add_curriculum_item(Library& library, const std::string& curriculum_id,
                                      const std::string& case_id, std::optional<int> attempt_limit,
                                      const std::vector<assessment::Gate>& gates, const std::string& by);
// By a director; `no_curriculum`, `not_a_draft`, `no_items`, `not_published` (a case that was retired
// since).
base::Result<void> publish_curriculum(Library& library, const std::string& curriculum_id, const std::string& by);
// A draft is deleted by a mentor, a published one retired by a director; `no_curriculum`, `bad_state`.
base::Result<void> remove_curriculum(Library& library, const std::string& curriculum_id, const std::string& by);

std::vector<Curriculum> list_curricula(Library& library);                                      // oldest first
base::Result<Curriculum> find_curriculum(Library& library, const std::string& curriculum_id);  // `no_curriculum`

// An item's case, in every version.
struct FamilyVersion {
  std::string case_id, title;
  CaseState state = CaseState::draft;
  int version = 0;
  bool own_cohort_only = false;
};
std::vector<FamilyVersion> versions_of(Library& library, const std::string& family_id);  // newest first

}  // namespace seldinger::casedb
