#include "casedb/people/told_cells.h"

#include <algorithm>
#include <array>
#include <set>

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "sim/base/check.h"
#include "sim/base/names.h"

namespace seldinger::casedb {
namespace {

constexpr auto kDeeds = base::names<Deed>({{Deed::came, "came"},
                                           {Deed::left, "left"},
                                           {Deed::unknown, "unknown"},
                                           {Deed::miss, "miss"},
                                           {Deed::hit, "hit"}});

// Who contributes how often to a count; never 0.
using Shares = std::map<std::string, int>;

// What is counted: learners, and attempts of every set of the three kinds, since all of them follow from the cells
// by subtraction. Under the sum of the kinds' bits.
constexpr unsigned kUnknown = 1, kMissed = 2, kHit = 4;
constexpr unsigned kLearners = 0, kWithHit = kMissed | kHit, kAttempts = kUnknown | kMissed | kHit, kCounts = 8;
using Counts = std::array<Shares, kCounts>;

void apply(Counts& counts, const CohortDeed& deed) {
  const auto done = [&](unsigned kind) {
    for (unsigned kinds = 1; kinds < kCounts; ++kinds)
      if ((kinds & kind) != 0) ++counts[kinds][deed.person_id];
  };
  switch (deed.what) {
    case Deed::came:
      counts[kLearners][deed.person_id] = 1;
      return;
    case Deed::left:
      counts[kLearners].erase(deed.person_id);
      return;
    case Deed::unknown:
      return done(kUnknown);
    case Deed::miss:
      return done(kMissed);
    case Deed::hit:
      return done(kHit);
  }
}

int sum_of(const Shares& shares) {
  int sum = 0;
  for (const auto& [person_id, share] : shares) sum += share;
  return sum;
}

constexpr std::int64_t kMonday_us = 4 * 24 * 3'600'000'000;  // 1970-01-05

// The end of the week in which it was.
std::int64_t week_end_us(std::int64_t at_us) {
  return at_us - ((at_us - kMonday_us) % kWeek_us + kWeek_us) % kWeek_us + kWeek_us;
}

// What was told so far. It only grows, so that what is told of a week stays as it was when that week ended.
class Telling {
 public:
  Telling(const std::vector<CohortPast>& pasts, int smallest) : smallest_(smallest), told_(pasts.size()) {
    std::map<std::string, std::set<std::size_t>> cohorts_of;
    for (std::size_t i = 0; i < pasts.size(); ++i)
      for (const CohortDeed& deed : pasts[i].deeds) cohorts_of[deed.person_id].insert(i);
    related_.resize(pasts.size());
    for (const auto& [person_id, cohorts] : cohorts_of)
      for (const std::size_t cohort : cohorts) related_[cohort].insert(cohorts.begin(), cohorts.end());
  }
  void note(const std::string& person_id, const std::string& programme) {
    programmes_[person_id].insert(programme);
  }
  // Whether the count itself, and its difference to every one told before, is nobody's or enough people's. Of two
  // cohorts without a common person the difference is as many people's as each of them.
  bool may_tell(std::size_t cohort, unsigned what, const Shares& shares) const {
    if (!enough_or_none(shares, {})) return false;
    return std::ranges::all_of(related_[cohort], [&](std::size_t other) {
      return std::ranges::all_of(told_[other][what],
                                 [&](const Shares& before) { return enough_or_none(shares, before); });
    });
  }
  void tell(std::size_t cohort, unsigned what, const Shares& shares) {
    auto& told = told_[cohort][what];
    if (std::ranges::find(told, shares) == told.end()) told.push_back(shares);
  }

