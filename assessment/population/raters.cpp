#include "assessment/population/raters.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "assessment/population/streams.h"
#include "assessment/statistics/distributions.h"
#include "sim/base/ascii.h"
#include "sim/base/check.h"
#include "sim/base/hash.h"

namespace seldinger::assessment::population {
namespace {

constexpr RatedItem kItems[] = {
    {"respect for tissue", {0.6, 0.2, 0.2, 0.0}},    {"time and motion", {0.5, 0.2, 0.3, 0.0}},
    {"instrument handling", {0.8, 0.2, 0.0, 0.0}},   {"use of imaging", {0.2, 0.7, 0.1, 0.0}},
    {"flow of the procedure", {0.0, 0.1, 0.7, 0.2}}, {"safety and communication", {0.0, 0.0, 0.2, 0.8}}};

constexpr Statement kStatements[] = {
    {"US visual elements were of high quality", 3.56, 0.53, 3.80, 0.45},
    {"Tactile (touch) elements were accurate", 2.44, 0.88, 3.00, 1.41},
    {"Needle insertion through skin is realistic", 2.44, 0.53, 3.00, 1.41},
    {"Needle insertion through tissues is realistic", 2.67, 0.87, 3.25, 1.5},
    {"The level of difficulty of the cases was appropriate", 3.33, 0.87, 4.00, 1.41},
    {"The simulator reflected a high level of realism", 2.44, 0.73, 3.67, 0.58},
};
constexpr double kExpertYears = 7.0;
constexpr double kLiking = 0.4;  // the correlation of two answers of a person, before rounding

constexpr double kPoints = 5.0;

int point_of(double value) {
  return static_cast<int>(std::lround(std::clamp(value, 1.0, kPoints)));
}

// A point of five among as many as a form has.
std::size_t place_of(int point, std::size_t points) {
  return static_cast<std::size_t>(std::lround((point - 1) / (kPoints - 1.0) * static_cast<double>(points - 1)));
}

bool begins_with(std::string_view words, std::string_view name) {
  return words.size() >= name.size() && base::lower(words.substr(0, name.size())) == base::lower(name);
}

std::uint64_t key_of(std::string_view words) {
  return base::hash_bytes(std::as_bytes(std::span(words)));
}

int rating_by(const Rater& rater, const Person& person, const Abilities& ability, const Abilities& weight,
              std::uint64_t item, std::uint64_t order) {
  double whole = 0.0, part = 0.0;
  for (std::size_t a = 0; a < kAbilities; ++a) {
    whole += ability[a] / static_cast<double>(kAbilities);
    part += weight[a] * ability[a];
  }
  const double seen = rater.halo * whole + (1.0 - rater.halo) * part;
  const double severity = rater.severity + rater.drift * static_cast<double>(order) / 100.0;
  const double error =
      rater.error_sd * normal_of(base::hash_combine(stream_of(person.key, Drawn::rating, rater.key, item), order));
  return point_of(2.6 + 0.6 * seen - severity + error);
}

}  // namespace

Rater drawn_rater(std::uint64_t seed, std::uint64_t number) {
  Rater rater;
  rater.key = person_key(seed, "rater", number);
  const auto drawn = [&](std::uint64_t what) { return stream_of(rater.key, Drawn::rater, what); };
  rater.severity = 0.4 * normal_of(drawn(0));
  rater.halo = 0.2 + 0.4 * uniform_of(drawn(1));
  rater.drift = 0.25 * normal_of(drawn(2));
  return rater;
}

std::span<const RatedItem> rated_items() {
  return kItems;
}

int rating_of(const Rater& rater, const Person& person, const Abilities& ability, std::size_t item,
              std::uint64_t order) {
  CHECK(item < std::size(kItems));
  return rating_by(rater, person, ability, kItems[item].weight, item, order);
}

std::size_t rated_point(const Rater& rater, const Person& person, const Abilities& ability, std::string_view words,
                        std::uint64_t order, std::size_t points) {
  Abilities weight;
  weight.fill(1.0 / static_cast<double>(kAbilities));
  for (const RatedItem& one : kItems)
    if (begins_with(words, one.name)) weight = one.weight;
  return place_of(rating_by(rater, person, ability, weight, key_of(words), order), points);
}

std::span<const Statement> statements() {
  return kStatements;
}

int answer_of(const Person& person, std::size_t statement) {
  CHECK(statement < std::size(kStatements));
  const Statement& asked = kStatements[statement];
  const bool expert = person.years >= kExpertYears;
  const double liking = normal_of(stream_of(person.key, Drawn::answer, 0));
  const double own = normal_of(stream_of(person.key, Drawn::answer, 1 + statement));
  const double z = std::sqrt(kLiking) * liking + std::sqrt(1.0 - kLiking) * own;
  return point_of((expert ? asked.expert_mean : asked.trainee_mean) +
                  (expert ? asked.expert_sd : asked.trainee_sd) * z);
}

std::size_t answered_point(const Person& person, std::string_view words, std::size_t points) {
  for (std::size_t s = 0; s < std::size(kStatements); ++s)
    if (kStatements[s].words == words) return place_of(answer_of(person, s), points);
  const double liking = normal_of(stream_of(person.key, Drawn::answer, 0));
  const double own = normal_of(stream_of(person.key, Drawn::answer, key_of(words)));
  const double share = statistics::normal_cdf(std::sqrt(kLiking) * liking + std::sqrt(1.0 - kLiking) * own);
  return std::min(static_cast<std::size_t>(share * static_cast<double>(points)), points - 1);
}

}  // namespace seldinger::assessment::population
