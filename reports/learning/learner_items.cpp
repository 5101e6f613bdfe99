#include <algorithm>

#include "casedb/cases/cases.h"
#include "reports/learning/learning_charts.h"
#include "sim/base/check.h"

namespace seldinger::reports {

std::vector<LearnerItem> learner_items(casedb::Library& library, std::vector<casedb::LearningAttempt> attempts) {
  std::vector<LearnerItem> items;
  for (casedb::LearningAttempt& one : attempts) {
    auto item = std::find_if(items.begin(), items.end(), [&](const LearnerItem& other) {
      return other.attempts.front().family_id == one.family_id;
    });
    if (item == items.end()) item = items.insert(items.end(), LearnerItem{});
    item->attempts.push_back(std::move(one));
  }
  for (LearnerItem& item : items) {
    const casedb::LearningAttempt& last = item.attempts.back();
    const auto row = casedb::find_case(library, last.case_id);
    CHECK(row.has_value());
    item.title = row->title;
    item.rule = row->rule;
    item.experts = casedb::standard_of(library, last.task).value_or(assessment::ExpertSet{});
  }
  return items;
}

}  // namespace seldinger::reports
