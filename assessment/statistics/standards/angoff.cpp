#include "assessment/statistics/standards/angoff.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "assessment/statistics/distributions.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr std::size_t kFewJudges = 5;

// Each judge's share of the items that somebody just good enough gets right.
std::vector<double> judges_cuts(const CompleteTable& judged) {
  std::vector<double> cuts;
  for (std::size_t judge = 0; judge < judged.columns.size(); ++judge)
    cuts.push_back(spread_of(judged.column(judge)).mean);
  return cuts;
}

std::optional<Interval> over_judges(const Spread& cuts) {
  if (!cuts.computable || !(cuts.variance > 0.0)) return std::nullopt;
  const double n = static_cast<double>(cuts.n);
  const double off = student_t_quantile(0.975, n - 1.0) * std::sqrt(cuts.variance / n);
  return Interval{std::max(0.0, cuts.mean - off), std::min(1.0, cuts.mean + off)};
}

const char* reason_against(const CompleteTable& judged) {
  if (const char* reason = smaller_than(judged, 1, 2)) return reason;
  const bool shares =
      std::all_of(judged.values.begin(), judged.values.end(), [](double one) { return one >= 0.0 && one <= 1.0; });
  return shares ? nullptr : "bad_value";
}

Row row_of(const AngoffRound& round, const Spread& cuts) {
  const double items = static_cast<double>(round.judged.rows);
  return {"round " + std::to_string(static_cast<long>(round.number)),
          {{"judges", static_cast<double>(cuts.n)},
           {"items", items},
           {"cut", cuts.mean},
           {"cut_items", cuts.mean * items},
           {"sd_of_judges", std::sqrt(cuts.variance)}}};
}

}  // namespace

Answer angoff(const std::vector<AngoffRound>& rounds) {
  if (rounds.empty()) return not_estimable("angoff", "no_data", 0);
  for (const AngoffRound& round : rounds)
    if (const char* reason = reason_against(round.judged))
      return refused_table("angoff", reason, round.judged,
                           "Every round needs two judges and an item, and shares from 0 to 1 of every judge.");
  const CompleteTable& judged = rounds.back().judged;
  const Spread cuts = spread_of(judges_cuts(judged));
  const double items = static_cast<double>(judged.rows), judges = static_cast<double>(cuts.n);
  const double se = std::sqrt(cuts.variance / judges);
  Answer answer;
  answer.test = "angoff";
  answer.method = "Modified Angoff: mean over judges of the judged shares; interval by t over judges";
  answer.n = cuts.n;
  answer.missing = judged.missing;
  answer.estimate = cuts.mean;
  answer.estimate_name = "cut, as a share of the items";
  answer.ci95 = over_judges(cuts);
  answer.df = {judges - 1.0};
  answer.more = {{"items", items},
                 {"se", se},
                 {"cut_items", cuts.mean * items},
                 {"se_items", se * items},
                 {"sd_of_judges", std::sqrt(cuts.variance)}};
  for (const AngoffRound& round : rounds)
    answer.rows.push_back(row_of(round, spread_of(judges_cuts(round.judged))));
  if (!answer.ci95)
    answer.notes.emplace_back("All judges give the same cut: their disagreement gives no interval.");
  if (cuts.n < kFewJudges)
    answer.notes.emplace_back("Fewer than five judges: too few to set a standard by, whatever the interval.");
  if (judged.missing > 0) answer.notes.emplace_back("Items that some judge did not judge are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
