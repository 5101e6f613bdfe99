#include "casedb/import/dicom/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "casedb/import/files/number_text.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

constexpr double kEvenShare = 0.01, kEvenMm = 0.05;
constexpr double kWidestHoleMm = 10.0, kMissingFrom = 1.5;  // in usual gaps
// A lean of 0.1° is none: 0.7 mm over 400 mm, below a pixel.
constexpr double kLeastTilt = 0.00175, kMostTilt = 0.57735027;  // tangents
constexpr double kMostJitter = 0.5;                             // of the usual gap
constexpr double kSameDirection = 1e-4;                         // cosines are often written with six decimals
constexpr double kAcross = 0.70710678;                          // cosine of 45°
constexpr double kSamePx = 1e-3;

bool same_orientation(const DicomSlice& a, const DicomSlice& b) {
  const glm::dvec3 row = glm::abs(a.row - b.row), column = glm::abs(a.column - b.column);
  return std::max({row.x, row.y, row.z, column.x, column.y, column.z}) <= kSameDirection;
}

glm::dvec3 normal_of(const DicomSlice& slice) {
  return glm::cross(slice.row, slice.column);
}

// The most frequent orientation by the index of a slice that has it.
std::size_t usual_orientation(const std::vector<DicomSlice>& slices) {
  std::map<std::size_t, std::size_t> count;  // by the first slice of each orientation
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const auto known = std::find_if(count.begin(), count.end(),
                                    [&](auto& c) { return same_orientation(slices[c.first], slices[i]); });
    ++(known == count.end() ? count[i] : known->second);
  }
  return std::max_element(count.begin(), count.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
}

void keep_one_orientation(std::vector<DicomSlice>& slices, Problems& problems,
                          std::vector<base::Problem>& warnings) {
  const DicomSlice usual = slices[usual_orientation(slices)];
  std::size_t others = 0;
  double nearest = 0.0;
  for (const DicomSlice& slice : slices) {
    if (same_orientation(slice, usual)) continue;
    ++others;
    nearest = std::max(nearest, std::abs(glm::dot(normal_of(slice), normal_of(usual))));
  }
  if (others == 0) return;
  const std::string count = std::to_string(others) + " of " + std::to_string(slices.size());
  if (nearest > kAcross || others * 4 > slices.size()) {
    problems.add("mixed_orientation", "the slices of the series lie in different directions (" + count +
                                          " not as the most), the nearest at " +
                                          number_text(degrees_of(std::acos(std::min(nearest, 1.0)))) + " degrees");
    return;
  }
  std::erase_if(slices, [&](const DicomSlice& slice) { return !same_orientation(slice, usual); });
  warnings.push_back({"mixed_orientation", count +
                                               " pictures of the series lie across the others, as localizers and "
                                               "reformats do, and were left out"});
}

void check_size(const std::vector<DicomSlice>& slices, Problems& problems) {
  std::size_t others = 0;
  for (const DicomSlice& slice : slices) {
    const glm::dvec2 spacing = glm::abs(slice.spacing_mm - slices.front().spacing_mm);
    if (slice.size_px != slices.front().size_px || std::max(spacing.x, spacing.y) > 1e-4) ++others;
  }
  if (others > 0)
    problems.add("mixed_size", "the slices of the series differ in width, height or pixel spacing (" +
                                   std::to_string(others) + " of " + std::to_string(slices.size()) +
                                   " from the first)");
}

double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

// Where ordered slices lie, from the first: along the normal, and along row and column.
struct Places {
  std::vector<double> height_mm, gap_mm;
  std::vector<glm::dvec2> across_mm;
  double usual_gap_mm = 0.0, tolerance_mm = 0.0;
  double extent_mm() const { return height_mm.back(); }
};

Places places_of(const std::vector<DicomSlice>& ordered) {
  const DicomSlice& first = ordered.front();
  Places places;
  for (const DicomSlice& slice : ordered) {
    const glm::dvec3 way = slice.position_lps_mm - first.position_lps_mm;
    places.height_mm.push_back(glm::dot(way, normal_of(first)));
    places.across_mm.emplace_back(glm::dot(way, first.row), glm::dot(way, first.column));
  }
  for (std::size_t i = 1; i < ordered.size(); ++i)
    places.gap_mm.push_back(places.height_mm[i] - places.height_mm[i - 1]);
  places.usual_gap_mm = lower_median(places.gap_mm);
  places.tolerance_mm = std::max(kEvenShare * places.usual_gap_mm, kEvenMm);
  return places;
}

