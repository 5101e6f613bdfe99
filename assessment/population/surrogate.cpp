#include "assessment/population/surrogate.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "assessment/population/streams.h"
#include "assessment/registry.h"
#include "assessment/statistics/distributions.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::assessment::population {
namespace {

constexpr double kNearSd = 0.5;  // how far an attempt's leftover is used, in standard deviations of ability
constexpr std::uint64_t kMostTries = 512;
constexpr std::size_t kFewestValues =
    4 * (1 + 2 * kAxes);  // for a surface; of fewer the level is the same everywhere
constexpr std::uint64_t kTies = 0x74696573ULL;
constexpr std::size_t kTerms = 1 + 2 * kAxes;

// 1, each axis, each axis squared.
std::array<double, kTerms> terms_of(const Place& place) noexcept {
  std::array<double, kTerms> terms{1.0};
  for (std::size_t i = 0; i < kAxes; ++i) {
    terms[1 + i] = place[i];
    terms[1 + kAxes + i] = place[i] * place[i];
  }
  return terms;
}

double height(const std::vector<double>& coefficients, const Place& place) noexcept {
  const auto terms = terms_of(place);
  return std::inner_product(terms.begin(), terms.end(), coefficients.begin(), 0.0);
}

// Gauss and Jordan: of the unknowns of the first N columns, for each further column. Positive definite, so no pivot
// is sought.
template <std::size_t N, std::size_t Columns>
void solve(std::array<std::array<double, Columns>, N>& rows) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      if (k == i) continue;
      const double factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j < Columns; ++j) rows[k][j] -= factor * rows[i][j];
    }
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = N; j < Columns; ++j) rows[i][j] /= rows[i][i];
}

// Least squares by the normal equations, with a ridge so small that it only settles what the points leave open.
std::vector<double> solved(const std::vector<SimulatedPoint>& points, std::span<const std::size_t> with_value,
                           const std::vector<double>& scores) {
  std::array<std::array<double, kTerms + 1>, kTerms> rows{};
  for (const std::size_t p : with_value) {
    const auto terms = terms_of(points[p].place);
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) rows[i][j] += terms[i] * terms[j];
      rows[i][kTerms] += terms[i] * scores[p];
    }
  }
  for (std::size_t i = 0; i < kTerms; ++i) rows[i][i] += 1e-6 * static_cast<double>(with_value.size());
  solve(rows);
  std::vector<double> solution(kTerms);
  for (std::size_t i = 0; i < kTerms; ++i) solution[i] = rows[i][kTerms];
  return solution;
}

// The value that lies a share up the sorted ones. Between two that stand alone others are possible; next to a value
// that many have, as 0 is, they are not.
double at_share(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size());
  const auto last = static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, last));
  if (low + 2 >= sorted.size() || low == 0) return sorted[low];
  const double a = sorted[low], b = sorted[low + 1];
  if (sorted[low - 1] == a || sorted[low + 2] == b) return a;
  return a + (b - a) * std::clamp(place - static_cast<double>(low), 0.0, 1.0);
}

}  // namespace

Place place_of(const Person& person, const Occasion& occasion) {
  Place place{};
  const Abilities ability = ability_on(person, occasion);
  std::copy(ability.begin(), ability.end(), place.begin());
  place[kAbilities] = person.strategy;
  return place;
}

SurrogateMark mark_of_today(std::uint32_t step_version, std::string case_id, std::string case_title,
                            std::string case_mark, cases::SightLaw law) {
  SurrogateMark mark;
  mark.step_version = step_version;
  mark.case_id = std::move(case_id);
  mark.case_title = std::move(case_title);
  mark.case_mark = std::move(case_mark);
  for (const MetricInfo& info : registry()) mark.metrics.push_back({std::string(info.id), version_of(info, law)});
  return mark;
}

