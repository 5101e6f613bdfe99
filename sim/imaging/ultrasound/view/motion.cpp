#include "sim/imaging/ultrasound/view/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "shaders/shared/ultrasound_cube.glsl.h"
#include "shaders/shared/ultrasound_line.glsl.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

// Of a picture's depth; errors of both are measured by `bench --stage ultrasound` (docs/decisions/0025).
constexpr double kNodesADepth = 35.0, kFanNodesADepth = 50.0;
constexpr double kLeastSpacingMm = 2.0;
constexpr double kBesideMm = 2.0;  // of the grid, around the places that were looked at
constexpr int kLooks = 8;          // along and across the picture, for what of the tissue at rest it shows
constexpr tissue::InverseSteps kLook{.fixed_point = 4, .newton = 0};

double spacing_mm(const UltrasoundView& view, double nodes) {
  return std::max(kLeastSpacingMm, view.depth_mm / nodes);
}

// How far beside its own beams a picture looks, in beams.
double beside_of(const UltrasoundView& view, const Fan& fan) {
  double beams = 1.0;
  for (int i = 0; i <= kLooks; ++i) {
    const double depth_mm = std::max(0.01, view.depth_mm * i / kLooks);
    const BeamWidth width = beam_width(view.probe, working_mhz(view), view.focus_mm, depth_mm);
    beams = std::max(beams, 1.0 + shaders::kUsReachSigmas * width.lateral_sigma_mm / fan.beam_spacing_mm(depth_mm));
  }
  return beams;
}

double half_thickness_mm(const UltrasoundView& view, double depth_mm) {
  if (view.method != UltrasoundMethod::scatterers) return 0.0;
  return shaders::kUsReachSigmas *
         beam_width(view.probe, working_mhz(view), view.focus_mm, std::max(0.01, depth_mm)).elevation_sigma_mm;
}

tissue::SlabPart part_of(const UltrasoundView& view, const Fan& fan, double beside,
                         const tissue::Displacement& displacement) {
  tissue::SlabPart part;
  part.origin_lps_mm = fan.origin_lps_mm;
  part.normal = fan.elevation;
  part.spacing_mm = part.layer_mm = spacing_mm(view, kNodesADepth);
  const int axis = tissue::MovedSlab::column_axis(part.normal);
  part.low_mm = glm::dvec3(std::numeric_limits<double>::infinity());
  part.high_mm = -part.low_mm;
  for (int b = 0; b <= kLooks; ++b) {
    const double beam = -beside + (view.beams - 1.0 + 2.0 * beside) * b / kLooks;
    const glm::dvec3 start = fan.start_lps_mm(beam), direction = fan.direction(beam);
    for (int d = 0; d <= kLooks; ++d) {
      const double depth_mm = view.depth_mm * d / kLooks, half_mm = half_thickness_mm(view, depth_mm);
      for (const double side : {-1.0, 0.0, 1.0}) {
        const glm::dvec3 rest =
            tissue::rest_of(displacement, start + depth_mm * direction + side * half_mm * fan.elevation, kLook);
        const glm::dvec3 at(rest[(axis + 1) % 3], rest[(axis + 2) % 3],
                            glm::dot(part.normal, rest - part.origin_lps_mm));
        part.low_mm = glm::min(part.low_mm, at);
        part.high_mm = glm::max(part.high_mm, at);
      }
    }
  }
  part.low_mm -= kBesideMm;
  part.high_mm += kBesideMm;
  return part;
}

}  // namespace

RestFan::RestFan(const UltrasoundView& view, double spacing_mm, double beside) : fan_(fan_of(view)) {
  const double beams = view.beams - 1.0 + 2.0 * beside;
  rows_ = std::max(1, static_cast<int>(std::ceil(beams * fan_.beam_spacing_mm(view.depth_mm) / spacing_mm))) + 1;
  depths_ = std::max(1, static_cast<int>(std::ceil(view.depth_mm / spacing_mm))) + 1;
  first_beam_ = -beside;
  rows_per_beam_ = (rows_ - 1) / beams;
  depths_per_mm_ = (depths_ - 1) / view.depth_mm;
  back_mm_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(depths_),
                  glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  for (int row = 0; row < rows_; ++row) ways_.push_back(fan_.way(beam_of(row)));
}

