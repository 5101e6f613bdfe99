// A metric: what it is (the registry's row, which drives help, docs and pages) and what it is for one attempt.
#pragma once

#include <optional>
#include <string>

namespace seldinger::assessment {

struct Signals;

struct MetricValue {
  std::string id;
  int version = 1;
  std::optional<double> value;  // null is never 0
  std::string unit;
  std::string reason;  // stable snake_case when null; empty otherwise
};

// Whether it could have a value under the attempt's modality. Answers of one that cannot are not shown to people.
inline bool applies(const MetricValue& metric) {
  return metric.value.has_value() || (metric.reason != "not_xray" && metric.reason != "not_ultrasound");
}

enum class Direction { none, lower_is_better, higher_is_better };

// The number, or why there is none.
struct Measured {
  std::optional<double> value;
  const char* reason = "";
  static Measured of(double value) { return {value, ""}; }
  static Measured none(const char* reason) { return {std::nullopt, reason}; }
};

struct MetricInfo {
  const char* id;
  int version;
  const char* unit;   // mm, s, count, share, %; hit is 1 or 0
  const char* label;  // for pages, at most four words
  Direction direction;
  const char* definition;  // one or two sentences, with the edge rules and every reason for null
  const char* source;
  Measured (*measure)(const Signals&);
};

}  // namespace seldinger::assessment
