#include "casedb/import/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::casedb {
namespace {

// A gap may differ from the series' by 1 % or 0.05 mm (positions are often written with one or two decimals).
constexpr double kGapShare = 0.01, kGapMm = 0.05;
constexpr double kSamePlaceMm = 0.01;
// The slices' way may lean by 0.1° from their normal: 0.7 mm over 400 mm, below a pixel.
constexpr double kMostTilt = 0.00175;
constexpr double kSameDirection = 1e-4;  // cosines are often written with six decimals

std::string slice_name(std::size_t index) {
  return "slice " + std::to_string(index + 1) + " (ordered by position)";
}

bool same_orientation(const DicomSlice& a, const DicomSlice& b) {
  const glm::dvec3 row = glm::abs(a.row - b.row), column = glm::abs(a.column - b.column);
  return std::max({row.x, row.y, row.z, column.x, column.y, column.z}) <= kSameDirection;
}

void check_sameness(const std::vector<DicomSlice>& slices, Problems& problems) {
  bool orientation = false, size = false;
  for (const DicomSlice& slice : slices) {
    orientation |= !same_orientation(slice, slices.front());
    const glm::dvec2 spacing = glm::abs(slice.spacing_mm - slices.front().spacing_mm);
    size |= slice.size_px != slices.front().size_px || std::max(spacing.x, spacing.y) > 1e-4;
  }
  if (orientation) problems.add("mixed_orientation", "the slices of the series lie in different directions");
  if (size) problems.add("mixed_size", "the slices of the series differ in width, height or pixel spacing");
}

void check_gaps(const std::vector<DicomSlice>& slices, const glm::dvec3& normal, Problems& problems) {
  std::vector<double> gaps_mm;
  for (std::size_t i = 1; i < slices.size(); ++i)
    gaps_mm.push_back(glm::dot(slices[i].position_lps_mm - slices[i - 1].position_lps_mm, normal));
  bool duplicates = false;
  for (std::size_t i = 0; i < gaps_mm.size(); ++i) {
    if (!(gaps_mm[i] <= kSamePlaceMm)) continue;
    problems.add("duplicate_slices", slice_name(i + 1) + " lies at the place of the one before it");
    duplicates = true;
  }
  if (duplicates) return;
  std::vector<double> sorted = gaps_mm;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual_mm = sorted[sorted.size() / 2];
  const double tolerance_mm = std::max(kGapShare * usual_mm, kGapMm);
  for (std::size_t i = 0; i < gaps_mm.size(); ++i)
    if (!(std::abs(gaps_mm[i] - usual_mm) <= tolerance_mm))
      problems.add("uneven_slices", "the gap before " + slice_name(i + 1) + " is " +
                                        std::to_string(gaps_mm[i] / usual_mm).substr(0, 4) +
                                        " times the usual one: a slice is missing or out of place");

  const glm::dvec3 way = slices.back().position_lps_mm - slices.front().position_lps_mm;
  const double height_mm = glm::dot(way, normal);
  if (glm::length(way - height_mm * normal) > kMostTilt * height_mm + kSamePlaceMm) {
    problems.add("gantry_tilt", "the slices are shifted against each other along their plane (a tilted gantry)");
    return;
  }
  for (std::size_t i = 1; i < slices.size(); ++i) {
    const glm::dvec3 from_first = slices[i].position_lps_mm - slices.front().position_lps_mm;
    const double along = glm::dot(from_first, normal);
    if (!(glm::length(from_first - way * (along / height_mm)) <= tolerance_mm))
      problems.add("shifted_slices", slice_name(i) + " is shifted along its plane against the others");
  }
}

}  // namespace

void order_slices(std::vector<DicomSlice>& slices, Problems& problems) {
  bool sound = true;
  for (std::size_t i = 0; i < slices.size(); ++i)
    for (const base::Problem& problem : slices[i].problems) {
      problems.add(problem.code, "a slice of the series " + problem.text);
      sound = false;
    }
  if (!sound) return;
  check_sameness(slices, problems);
  if (!problems.empty()) return;
  const glm::dvec3 normal = glm::cross(slices.front().row, slices.front().column);
  std::stable_sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
    return glm::dot(a.position_lps_mm, normal) < glm::dot(b.position_lps_mm, normal);
  });
  if (slices.size() > 1) check_gaps(slices, normal, problems);
}

glm::dmat4 lps_from_voxel(const std::vector<DicomSlice>& ordered, double thickness_mm) {
  const DicomSlice& first = ordered.front();
  const glm::dvec3 step = ordered.size() > 1 ? (ordered.back().position_lps_mm - first.position_lps_mm) /
                                                   static_cast<double>(ordered.size() - 1)
                                             : glm::cross(first.row, first.column) * thickness_mm;
  return {glm::dvec4(first.row * first.spacing_mm.x, 0.0), glm::dvec4(first.column * first.spacing_mm.y, 0.0),
          glm::dvec4(step, 0.0), glm::dvec4(first.position_lps_mm, 1.0)};
}

}  // namespace seldinger::casedb
