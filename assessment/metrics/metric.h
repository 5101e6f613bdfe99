// A metric: what it is (its row in a table, which drives help, docs and pages) and what it is for one attempt.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assessment/signals/needs.h"

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

struct MetricInfo {
  const char* id;
  int version;        // higher when the definition changes: stored values keep theirs
  const char* unit;   // mm, mm², s, count, share, %, deg, N; bool is 1 or 0
  const char* label;  // for pages, at most four words
  Group group;
  Direction direction;
  std::uint32_t needs;     // Need, or-ed: without one it is null, for that need's reason
  const char* definition;  // a few sentences, with the edge rules and every further reason for null
  const char* source;
  Measured (*measure)(const Signals&);  // only called when its needs are met
};

}  // namespace seldinger::assessment
