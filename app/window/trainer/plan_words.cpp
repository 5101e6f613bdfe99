#include "app/window/trainer/plan_words.h"

#include <cmath>

namespace seldinger::app {
namespace {

std::string whole(double value, const char* unit) {
  return std::to_string(std::lround(value)) + unit;
}

}  // namespace

std::string way_words(const session::PlannedWay& way) {
  std::string words = whole(way.length_mm, " mm from the skin, ");
  words += std::lround(way.skin_angle_deg) == 0 ? "straight in" : whole(way.skin_angle_deg, "° off perpendicular");
  if (std::lround(way.head_deg) != 0)
    words += ", " + whole(std::abs(way.head_deg), "° towards the ") + (way.head_deg > 0.0 ? "head" : "feet");
  return words;
}

std::vector<std::string> warnings_of(const session::PlannedWay& way) {
  std::vector<std::string> warnings;
  if (way.too_long) warnings.push_back("longer than the needle");
  for (const session::WayPart& part : way.parts)
    if (part.forbidden)
      warnings.push_back("through " + part.what + ", " + whole(part.length_mm, " mm of it, ") +
                         whole(part.from_mm, " mm below the skin"));
  for (const std::string& one : way.not_crossed) warnings.push_back("misses " + one + ", which must be crossed");
  return warnings;
}

std::vector<std::string> compared_words(const assessment::PlannedPath& planned,
                                        const assessment::PlannedPath* done) {
  if (done == nullptr) return {"The needle never went in: nothing of the plan was done."};
  const assessment::PlanComparison told = assessment::compare(planned, *done);
  return {"Entry: " + whole(told.entry_mm, " mm from where you planned it"),
          "Direction: " + whole(told.angle_deg, "° off your line"),
          "Depth: " + whole(told.depth_mm, " mm; planned ") + whole(told.planned_depth_mm, " mm"),
          "Tip: " + whole(told.tip_mm, " mm from where you planned it")};
}

}  // namespace seldinger::app
