// One learner: where they stand in each curriculum and by which rule, item by item, attempt by attempt; and a
// record of it to print and sign.
#pragma once

#include <map>
#include <span>
#include <string>

#include "reports/learning/learning_charts.h"
#include "reports/pages/page.h"
#include "reports/pages/people/learner_view.h"

namespace seldinger::reports {

// `own`: the reader is the learner. `items`: what they did, case by case.
std::string learner_page(const Visitor& visitor, const LearnerView& learner, std::span<const LearnerItem> items,
                         bool own, std::int64_t now_us);

// What is due in a curriculum and why, to the learner; empty: nothing is.
Html due_lines(const casedb::CurriculumRecord& record);

// Of each item, how its standard is called and whether it is provisional; by case id.
using StandardTexts = std::map<std::string, std::string>;
std::string learner_record_page(const Visitor& visitor, const LearnerView& learner, const StandardTexts& standards,
                                std::int64_t now_us);

}  // namespace seldinger::reports
