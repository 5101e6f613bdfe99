#include "assessment/grading/standing.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sim/base/names.h"

namespace seldinger::assessment {
namespace {

constexpr auto kNames = base::names<Standing>({{Standing::ready, "ready"},
                                               {Standing::nearly, "nearly"},
                                               {Standing::under_way, "under_way"},
                                               {Standing::stuck, "stuck"},
                                               {Standing::absent, "absent"},
                                               {Standing::lapsed, "lapsed"},
                                               {Standing::not_started, "not_started"}});

// The attempts since the last pass that were graded and not passed, oldest first.
std::vector<GradedAttempt> misses_of(const ItemRecord& item) {
  std::vector<GradedAttempt> misses;
  for (const GradedAttempt& one : item.graded) {
    if (one.verdict == Verdict::passed) misses.clear();
    if (one.verdict == Verdict::failed) misses.push_back(one);
  }
  return misses;
}

std::optional<std::int64_t> last_pass_us(const ItemRecord& item) {
  std::optional<std::int64_t> last;
  for (const GradedAttempt& one : item.graded)
    if (one.verdict == Verdict::passed) last = one.started_us;
  return last;
}

// The first item that keeps somebody from going on.
bool find_stuck(std::span<const ItemRecord> items, StandingFound& found) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ItemProgress& progress = items[i].progress;
    if (progress.reached == Proficiency::proficient) continue;
    const auto misses = misses_of(items[i]);
    const bool used_up = progress.open && progress.attempts_left == 0;
    if (!used_up && !(progress.due && std::cmp_greater_equal(misses.size(), kStuckAfter))) continue;
    found.standing = Standing::stuck;
    found.item = i;
    found.misses = static_cast<int>(misses.size());
    found.no_attempts_left = used_up;
    if (!misses.empty()) found.last_us = misses.front().started_us;
    if (const std::vector<Missed> missed = missed_in(misses); !missed.empty()) {
      found.missed_most = missed.front().metric;
      found.missed_times = missed.front().times;
    }
    return true;
  }
  return false;
}

}  // namespace

std::vector<Missed> missed_in(std::span<const GradedAttempt> attempts) {
  std::map<std::string, int> counts;
  for (const GradedAttempt& one : attempts)
    for (const std::string& id : one.missed) ++counts[id];
  std::vector<Missed> missed;
  for (const auto& [id, times] : counts) missed.push_back({id, times});
  std::stable_sort(missed.begin(), missed.end(),
                   [](const Missed& a, const Missed& b) { return a.times > b.times; });
  return missed;
}

std::string_view name_of(Standing standing) noexcept {
  return base::name_of(kNames, standing);
}

std::optional<Standing> standing_from(std::string_view name) noexcept {
  return base::from_name(kNames, name);
}

std::string rule_of(Standing standing) {
  switch (standing) {
    case Standing::ready:
      return "Proficient in every item, and no item's last pass is older than " + std::to_string(kRetentionDays) +
             " days.";
    case Standing::nearly:
      return "All but one item are proficient, and one more pass at the next attempt makes that one too.";
    case Standing::under_way:
      return "None of the other rules applies.";
    case Standing::stuck:
      return "The last " + std::to_string(kStuckAfter) +
             " graded attempts at the item that is due, or more, were not passed; or an item that is open has no "
             "attempts left.";
    case Standing::absent:
      return "Not finished, and no attempt for " + std::to_string(kAbsentAfterDays) + " days.";
    case Standing::lapsed:
      return "Proficient in every item, but an item's last pass is older than " + std::to_string(kRetentionDays) +
             " days: a retention attempt is due.";
    case Standing::not_started:
      return "No attempt at any item yet.";
  }
  return {};
}

StandingFound standing_of(std::span<const ItemRecord> items, std::int64_t now_us) {
  StandingFound found;
  std::optional<std::int64_t> last_attempt_us;
  std::size_t not_proficient = 0, open_item = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (const GradedAttempt& one : items[i].graded)
      last_attempt_us = std::max(last_attempt_us.value_or(one.started_us), one.started_us);
    found.passes_missing += items[i].progress.passes_missing;
    if (items[i].progress.reached == Proficiency::proficient) continue;
    ++not_proficient;
    open_item = i;
  }
  if (!last_attempt_us) return found;

  if (not_proficient == 0) {
    found.standing = Standing::ready;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto pass_us = last_pass_us(items[i]);
      if (!pass_us || now_us - *pass_us <= kRetentionDays * kDay_us) continue;
      if (found.last_us && *found.last_us <= *pass_us) continue;
      found.standing = Standing::lapsed;
      found.item = i;
      found.last_us = pass_us;
    }
    return found;
  }
  if (now_us - *last_attempt_us > kAbsentAfterDays * kDay_us) {
    found.standing = Standing::absent;
    found.last_us = last_attempt_us;
    return found;
  }
  if (find_stuck(items, found)) return found;
  found.standing = Standing::under_way;
  if (not_proficient == 1 && items[open_item].progress.passes_missing == 1) {
    found.standing = Standing::nearly;
    found.item = open_item;
  }
  return found;
}

}  // namespace seldinger::assessment
