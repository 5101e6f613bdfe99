// Where a learner stands in a curriculum, as whoever answers for them asks: is anybody ready, stuck, gone? One rule
// for each answer, decided by what is stored; nothing is a forecast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/progress.h"

namespace seldinger::assessment {

enum class Standing { ready, nearly, under_way, stuck, absent, lapsed, not_started };
std::string_view name_of(Standing standing) noexcept;
std::optional<Standing> standing_from(std::string_view name) noexcept;
// In the order in which a list of people shows them: who needs somebody first.
inline constexpr Standing kAllStandings[] = {Standing::stuck,      Standing::absent, Standing::lapsed,
                                             Standing::nearly,     Standing::ready,  Standing::under_way,
                                             Standing::not_started};

inline constexpr std::int64_t kDay_us = std::int64_t{24} * 3600 * 1'000'000;

// Who passes half of their attempts misses five running in 3 of 100 such rows (0.5^5).
inline constexpr int kStuckAfter = 5;
// Four weeks without an attempt while something is due: a judgement.
inline constexpr int kAbsentAfterDays = 28;
// Of skills learnt to mastery on a simulator of venous puncture, 82 % were held at six months, the first time that
// they were tested again (Barsuk et al., Acad Med 2010;85(10 Suppl):S9-12).
inline constexpr int kRetentionDays = 180;

// The rule in one sentence, as pages print it.
std::string rule_of(Standing standing);

// One attempt at an item, graded by the rule of its own version.
struct GradedAttempt {
  std::string attempt_id;
  std::int64_t started_us = 0;
  double duration_s = 0.0;
  Verdict verdict = Verdict::no_rule;
  std::vector<std::string> missed;  // ids of the metrics whose criterion was missed or not measured
};

// What attempts that did not pass have missed, most often first; by id where as often.
struct Missed {
  std::string metric;
  int times = 0;
};
std::vector<Missed> missed_in(std::span<const GradedAttempt> attempts);

struct ItemRecord {
  ItemProgress progress;
  std::vector<GradedAttempt> graded;  // oldest first
};

struct StandingFound {
  Standing standing = Standing::not_started;
  std::optional<std::size_t> item;      // that it is about
  std::optional<std::int64_t> last_us;  // absent: the last attempt; lapsed: the last pass; stuck: the first miss
  int misses = 0;                       // stuck: running, up to now
  bool no_attempts_left = false;        // stuck
  std::string missed_most;              // of these misses, the metric missed in most; empty: none
  int missed_times = 0;
  int passes_missing = 0;  // to proficient in every item
};

// Decided in this order: nothing was attempted: not_started. Every item proficient: lapsed when the last pass of
// one is older than kRetentionDays, else ready. Otherwise absent, stuck, nearly, under_way. A curriculum without
// items is never begun.
StandingFound standing_of(std::span<const ItemRecord> items, std::int64_t now_us);

}  // namespace seldinger::assessment