RestFan::RestFan(const UltrasoundView& view, double spacing_mm, double beside, const RestOf& rest_of)
    : RestFan(view, spacing_mm, beside) {
  std::size_t at_node = 0;
  for (int row = 0; row < rows_; ++row) {
    glm::dvec3 back_mm(0.0);
    for (int d = 0; d < depths_; ++d) {
      const glm::dvec3 at = ways_[static_cast<std::size_t>(row)].at(d / depths_per_mm_);
      back_mm = rest_of(at, at + back_mm) - at;
      back_mm_[at_node++] = back_mm;
    }
  }
}

RestFan RestFan::when_asked(const UltrasoundView& view, double spacing_mm, double beside, RestOfMany rest_of) {
  RestFan fan(view, spacing_mm, beside);
  fan.when_asked_ = std::move(rest_of);
  return fan;
}

void RestFan::note_missing(const Nodes& nodes) const {
  for (int row = nodes.first_row; row < nodes.end_row; ++row)
    for (int d = nodes.first_depth; d < nodes.end_depth; ++d)
      if (std::isnan(node(row, d).x)) {
        missing_.push_back(index(row, d));
        at_mm_.push_back(ways_[static_cast<std::size_t>(row)].at(d / depths_per_mm_));
        back_mm_[missing_.back()] = glm::dvec3(0.0);  // noted
      }
}

void RestFan::find_missing() const {
  rest_mm_.resize(at_mm_.size());
  if (!missing_.empty()) when_asked_(at_mm_, rest_mm_);
  for (std::size_t i = 0; i < missing_.size(); ++i) back_mm_[missing_[i]] = rest_mm_[i] - at_mm_[i];
  missing_.clear();
  at_mm_.clear();
}

void RestFan::find(const Nodes& nodes) const {
  if (!when_asked_) return;
  note_missing(nodes);
  find_missing();
}

void RestFan::ask(std::span<const Box> boxes) const {
  if (!when_asked_) return;
  for (const Box& box : boxes)
    note_missing({between(box.first_beam).row, between(box.last_beam).row + 2, depth_above(box.first_mm),
                  depth_above(box.last_mm) + 2});
  find_missing();
}

RestFan::Between RestFan::between(double beam) const noexcept {
  const double at = (beam - first_beam_) * rows_per_beam_;
  const int row = at > 0.0 ? static_cast<int>(std::min(at, rows_ - 2.0)) : 0;
  return {row, at - row};
}

glm::dvec3 RestFan::rest_of(const Fan::Way& way, double beam, double depth_mm) const {
  const Between rows = between(beam);
  const double at = depth_mm * depths_per_mm_;
  const int d = depth_above(depth_mm);
  find({rows.row, rows.row + 2, d, d + 2});
  const auto across = [&](int depth) {
    const glm::dvec3& low = node(rows.row, depth);
    return low + rows.part * (node(rows.row + 1, depth) - low);
  };
  const glm::dvec3 upper = across(d), lower = across(d + 1);
  return way.at(depth_mm) + upper + (at - d) * (lower - upper);
}

std::vector<glm::dvec3> RestFan::back_of(double beam, int depths) const {
  const Between rows = between(beam);
  find({rows.row, rows.row + 2, 0, depths});
  std::vector<glm::dvec3> back_mm(static_cast<std::size_t>(depths));
  for (int d = 0; d < depths; ++d) {
    const glm::dvec3& low = node(rows.row, d);
    back_mm[static_cast<std::size_t>(d)] = low + rows.part * (node(rows.row + 1, d) - low);
  }
  return back_mm;
}

BeamPath RestFan::path(const Fan::Way& way, double beam, int depths) const {
  return {way.start_lps_mm, way.direction, back_of(beam, depths), {}, depths_per_mm_};
}
BeamPath RestFan::path_down_to(const Fan::Way& way, double beam, double depth_mm) const {
  const double at = std::clamp(depth_mm * depths_per_mm_, 0.0, depths_ - 2.0);
  return path(way, beam, static_cast<int>(at) + 2);
}

