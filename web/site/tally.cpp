#include "web/site/tally.h"

#include <algorithm>
#include <cstdio>

namespace seldinger::web {
namespace {

std::string route_label(std::string_view pattern) {
  return "route=\"" + std::string(pattern.empty() ? "none" : pattern) + "\"";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

void Tally::add(std::string_view pattern, int status, std::int64_t took_us) {
  const double took_s = static_cast<double>(took_us) * 1e-6;
  const auto end = std::lower_bound(kEnds_s.begin(), kEnds_s.end(), took_s);
  const std::lock_guard lock(mutex_);
  ++answers_[{pattern, status}];
  Took& took = took_[pattern];
  ++took.in_class[static_cast<std::size_t>(end - kEnds_s.begin())];
  took.sum_s += took_s;
}

std::string Tally::text() const {
  const std::lock_guard lock(mutex_);
  std::string text =
      "# HELP seldinger_answers_total Answers, by route and status.\n# TYPE seldinger_answers_total counter\n";
  for (const auto& [key, count] : answers_)
    text += "seldinger_answers_total{" + route_label(key.first) + ",status=\"" + std::to_string(key.second) +
            "\"} " + std::to_string(count) + "\n";
  text +=
      "# HELP seldinger_answer_seconds How long answers took to make, without their wait for a thread.\n"
      "# TYPE seldinger_answer_seconds histogram\n";
  for (const auto& [pattern, took] : took_) {
    const std::string label = route_label(pattern);
    std::uint64_t up_to = 0;
    for (std::size_t i = 0; i < took.in_class.size(); ++i) {
      up_to += took.in_class[i];
      text += "seldinger_answer_seconds_bucket{" + label + ",le=\"" +
              (i < kEnds_s.size() ? number(kEnds_s[i]) : "+Inf") + "\"} " + std::to_string(up_to) + "\n";
    }
    text += "seldinger_answer_seconds_sum{" + label + "} " + number(took.sum_s) + "\n";
    text += "seldinger_answer_seconds_count{" + label + "} " + std::to_string(up_to) + "\n";
  }
  return text;
}

}  // namespace seldinger::web