// Whether the heights are those of a regular stack; otherwise a warning or a problem says how they are not.
bool heights_are_even(const Places& places, Problems& problems, std::vector<base::Problem>& warnings) {
  const std::size_t count = places.height_mm.size();
  const double step_mm = places.extent_mm() / static_cast<double>(count - 1), usual_mm = places.usual_gap_mm;
  bool even = true;
  for (std::size_t i = 0; i < count; ++i)
    even = even && std::abs(places.height_mm[i] - step_mm * static_cast<double>(i)) <= places.tolerance_mm;
  if (even) return true;
  const auto [least, most] = std::minmax_element(places.gap_mm.begin(), places.gap_mm.end());
  double missing = 0.0;
  for (const double gap_mm : places.gap_mm) {
    if (gap_mm > kMissingFrom * usual_mm) missing += std::round(gap_mm / usual_mm) - 1.0;
  }
  const std::string spread = "the slices lie " + number_text(*least) + " to " + number_text(*most) +
                             " mm apart, usually " + number_text(usual_mm) + " mm; " + number_text(missing) +
                             (missing == 1.0 ? " seems" : " seem") + " to be missing";
  const auto widest = static_cast<std::size_t>(most - places.gap_mm.begin());
  const std::string where =
      ", the widest gap before slice " + std::to_string(widest + 2) + " of " + std::to_string(count);
  if (*most > kMissingFrom * usual_mm && *most > kWidestHoleMm + places.tolerance_mm) {
    problems.add("uneven_slices", spread + where + ": more than 10 mm are not filled in");
  } else if (std::round(places.extent_mm() / usual_mm) + 1.0 > 2.0 * static_cast<double>(count)) {
    problems.add("uneven_slices", spread + where + ": more would be invented than there is");
  } else {
    warnings.push_back({"uneven_slices", spread + where + ": interpolated to even layers"});
  }
  return false;
}

// Whether each slice lies straight above the first; otherwise a warning or a problem says how it does not.
bool stands_upright(const Places& places, Problems& problems, std::vector<base::Problem>& warnings) {
  const std::size_t count = places.height_mm.size();
  // The median over pairs half a stack apart: neither one slice out of place nor jitter leans the others.
  std::vector<double> lean_x, lean_y;
  for (std::size_t i = count / 2; i < count; ++i) {
    const std::size_t j = i - count / 2;
    const glm::dvec2 one =
        (places.across_mm[i] - places.across_mm[j]) / (places.height_mm[i] - places.height_mm[j]);
    lean_x.push_back(one.x);
    lean_y.push_back(one.y);
  }
  const glm::dvec2 lean(median(lean_x), median(lean_y)), overall = places.across_mm.back() / places.extent_mm();
  const double tilt = glm::length(lean);
  double off_mm = 0.0, jump_mm = 0.0;
  std::size_t jumper = 1;
  for (std::size_t i = 1; i < count; ++i) {
    off_mm = std::max(off_mm, glm::length(places.across_mm[i] - overall * places.height_mm[i]));
    const double jump = glm::length(places.across_mm[i] - places.across_mm[i - 1] - lean * places.gap_mm[i - 1]);
    if (jump > jump_mm) {
      jump_mm = jump;
      jumper = i;
    }
  }
  const std::string degrees = number_text(degrees_of(std::atan(tilt))) + " degrees";
  if (tilt > kMostTilt) {
    problems.add("gantry_tilt", "the stack leans by " + degrees + ", more than a gantry tilts (30)");
    return false;
  }
  if (jump_mm > std::max(kMostJitter * places.usual_gap_mm, places.tolerance_mm)) {
    problems.add("shifted_slices", "slice " + std::to_string(jumper + 1) + " of " + std::to_string(count) +
                                       " is shifted along its plane by " + number_text(jump_mm) +
                                       " mm against the one before it");
    return false;
  }
  if (tilt <= kLeastTilt && glm::length(overall) <= kLeastTilt && off_mm <= places.tolerance_mm) return true;
  if (tilt > kLeastTilt)
    warnings.push_back({"gantry_tilt", "the gantry was tilted by " + degrees +
                                           ": the slices were moved along their "
                                           "plane by up to " +
                                           number_text(glm::length(places.across_mm.back())) +
                                           " mm and interpolated"});
  if (tilt <= kLeastTilt || off_mm > places.tolerance_mm)
    warnings.push_back({"shifted_slices", "the slices stand up to " + number_text(off_mm) +
                                              " mm off their line and were moved along their plane"});
  return false;
}

}  // namespace

