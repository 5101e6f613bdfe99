// One learner: where they stand in each curriculum and by which rule, item by item, attempt by attempt; and a
// record of it to print and sign.
#pragma once

#include <map>
#include <string>

#include "reports/pages/page.h"
#include "reports/pages/people/learner_view.h"

namespace seldinger::reports {

// `own`: the reader is the learner.
std::string learner_page(const Visitor& visitor, const LearnerView& learner, bool own, std::int64_t now_us);

// Of each item, how its standard is called and whether it is provisional; by case id.
using StandardTexts = std::map<std::string, std::string>;
std::string learner_record_page(const Visitor& visitor, const LearnerView& learner, const StandardTexts& standards,
                                std::int64_t now_us);

}  // namespace seldinger::reports
