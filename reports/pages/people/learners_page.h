// Learners × curriculum: who is ready, nearly, stuck, absent or lapsed, by which rule and on what evidence; and
// which item keeps how many.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/pages/page.h"
#include "reports/pages/people/learner_view.h"

namespace seldinger::reports {

// What the list is narrowed to; empty: everything.
struct LearnersPart {
  std::string curriculum_id;  // of one that is published; empty: the oldest
  std::string cohort;         // a title among those of `cohorts`
  std::string standing;       // as assessment::name_of
};

struct LearnersView {
  std::vector<LearnerView> learners;  // every one that the reader may see
  std::vector<std::string> cohorts;   // titles
  LearnersPart part;
  std::int64_t now_us = 0;
};

std::string learners_page(const Visitor& visitor, const LearnersView& view);

}  // namespace seldinger::reports
