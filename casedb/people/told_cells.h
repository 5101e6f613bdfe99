// What a cohort did together, for who does not see its people: counts to which, and to whose change since any count
// told before, at least kSmallestCell people contribute (docs/decisions/0069). It is the same for every such
// reader, so nobody gains by putting two views together, and follows from what happened, not from when it was
// asked.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "casedb/people/cohorts.h"

namespace seldinger::casedb {

enum class Deed { came, left, unknown, miss, hit };  // the last three are attempts: with an unknown hit, …

struct CohortDeed {
  std::string person_id;
  std::int64_t at_us = 0;
  Deed what = Deed::came;
};

struct CohortPast {
  std::string cohort_id, programme;
  std::vector<CohortDeed> deeds;  // of learners, in any order
};

struct ToldCells {
  CohortCells cells{-1, -1, -1, -1};
  // The end of the week of which each count tells; 0 where it is withheld. `hits_us` is also that of `with_hit`.
  std::int64_t learners_us = 0, attempts_us = 0, hits_us = 0;
  constexpr bool operator==(const ToldCells&) const noexcept = default;
};

// Weeks end on Monday, 0:00 UTC, and are told of a day later, when attempts that began in them are stored.
inline constexpr std::int64_t kWeek_us = 7 * 24 * 3'600'000'000, kToldAfter_us = 24 * 3'600'000'000;

// By cohort id, as they stand at `now_us`. People who are or were learners in another programme too are told of by
// name to who directs that, so they do not count among the `smallest`.
std::map<std::string, ToldCells> told_cells(const std::vector<CohortPast>& pasts, std::int64_t now_us,
                                            int smallest = kSmallestCell);

std::vector<CohortPast> list_cohort_pasts(Library& library);  // oldest cohort first

}  // namespace seldinger::casedb
