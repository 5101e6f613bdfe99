// Curricula: what is learnt in which order. How far somebody is stands on the pages of progress.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/grading/learner_records.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct CurriculumView {
  casedb::Curriculum curriculum;
  std::vector<casedb::ItemState> items;
};

// `dependability`: of passing a case, by what people did.
std::string curricula_page(const Visitor& visitor, std::span<const CurriculumView> curricula,
                           const assessment::statistics::Answer& dependability);

std::string proficiency_text(assessment::Proficiency reached);  // "Not started", "Practising", …

// "after 1 is passed and 2 is proficient"; empty without gates.
std::string gates_text(const std::vector<assessment::Gate>& gates);

}  // namespace seldinger::reports