void order_slices(std::vector<DicomSlice>& slices, Problems& problems, std::vector<base::Problem>& warnings) {
  std::vector<std::pair<base::Problem, std::size_t>> found;  // so that 300 like slices say it once
  for (const DicomSlice& slice : slices)
    for (const base::Problem& problem : slice.problems) {
      const auto known = std::find_if(found.begin(), found.end(), [&](auto& f) {
        return f.first.code == problem.code && f.first.text == problem.text;
      });
      if (known == found.end())
        found.emplace_back(problem, 1);
      else
        ++known->second;
    }
  for (const auto& [problem, count] : found)
    problems.add(problem.code, "a slice of the series " + problem.text + " (" + std::to_string(count) + " of " +
                                   std::to_string(slices.size()) + ")");
  if (!found.empty()) return;
  keep_one_orientation(slices, problems, warnings);
  if (!problems.empty()) return;
  check_size(slices, problems);
  for (DicomSlice& slice : slices) {  // as good as equal, and from here on equal
    slice.row = slices.front().row;
    slice.column = slices.front().column;
  }
  const glm::dvec3 normal = normal_of(slices.front());
  std::stable_sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
    return glm::dot(a.position_lps_mm, normal) < glm::dot(b.position_lps_mm, normal);
  });
}

bool at_one_height(const DicomSlice& a, const DicomSlice& b) {
  return std::abs(glm::dot(b.position_lps_mm - a.position_lps_mm, normal_of(a))) <= kSamePlaceMm;
}

Stack stack_of(const std::vector<DicomSlice>& ordered, Problems& problems, std::vector<base::Problem>& warnings) {
  const DicomSlice& first = ordered.front();
  Stack stack;
  stack.size_voxels = {first.size_px, static_cast<int>(ordered.size())};
  glm::dvec3 step = normal_of(first) * (first.thickness_mm > 0.0 ? first.thickness_mm : 1.0), origin(0.0);
  if (ordered.size() > 1) {
    const Places places = places_of(ordered);
    // Both are asked, so that a user hears all at once.
    const bool even = heights_are_even(places, problems, warnings),
               upright = stands_upright(places, problems, warnings);
    stack.as_is = even && upright;
    if (!problems.empty()) return stack;
    const double layers =
        even ? static_cast<double>(ordered.size()) : std::round(places.extent_mm() / places.usual_gap_mm) + 1.0;
    step = stack.as_is ? (ordered.back().position_lps_mm - first.position_lps_mm) / (layers - 1.0)
                       : normal_of(first) * (places.extent_mm() / (layers - 1.0));
    if (!stack.as_is) {
      glm::dvec2 low(0.0), high(0.0);
      for (std::size_t i = 0; i < ordered.size(); ++i) {
        stack.place.push_back(places.height_mm[i] / places.extent_mm() * (layers - 1.0));
        stack.shift_px.push_back(places.across_mm[i] / first.spacing_mm);
        low = glm::min(low, stack.shift_px.back());
        high = glm::max(high, stack.shift_px.back());
      }
      low = glm::floor(low + kSamePx);
      high = glm::ceil(high - kSamePx);
      for (glm::dvec2& shift : stack.shift_px) shift -= low;
      origin = first.row * (low.x * first.spacing_mm.x) + first.column * (low.y * first.spacing_mm.y);
      stack.size_voxels = {first.size_px + glm::ivec2(high - low), static_cast<int>(layers)};
    }
  }
  const double step_mm = glm::length(step);
  if (step_mm < volume::kMinSpacingMm || step_mm > volume::kMaxSpacingMm)
    problems.add("no_geometry", "the slices lie " + number_text(step_mm) + " mm apart, which is out of range");
  stack.lps_from_voxel = {glm::dvec4(first.row * first.spacing_mm.x, 0.0),
                          glm::dvec4(first.column * first.spacing_mm.y, 0.0), glm::dvec4(step, 0.0),
                          glm::dvec4(first.position_lps_mm + origin, 1.0)};
  return stack;
}

}  // namespace seldinger::casedb
