// What was answered since the server began, for whoever watches over it: counts by route and status, and how long
// answers took to make. Nothing of anybody: no id, no name, no query.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace seldinger::web {

class Tally {
 public:
  // Upper ends of the histogram's classes, in seconds; above the last there is one more.
  static constexpr std::array<double, 10> kEnds_s = {0.005, 0.01, 0.025, 0.05, 0.1, 0.2, 0.5, 1.0, 5.0, 30.0};

  // `pattern` of the route, which outlives this; empty: there is none such.
  void add(std::string_view pattern, int status, std::int64_t took_us);
  // In Prometheus' text format, version 0.0.4 (prometheus.io/docs/instrumenting/exposition_formats).
  std::string text() const;

 private:
  struct Took {
    std::array<std::uint64_t, kEnds_s.size() + 1> in_class{};
    double sum_s = 0.0;
  };
  mutable std::mutex mutex_;
  std::map<std::pair<std::string_view, int>, std::uint64_t> answers_;
  std::map<std::string_view, Took> took_;
};

}  // namespace seldinger::web
