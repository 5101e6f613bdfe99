// A metric: what it is (its row in a table, which drives help, docs and pages) and what it is for one attempt.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assessment/signals/needs.h"
#include "sim/case/case.h"

namespace seldinger::assessment {

struct Signals;

struct MetricValue {
  std::string id;
  int version = 1;
  std::optional<double> value;  // null is never 0
  std::string unit;
  std::string reason;  // stable snake_case when null; empty otherwise
};

enum class Direction { none, lower_is_better, higher_is_better };

// What it speaks of, in the order of what a trainee asks first.
enum class Group { target, safety, procedure, picture, path, time, dose, recording };

// The number, or why there is none.
struct Measured {
  std::optional<double> value;
  const char* reason = "";
  static Measured of(double value) { return {value, ""}; }
  static Measured none(const char* reason) { return {std::nullopt, reason}; }
};

// How a comparison of people takes the metric: what is estimated (ICH E9(R1), 2019). One value a person, of the
// attempts in which the procedure was performed (procedure_performed).
enum class Scale { ratio, interval, share, count, yes_no };
// What a null says of somebody who performed the procedure and neither fired nor deferred.
enum class WithoutEndpoint {
  left_out,  // nothing: the metric does not ask for an endpoint, or says nothing of success
  failure,   // the worst value there is: giving up is no better than missing
  censored,  // a time that was still running when the recording ended
};
enum class Aggregation { median, mean, proportion };  // of a person's attempts

struct Estimand {
  Scale scale = Scale::ratio;
  WithoutEndpoint without_endpoint = WithoutEndpoint::left_out;
  Aggregation aggregation = Aggregation::median;
};

// Changes of an attempt that leave the metric as it is: tests hold each of them over random attempts.
enum Law : std::uint32_t {
  kAtAnySpeed = 1U << 0U,        // the same way in half to twice the time
  kInAnyFrame = 1U << 1U,        // the case and all that was done, turned and shifted
  kMirrored = 1U << 2U,          // left for right
  kInAnyBreath = 1U << 3U,       // breath on or off, the hands at rest relative to tissue
  kIdleBefore = 1U << 4U,        // seconds in which nothing is done, before
  kIdleAfter = 1U << 5U,         // the same between the last deed and the end, where nothing was fired
  kOneDarkFrame = 1U << 6U,      // one picture that shows nothing
  kLostSamples = 1U << 7U,       // one pose in a hundred is missing
  kNothingIsNothing = 1U << 8U,  // who does nothing has no value
};

// Laws of sight, or-ed, that made another version of it: in a case of an older one it is the version of then, for
// good (version_of).
constexpr std::uint32_t since(cases::SightLaw law) noexcept {
  return 1U << static_cast<unsigned>(law);
}
constexpr std::uint32_t kAsksForHit = since(cases::SightLaw::echo);
constexpr std::uint32_t kAsksForShaft =
    since(cases::SightLaw::clutter) | since(cases::SightLaw::tilt);           // for any of the needle
constexpr std::uint32_t kAsksForProbesPicture = kAsksForHit | kAsksForShaft;  // what pictures under a probe showed
constexpr std::uint32_t kAsksForAnyPicture =
    kAsksForProbesPicture | since(cases::SightLaw::scatter) | since(cases::SightLaw::material);

struct MetricInfo {
  const char* id;
  int version;        // higher when the definition changes: stored values keep theirs
  const char* unit;   // mm, mm², s, count, share, %, deg, N; bool is 1 or 0
  const char* label;  // for pages, at most four words
  Group group;
  Direction direction;
  Needs needs;             // Need, or-ed: without one it is null, for that need's reason
  const char* definition;  // a few sentences, with the edge rules and every further reason for null
  const char* source;
  Measured (*measure)(const Signals&);  // only called when its needs are met
  Estimand estimand{};
  std::uint32_t laws = 0;    // Law, or-ed
  const char* history = "";  // what each older version did otherwise: "1: ..."
  std::uint32_t by_sight = 0;
};

}  // namespace seldinger::assessment
