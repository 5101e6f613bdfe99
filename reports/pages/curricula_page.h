// Curricula: what is learnt in which order. How far somebody is stands on the pages of progress.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "casedb/grading/learner_records.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct CurriculumView {
  casedb::Curriculum curriculum;
  std::vector<casedb::ItemState> items;
};

std::string curricula_page(const Visitor& visitor, std::span<const CurriculumView> curricula);

std::string proficiency_text(assessment::Proficiency reached);  // "Not started", "Practising", …

// "after 1 is passed and 2 is proficient"; empty without gates.
std::string gates_text(const std::vector<assessment::Gate>& gates);

}  // namespace seldinger::reports
