#include "assessment/grading/worthwhile.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "assessment/registry.h"
#include "sim/base/check.h"

namespace seldinger::assessment {
namespace {

constexpr std::string_view kJudgement = "judgement";
constexpr std::string_view kStep = "the least by which it can differ";
constexpr std::string_view kContact = "a contact is a way of more than 0.5 mm: `nogo_contacts` in docs/metrics.md";

constexpr Worthwhile kRows[] = {
    // Of single metrics.
    {"nogo_length", 0.5, kContact},
    {"nogo_length_critical", 0.5, kContact},
    {"nogo_length_major", 0.5, kContact},
    {"nogo_length_advisory", 0.5, kContact},
    {"clearance_min", 1.0, kJudgement},
    // Of units.
    {"mm", 2.0, kJudgement},
    {"mm²", 100.0, kJudgement},
    {"s", 5.0, kJudgement},
    {"share", 0.1, kJudgement},
    {"%", 10.0, kJudgement},
    {"deg", 5.0, kJudgement},
    {"N", 1.0, kJudgement},
    {"count", 1.0, kStep},
    {"bool", 1.0, kStep},
    {"1", 1.0, kJudgement},
    {"1/s", 1.0, kJudgement},
    {"Hz", 10.0, kJudgement},
    {"mGy", 1.0, kJudgement},
    {"Gy·cm²", 0.1, kJudgement},
};

const Worthwhile* row_of(std::string_view what) {
  const auto found =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const Worthwhile& one) { return one.what == what; });
  return found == std::end(kRows) ? nullptr : &*found;
}

}  // namespace

std::span<const Worthwhile> worthwhile_differences() {
  return kRows;
}

const Worthwhile& worthwhile(const MetricInfo& metric) {
  const Worthwhile* own = row_of(metric.id);
  const Worthwhile* found = own != nullptr ? own : row_of(metric.unit);
  CHECK(found != nullptr);
  return *found;
}

std::string worthwhile_markdown() {
  std::string text =
      "# Smallest worthwhile differences\n\nMade by `seldinger help --differences > docs/differences.md`; a test "
      "compares. A smaller difference is not worth\nmentioning to a trainee. In a score no standard deviation "
      "counts as smaller, so that departing from what all consultants\ndo alike still costs; in a debrief no band "
      "counts as narrower. To use a better number that has a source, "
      "change\n`assessment/grading/worthwhile.cpp`.\n\n| metric | difference | unit | source "
      "|\n|---|---|---|---|\n";
  for (const MetricInfo& info : registry()) {
    if (info.group == Group::recording || info.direction == Direction::none) continue;
    const Worthwhile& row = worthwhile(info);
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%g", row.difference);
    text += "| `" + std::string(info.id) + "` | " + number.data() + " | " + info.unit + " | " +
            std::string(row.source) + " |\n";
  }
  return text;
}

}  // namespace seldinger::assessment
