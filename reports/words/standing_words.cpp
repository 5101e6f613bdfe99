#include "reports/words/standing_words.h"

#include <algorithm>

#include "assessment/statistics/relations/proportions.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Standing;

// "2. Liver biopsy"
std::string item_text(const casedb::CurriculumRecord& record, std::size_t index) {
  return std::to_string(index + 1) + ". " + record.items.at(index).title;
}

std::string count_text(int count, std::string_view one) {
  return std::to_string(count) + " " + std::string(one) + (count == 1 ? "" : "s");
}

std::string stuck_text(const assessment::StandingFound& found, const casedb::CurriculumRecord& record) {
  const std::string where = item_text(record, *found.item);
  std::string text;
  if (found.no_attempts_left) text = "No attempts left at " + where + ". ";
  if (found.misses > 0)
    text += count_text(found.misses, "attempt") + " running at " +
            (found.no_attempts_left ? std::string("it") : where) + ", none passed";
  if (!found.missed_most.empty())
    text += "; missed most: " + metric_label(found.missed_most) + " (" + std::to_string(found.missed_times) +
            " of " + std::to_string(found.misses) + ")";
  if (found.misses > 0) text += ".";
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

std::string standing_text(Standing standing) {
  switch (standing) {
    case Standing::ready:
      return "Ready";
    case Standing::nearly:
      return "Nearly";
    case Standing::under_way:
      return "Under way";
    case Standing::stuck:
      return "Stuck";
    case Standing::absent:
      return "Absent";
    case Standing::lapsed:
      return "Lapsed";
    case Standing::not_started:
      return "Not started";
  }
  return {};
}

std::string evidence_text(const assessment::StandingFound& found, const casedb::CurriculumRecord& record,
                          std::int64_t now_us) {
  switch (found.standing) {
    case Standing::ready:
      return "Proficient in every item.";
    case Standing::nearly:
      return "One more pass at " + item_text(record, *found.item) + ", at the next attempt.";
    case Standing::under_way:
      return proficient_text(record.items) + " items proficient; " + std::to_string(found.passes_missing) +
             (found.passes_missing == 1 ? " pass" : " passes") + " to go.";
    case Standing::stuck:
      return stuck_text(found, record);
    case Standing::absent:
      return "Last attempt " + days_ago_text(*found.last_us, now_us) + "; " + proficient_text(record.items) +
             " items proficient.";
    case Standing::lapsed:
      return "Last pass of " + item_text(record, *found.item) + " " + days_ago_text(*found.last_us, now_us) + ".";
    case Standing::not_started:
      return "No attempt yet.";
  }
  return {};
}

std::string proficient_text(std::span<const casedb::ItemState> items) {
  const auto count = std::count_if(items.begin(), items.end(), [](const casedb::ItemState& item) {
    return item.progress.reached == assessment::Proficiency::proficient;
  });
  return std::to_string(count) + " of " + std::to_string(items.size());
}

std::string passes_text(const casedb::ItemState& item) {
  const auto graded = std::count_if(item.graded.begin(), item.graded.end(), [](const auto& one) {
    return one.verdict == assessment::Verdict::passed || one.verdict == assessment::Verdict::failed;
  });
  if (graded == 0) return "none graded";
  const assessment::statistics::Interval share =
      assessment::statistics::wilson_interval(item.passes, static_cast<std::int64_t>(graded));
  return std::to_string(item.passes) + " of " + std::to_string(graded) + " (" + number_text(100.0 * share.low, 0) +
         " to " + number_text(100.0 * share.high, 0) + " %)";
}

std::string days_ago_text(std::int64_t then_us, std::int64_t now_us) {
  const std::int64_t days = (now_us - then_us) / assessment::kDay_us;
  if (days <= 0) return "today";
  return days == 1 ? "yesterday" : std::to_string(days) + " days ago";
}

}  // namespace seldinger::reports
