#include "assessment/statistics/growth/rasch/facets.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/check.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr int kMostScore = 9;

class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}
  std::size_t of(const std::string& name) {
    const auto [at, is_new] = places_.emplace(name, names_.size());
    if (is_new) names_.push_back(name);
    return at->second;
  }

 private:
  std::vector<std::string>& names_;
  std::map<std::string, std::size_t> places_;
};

struct Scored {
  std::size_t person, item, rater;
  int score;
};

bool is_score(double value) {
  return value >= 0.0 && value <= kMostScore && value == std::floor(value);
}

std::vector<Scored> all_scored(const DataTable& table, Facets& facets) {
  const bool items_in_rows = table.values.size() == 1 && !table.group.empty();
  Names items(facets.items), raters(facets.raters), persons(facets.persons);
  if (!items_in_rows)
    for (const Column& column : table.values) facets.items.push_back(column.name);
  std::vector<Scored> scored;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const bool nobody = !table.subject.empty() && table.subject[i].empty();
    const bool no_rater = !table.rater.empty() && table.rater[i].empty();
    if (nobody || no_rater || (items_in_rows && table.group[i].empty())) {
      ++facets.missing;
      continue;
    }
    const std::size_t person = persons.of(table.subject.empty() ? std::to_string(i + 1) : table.subject[i]);
    const std::size_t rater = table.rater.empty() ? 0 : raters.of(table.rater[i]);
    for (std::size_t c = 0; c < table.values.size(); ++c) {
      const double value = table.values[c].values[i];
      if (std::isnan(value)) {
        ++facets.missing;
        continue;
      }
      if (!is_score(value)) {
        facets.reason = "bad_value";
        facets.why = "A score is not a whole number from 0 to 9.";
        return {};
      }
      scored.push_back({person, items_in_rows ? items.of(table.group[i]) : c, rater, static_cast<int>(value)});
    }
  }
  return scored;
}

// Sum of what is scored and of what could be, over cells that are in.
struct Sums {
  int got = 0, could = 0;
  void add(int score, int most) {
    if (score < 0) return;
    got += score;
    could += most;
  }
  bool extreme() const { return got == 0 || got == could; }
  bool any() const { return could > 0; }
};

template <typename Of>
bool drop_extreme(Facets& facets, const std::vector<bool>& person_out, std::size_t count, std::vector<bool>& out,
                  const Of& of) {
  std::vector<Sums> sums(count);
  for (std::size_t p = 0; p < facets.persons.size(); ++p)
    for (std::size_t c = 0; c < facets.cells() && !person_out[p]; ++c)
      sums[of(c)].add(facets.scores[p][c], facets.most);
  bool changed = false;
  for (std::size_t k = 0; k < count; ++k) {
    if (out[k] || !sums[k].extreme()) continue;
    out[k] = changed = true;
    for (auto& own : facets.scores)
      for (std::size_t c = 0; c < facets.cells(); ++c)
        if (of(c) == k) own[c] = -1;
  }
  return changed;
}

}  // namespace

Facets facets_of(const DataTable& table) {
  CHECK(!table.values.empty());
  Facets facets;
  const std::vector<Scored> scored = all_scored(table, facets);
  if (facets.reason != nullptr) return facets;
  facets.scores.assign(facets.persons.size(), std::vector<int>(facets.cells(), -1));
  for (const Scored& one : scored) {
    int& cell = facets.scores[one.person][one.item * std::max<std::size_t>(1, facets.raters.size()) + one.rater];
    if (cell >= 0) {
      facets.reason = "repeated_subject";
      facets.why = "A person has two scores for the same item (and rater).";
      return facets;
    }
    cell = one.score;
    facets.most = std::max(facets.most, one.score);
  }
  return facets;
}

Extremes without_extremes(Facets& facets) {
  Extremes extremes;
  extremes.person.assign(facets.persons.size(), false);
  std::vector<bool> item_out(facets.items.size()), rater_out(facets.raters.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t p = 0; p < facets.persons.size(); ++p) {
      if (extremes.person[p]) continue;
      Sums sums;
      for (const int score : facets.scores[p]) sums.add(score, facets.most);
      if (sums.any() && !sums.extreme()) continue;
      extremes.person[p] = changed = true;
    }
    changed = drop_extreme(facets, extremes.person, facets.items.size(), item_out,
                           [&](std::size_t c) { return facets.item_of(c); }) ||
              changed;
    if (facets.raters.size() > 1)
      changed = drop_extreme(facets, extremes.person, facets.raters.size(), rater_out,
                             [&](std::size_t c) { return facets.rater_of(c); }) ||
                changed;
  }
  for (std::size_t i = 0; i < item_out.size(); ++i)
    if (item_out[i]) extremes.items.push_back(facets.items[i]);
  for (std::size_t r = 0; r < rater_out.size(); ++r)
    if (rater_out[r]) extremes.raters.push_back(facets.raters[r]);
  return extremes;
}

}  // namespace seldinger::assessment::statistics
