// What a simulated person's attempt at a case would measure, drawn in microseconds instead of simulated in seconds:
// one of the attempts that were simulated whole, of about those abilities and strategy, so that metrics hang
// together, and are null together, as they did; what is measured, not counted, is moved by a response surface over
// the rest of the way. It is of one case, one model of people and one version of each metric, and refused for any
// other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/metrics/metric.h"
#include "assessment/operators/profile.h"
#include "assessment/population/person.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::assessment::population {

constexpr std::size_t kAxes = kAbilities + 1;
using Place = std::array<double, kAxes>;  // abilities on the occasion, then strategy
Place place_of(const Person& person, const Occasion& occasion);

// Of what a surrogate is. Two of different marks are different things.
struct SurrogateMark {
  int people_version = kPeopleVersion, operator_version = kOperatorVersion;
  std::uint32_t step_version = 0;
  std::string case_id, case_title, case_mark;  // the mark is of the case's content
  struct Metric {
    std::string id;
    int version = 1;
    bool operator==(const Metric&) const = default;
  };
  std::vector<Metric> metrics;  // of the registry, in its order
  bool operator==(const SurrogateMark&) const = default;
};
// Of the metrics of today, at a case of that law of sight.
SurrogateMark mark_of_today(std::uint32_t step_version, std::string case_id, std::string case_title,
                            std::string case_mark, cases::SightLaw law = cases::kNewestSightLaw);
// What differs, in words; empty: nothing.
std::string difference(const SurrogateMark& one, const SurrogateMark& other);

// A metric whose values are whole numbers: a count, or yes and no.
bool is_whole(const std::string& metric);

using Values = std::vector<std::optional<double>>;  // in the mark's order; nothing: the metric has none

// To nine digits, finer than anything measured: what lies below is rounding (100 Hz are 99.9999999998 where times
// are sums of ticks), and is no spread. Twice is as good as once.
void drop_rounding(Values& values) noexcept;

// Of one metric, of those that have one.
std::vector<double> values_of(std::span<const Values> rows, std::size_t metric);

struct SimulatedPoint {
  Place place{};
  Values values;
};

// Adds those that are not there yet; false: one is, and measured otherwise, so that the two are of different laws.
bool add_once(const std::vector<SimulatedPoint>& more, std::vector<SimulatedPoint>& points);

class Surrogate {
 public:
  // `too_few`: less than kFewest attempts.
  static constexpr std::size_t kFewest = 60, kMost = 20'000;
  static base::Result<Surrogate> fit(SurrogateMark mark, std::vector<SimulatedPoint> points);

  const SurrogateMark& mark() const noexcept { return mark_; }
  const std::vector<SimulatedPoint>& attempts() const noexcept { return points_; }
  std::size_t index_of(const std::string& metric) const;  // npos: there is no such one
  // Of an attempt at that place. The same stream, the same draw.
  Values draw(const Place& place, std::uint64_t stream) const;
  // Of a person's attempt: what is left over is with a share of kOwnShare that of the person at this case, so that
  // attempts of one person are alike.
  static constexpr double kOwnShare = 0.4;
  Values draw(const Person& person, const Occasion& occasion) const;

  std::string to_json() const;
  static base::Result<Surrogate> from_json(const std::string& text);  // `bad_surrogate`

 private:
  Surrogate() = default;
  void fit_places();
  void fit_surfaces();
  Place centre_for(const Place& place) const noexcept;
  std::size_t near(const Place& centre, std::uint64_t stream) const;
  Values moved(std::size_t from, const Place& to) const;

  struct Surface {  // empty for counts, yes and no
    std::vector<double> coefficients;
    std::vector<double> scores;  // of each point: the normal score of its value; 0: it has none
    std::vector<double> sorted;  // the values
  };
  SurrogateMark mark_;
  std::vector<SimulatedPoint> points_;
  Place mean_{};
  std::array<Place, kAxes> inverse_covariance_{};
  std::vector<Surface> surfaces_;
};

}  // namespace seldinger::assessment::population