double BeamPath::facing(double depth_mm, const glm::dvec3& normal) const noexcept {
  const double on = glm::dot(normal, along(depth_mm));
  if (aside_.empty()) return std::abs(on);
  const double nodes = depth_mm * per_mm_;
  const std::size_t node = node_at(nodes);
  const double part = nodes - static_cast<double>(node);
  const Aside &low = aside_[node], &high = aside_[node + 1];
  return shaders::us_facing(on, glm::dot(normal, low.across + part * (high.across - low.across)),
                            glm::dot(normal, low.out + part * (high.out - low.out)));
}

PictureMotion::PictureMotion(const UltrasoundView& view, const tissue::Displacement& displacement, Asides asides)
    : slab_(displacement, part_of(view, fan_of(view), beside_of(view, fan_of(view)), displacement)),
      fan_(view, spacing_mm(view, kFanNodesADepth), beside_of(view, fan_of(view)),
           [this](const glm::dvec3& at_lps_mm, const glm::dvec3& guess_lps_mm) {
             return slab_.rest_of(at_lps_mm, guess_lps_mm);
           }) {
  if (asides == Asides::found) find_aside(view);
}

void PictureMotion::find_aside(const UltrasoundView& view) {
  const Fan fan = fan_of(view);
  aside_.reserve(fan_.back_mm().size());
  for (int row = 0; row < fan_.rows(); ++row) {
    const double beam = fan_.beam_of(row);
    const glm::dvec3 start = fan.start_lps_mm(beam), direction = fan.direction(beam);
    const glm::dvec3 across = glm::cross(fan.elevation, direction);
    for (int d = 0; d < fan_.depths(); ++d) {
      const std::size_t node = aside_.size();
      const glm::dmat3 f = slab_.stretch(start + (d / fan_.depths_per_mm()) * direction + fan_.back_mm()[node]);
      // ∂X/∂x by Cramer's rule; where tissue is all but folded bounded, as the way back is.
      const glm::dvec3 yz = glm::cross(f[1], f[2]), zx = glm::cross(f[2], f[0]), xy = glm::cross(f[0], f[1]);
      const double per_volume = 1.0 / std::max(glm::dot(f[0], yz), 0.05);
      const auto back = [&](const glm::dvec3& way) {
        return per_volume * glm::dvec3(glm::dot(way, yz), glm::dot(way, zx), glm::dot(way, xy));
      };
      aside_.push_back({back(across), back(fan.elevation)});
    }
  }
}

std::vector<BeamPath::Aside> PictureMotion::aside_of(double beam) const {
  if (aside_.empty()) return {};
  const RestFan::Between rows = fan_.between(beam);
  const BeamPath::Aside* low = aside_.data() + static_cast<std::ptrdiff_t>(rows.row) * fan_.depths();
  const BeamPath::Aside* high = low + fan_.depths();
  std::vector<BeamPath::Aside> aside(static_cast<std::size_t>(fan_.depths()));
  for (std::size_t d = 0; d < aside.size(); ++d)
    aside[d] = {low[d].across + rows.part * (high[d].across - low[d].across),
                low[d].out + rows.part * (high[d].out - low[d].out)};
  return aside;
}

BeamPath PictureMotion::path(double beam) const {
  return {fan_.start_lps_mm(beam), fan_.direction(beam), fan_.back_of(beam), aside_of(beam), fan_.depths_per_mm()};
}

void PictureMotion::append_path(double beam, std::vector<glm::vec4>& list) const {
  const std::vector<glm::dvec3> back_mm = fan_.back_of(beam);
  const std::vector<BeamPath::Aside> aside = aside_of(beam);
  for (std::size_t d = 0; d < back_mm.size(); ++d)
    for (const glm::dvec3& value : {back_mm[d], aside[d].across, aside[d].out})
      list.push_back(glm::vec4(glm::dvec4(value, 0.0)));
}

std::optional<PictureMotion> motion_of(const UltrasoundView& view, const tissue::Displacement& displacement,
                                       PictureMotion::Asides asides) {
  if (tissue::count_sources(displacement) == 0) return std::nullopt;
  return std::optional<PictureMotion>(std::in_place, view, displacement, asides);
}

}  // namespace seldinger::imaging
