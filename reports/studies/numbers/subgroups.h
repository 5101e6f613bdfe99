// Who is at the pass mark, by what may not matter: the hand that led the needle, the device, the writing hand, the
// site. Of both groups of an outcome together; of few persons nothing is told.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/studies/study_data.h"
#include "reports/studies/numbers/decision_numbers.h"

namespace seldinger::reports {

// Fewer passed or failed than this on either side: the difference describes these persons and no others.
inline constexpr std::int64_t kDescriptiveBelow = 5;

struct Subgroup {
  std::string name;
  std::vector<bool> passed;  // of each person
  bool told = true;          // else it is, or would tell, a cell of fewer than casedb::kSmallestCell persons
  std::int64_t passes() const;
  std::int64_t n() const { return static_cast<std::int64_t>(passed.size()); }
  // Of who is told.
  assessment::statistics::Interval share{};                      // Wilson's
  std::optional<assessment::statistics::Interval> difference{};  // Newcombe's, from the largest; of that one none
  bool descriptive = false;
};
struct Subgroups {
  std::string by;                // "Needle led by"
  std::vector<Subgroup> groups;  // the largest first, then by name
};
// Each way to part them in which there are two or more.
std::vector<Subgroups> subgroups_of(const assessment::study::Compared& outcome, const PassMark& mark,
                                    const std::map<std::string, casedb::Background>& backgrounds);

}  // namespace seldinger::reports