std::string difference(const SurrogateMark& one, const SurrogateMark& other) {
  if (one.people_version != other.people_version) return "another model of people";
  if (one.operator_version != other.operator_version) return "other operators";
  if (one.step_version != other.step_version) return "another version of the simulation's step";
  if (one.case_id != other.case_id || one.case_title != other.case_title || one.case_mark != other.case_mark)
    return "another case, or the case has changed since";
  for (const SurrogateMark::Metric& metric : one.metrics)
    if (std::find(other.metrics.begin(), other.metrics.end(), metric) == other.metrics.end())
      return "another version of the metric " + metric.id;
  return one.metrics == other.metrics ? "" : "other metrics";
}

bool is_whole(const std::string& metric) {
  const MetricInfo* info = find_metric(metric);
  return info == nullptr || info->estimand.scale == Scale::count || info->estimand.scale == Scale::yes_no;
}

void drop_rounding(Values& values) noexcept {
  constexpr int kDigits = 9;
  std::array<char, 32> text;
  for (std::optional<double>& value : values) {
    if (!value || !std::isfinite(*value)) continue;
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), *value, std::chars_format::general, kDigits);
    std::from_chars(text.data(), end.ptr, *value);
  }
}

std::vector<double> values_of(std::span<const Values> rows, std::size_t metric) {
  std::vector<double> values;
  for (const Values& row : rows)
    if (row[metric]) values.push_back(*row[metric]);
  return values;
}

bool add_once(const std::vector<SimulatedPoint>& more, std::vector<SimulatedPoint>& points) {
  std::map<Place, std::size_t> known;  // of one place is the same person on the same occasion
  for (std::size_t p = 0; p < points.size(); ++p) known.emplace(points[p].place, p);
  for (const SimulatedPoint& one : more) {
    const auto [at, is_new] = known.emplace(one.place, points.size());
    if (is_new)
      points.push_back(one);
    else if (points[at->second].values != one.values)
      return false;
  }
  return true;
}

base::Result<Surrogate> Surrogate::fit(SurrogateMark mark, std::vector<SimulatedPoint> points) {
  if (points.size() < kFewest || points.size() > kMost)
    return base::Error{"bad_surrogate", "a surrogate is fitted to " + std::to_string(kFewest) + " to " +
                                            std::to_string(kMost) + " attempts"};
  for (const SimulatedPoint& one : points) CHECK(one.values.size() == mark.metrics.size());
  Surrogate made;
  made.mark_ = std::move(mark);
  made.points_ = std::move(points);
  for (SimulatedPoint& one : made.points_) drop_rounding(one.values);
  made.fit_places();
  made.fit_surfaces();
  return made;
}

// Of where attempts are: the mean, and the inverse of the covariance.
void Surrogate::fit_places() {
  const auto n = static_cast<double>(points_.size());
  for (const SimulatedPoint& one : points_)
    for (std::size_t a = 0; a < kAxes; ++a) mean_[a] += one.place[a] / n;
  std::array<std::array<double, 2 * kAxes>, kAxes> rows{};
  for (const SimulatedPoint& one : points_)
    for (std::size_t a = 0; a < kAxes; ++a)
      for (std::size_t b = 0; b < kAxes; ++b)
        rows[a][b] += (one.place[a] - mean_[a]) * (one.place[b] - mean_[b]) / n;
  for (std::size_t a = 0; a < kAxes; ++a) {
    rows[a][a] += 1e-6;
    rows[a][kAxes + a] = 1.0;
  }
  solve(rows);
  for (std::size_t a = 0; a < kAxes; ++a)
    for (std::size_t b = 0; b < kAxes; ++b) inverse_covariance_[a][b] = rows[a][kAxes + b];
}

// About this attempts are looked for, so that the mean of those that are found is the place that was asked for: of
// normal ones with a covariance Σ about μ a kernel of h² about c finds such about x where c = x + h² Σ⁻¹ (x − μ).
Place Surrogate::centre_for(const Place& place) const noexcept {
  Place centre = place;
  for (std::size_t a = 0; a < kAxes; ++a)
    for (std::size_t b = 0; b < kAxes; ++b)
      centre[a] += kNearSd * kNearSd * inverse_covariance_[a][b] * (place[b] - mean_[b]);
  return centre;
}