 private:
  bool enough_or_none(const Shares& a, const Shares& b) const {
    int differing = 0, alone = 0;
    const auto look = [&](const std::string& person_id) {
      ++differing;
      alone += programmes_.at(person_id).size() == 1 ? 1 : 0;
    };
    for (const auto& [person_id, share] : a)
      if (const auto found = b.find(person_id); found == b.end() || found->second != share) look(person_id);
    for (const auto& [person_id, share] : b)
      if (!a.contains(person_id)) look(person_id);
    return differing == 0 || alone >= smallest_;
  }
  int smallest_;
  std::map<std::string, std::set<std::string>> programmes_;  // by person, so far
  std::vector<std::set<std::size_t>> related_;               // by cohort: those with a common person, and itself
  std::vector<std::array<std::vector<Shares>, kCounts>> told_;
};

}  // namespace

std::map<std::string, ToldCells> told_cells(const std::vector<CohortPast>& pasts, std::int64_t now_us,
                                            int smallest) {
  struct Dated {
    std::int64_t at_us;
    std::size_t cohort;
    const CohortDeed* deed;
  };
  std::vector<Dated> all;
  std::map<std::string, ToldCells> told;
  for (std::size_t i = 0; i < pasts.size(); ++i) {
    told[pasts[i].cohort_id];
    for (const CohortDeed& deed : pasts[i].deeds)
      if (week_end_us(deed.at_us) + kToldAfter_us <= now_us) all.push_back({deed.at_us, i, &deed});
  }
  std::ranges::stable_sort(all, {}, &Dated::at_us);

  Telling telling(pasts, smallest);
  std::vector<Counts> counts(pasts.size());
  const auto end_week = [&](std::int64_t end_us, const std::set<std::size_t>& changed) {
    for (const std::size_t i : changed) {
      const Counts& of = counts[i];
      ToldCells& cells = told[pasts[i].cohort_id];
      const auto may_tell = [&](unsigned what) { return telling.may_tell(i, what, of[what]); };
      if (!of[kLearners].empty() && may_tell(kLearners)) {
        telling.tell(i, kLearners, of[kLearners]);
        cells.cells.learners = sum_of(of[kLearners]);
        cells.learners_us = end_us;
      }
      if (of[kAttempts].empty() || !may_tell(kAttempts)) continue;
      telling.tell(i, kAttempts, of[kAttempts]);
      cells.cells.attempts = sum_of(of[kAttempts]);
      cells.attempts_us = end_us;
      bool told_apart = true;
      for (unsigned kinds = 1; kinds < kAttempts; ++kinds) told_apart = told_apart && may_tell(kinds);
      if (!told_apart) continue;
      for (unsigned kinds = 1; kinds < kAttempts; ++kinds) telling.tell(i, kinds, of[kinds]);
      cells.cells.with_hit = sum_of(of[kWithHit]);
      cells.cells.hits = sum_of(of[kHit]);
      cells.hits_us = end_us;
    }
  };
  std::set<std::size_t> changed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    apply(counts[all[i].cohort], *all[i].deed);
    telling.note(all[i].deed->person_id, pasts[all[i].cohort].programme);
    changed.insert(all[i].cohort);
    const std::int64_t end_us = week_end_us(all[i].at_us);
    if (i + 1 < all.size() && week_end_us(all[i + 1].at_us) == end_us) continue;
    end_week(end_us, changed);
    changed.clear();
  }
  return told;
}

std::vector<CohortPast> list_cohort_pasts(Library& library) {
  const Snapshot snapshot(library.database());
  std::vector<CohortPast> pasts;
  for (Statement rows = question(library.database(), "cohorts"); rows.step();)
    pasts.push_back({rows.text("cohort_id"), rows.text("programme"), {}});
  std::ranges::sort(pasts, {}, &CohortPast::cohort_id);
  for (Statement rows = question(library.database(), "cohort_deeds"); rows.step();) {
    const auto at = std::ranges::lower_bound(pasts, rows.text("cohort_id"), {}, &CohortPast::cohort_id);
    const auto what = base::from_name(kDeeds, rows.text("what"));
    CHECK(at != pasts.end() && what.has_value());
    at->deeds.push_back({rows.text("person_id"), rows.integer("at_us"), *what});
  }
  return pasts;
}

}  // namespace seldinger::casedb