void Surrogate::fit_surfaces() {
  for (std::size_t m = 0; m < mark_.metrics.size(); ++m) {
    Surface& surface = surfaces_.emplace_back();
    if (is_whole(mark_.metrics[m].id)) continue;
    surface.scores.resize(points_.size());
    surface.coefficients.resize(kTerms);
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (points_[p].values[m]) order.push_back(p);
    // Equal values in an order of chance: each gets a place of its own among those that they take together.
    const std::uint64_t ties = base::hash_combine(kTies, m);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const double x = *points_[a].values[m], y = *points_[b].values[m];
      if (x != y) return x < y;
      return base::hash_combine(ties, std::uint64_t{a}) < base::hash_combine(ties, std::uint64_t{b});
    });
    const auto n = static_cast<double>(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      surface.sorted.push_back(*points_[order[rank]].values[m]);
      surface.scores[order[rank]] = statistics::normal_quantile_of((static_cast<double>(rank) + 0.5) / n);
    }
    if (order.size() >= kFewestValues) surface.coefficients = solved(points_, order, surface.scores);
  }
}

std::size_t Surrogate::index_of(const std::string& metric) const {
  for (std::size_t m = 0; m < mark_.metrics.size(); ++m)
    if (mark_.metrics[m].id == metric) return m;
  return std::string::npos;
}

// One of the attempts, the likelier the nearer: by trying until one is taken.
std::size_t Surrogate::near(const Place& centre, std::uint64_t stream) const {
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::uint64_t i = 0; i < kMostTries; ++i) {
    const auto tried =
        static_cast<std::size_t>(base::uniform_at(stream, 2 * i) * static_cast<double>(points_.size()));
    double squared = 0.0;
    for (std::size_t a = 0; a < kAxes; ++a) {
      const double off = points_[tried].place[a] - centre[a];
      squared += off * off;
    }
    if (squared < least) {
      least = squared;
      nearest = tried;
    }
    const double away = 0.5 * squared / (kNearSd * kNearSd), drawn = base::uniform_at(stream, 2 * i + 1);
    // exp(−x) ≤ 1/(1 + x) spares most of the exponentials.
    if (drawn * (1.0 + away) <= 1.0 && drawn < base::exact_exp(-away)) return tried;
  }
  return nearest;
}

Values Surrogate::moved(std::size_t from, const Place& to) const {
  Values values;
  values.reserve(surfaces_.size());
  for (std::size_t m = 0; m < surfaces_.size(); ++m) {
    const Surface& surface = surfaces_[m];
    // Counts, yes and no are what the attempt is of, and stay: moved one by one they would no longer belong to it.
    if (!points_[from].values[m] || surface.sorted.empty()) {
      values.push_back(points_[from].values[m]);
      continue;
    }
    const double score =
        surface.scores[from] + height(surface.coefficients, to) - height(surface.coefficients, points_[from].place);
    values.emplace_back(at_share(surface.sorted, statistics::normal_cdf(score)));
  }
  return values;
}

Values Surrogate::draw(const Place& place, std::uint64_t stream) const {
  return moved(near(centre_for(place), stream), place);
}

Values Surrogate::draw(const Person& person, const Occasion& occasion) const {
  const std::uint64_t own = stream_of(person.key, Drawn::surrogate, occasion.case_key);
  const std::uint64_t then = stream_of(person.key, Drawn::surrogate, occasion.case_key, occasion.attempt + 1);
  const bool is_own = base::uniform_at(then, 1ULL << 32U) < kOwnShare;
  return draw(place_of(person, occasion), is_own ? own : then);
}

}  // namespace seldinger::assessment::population
