#include "sim/imaging/ultrasound/line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/vectors.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "sim/imaging/ultrasound/view/tissue_along.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using shaders::us_amplitude, shaders::kUsDeadDb, shaders::kUsLensLines, shaders::kUsGelMm;
using volume::TissueClass;

// Five and a half voxels, within reason: fewer and the steps of voxels show in the normal.
constexpr double kNormalVoxels = 5.5, kLeastNormalMm = 3.3, kMostNormalMm = 6.6;
constexpr double kPlaceVoxels = 2.5;

// What comes in round bodies: cysts, gallbladder, bladder, vessels.
constexpr bool is_round(TissueClass tissue) {
  return tissue == TissueClass::fluid || tissue == TissueClass::vessel;
}

}  // namespace

struct LineWalker::NeedleCrossing {
  double depth_mm = -1.0;  // of the shaft's near side; < 0: none
  double weight = 0.0;     // how much of the beam meets it
  double covered = 0.0;    // share of the beam it stands before
  double tip_depth_mm = -1.0, tip_weight = 0.0;
};

LineWalker::LineWalker(const UltrasoundView& view, const TissueAt& tissue_at, const volume::Volume& volume,
                       const Inserted& inserted, const PictureMotion* motion)
    : view_(view),
      fan_(fan_of(view)),
      tissue_at_(tissue_at),
      around_(neighbours(volume, kNormalVoxels)),
      close_(neighbours(volume, kPlaceVoxels)),
      voxel_from_lps_(volume::voxel_from_lps(volume)),
      lps_from_voxel_(volume.lps_from_voxel),
      most_shift_mm_(std::cbrt(volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z)),
      table_(acoustic_table(view.attenuation_db_cm_mhz)),
      needle_(inserted.needle && is_usable(*inserted.needle) ? &*inserted.needle : nullptr),
      motion_(motion),
      frequency_mhz_(working_mhz(view)) {
  for (int k = 0; k < view.samples; ++k) depths_mm_.push_back((k + 0.5) * fan_.sample_mm);
  for (const Neighbour& n : around_) least_side_mm_ += shaders::kUsLeastSide * n.weight * glm::length(n.offset_mm);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    loss_db_mm_[i] =
        shaders::us_loss_db_per_mm(table_[i].attenuation_db_cm_mhz, table_[i].exponent, frequency_mhz_);
    shift_per_mm_[i] = shaders::us_shift_per_mm(1e-3 * table_[i].speed_m_s);
  }
}

// Voxels around an interface, the inner ones first; whatever lies between the voxels is the same for all of them.
std::vector<LineWalker::Neighbour> LineWalker::neighbours(const volume::Volume& volume, double radius_voxels) {
  const glm::dmat3 step(volume.lps_from_voxel);
  const glm::dvec3 spacing = volume.spacing_mm;
  const double radius_mm = std::clamp(radius_voxels * std::cbrt(spacing.x * spacing.y * spacing.z),
                                      kLeastNormalMm * radius_voxels / kNormalVoxels, kMostNormalMm);
  const glm::ivec3 reach = glm::max(glm::ivec3(radius_mm / spacing), glm::ivec3(1));
  std::vector<Neighbour> all;
  for (int k = -reach.z; k <= reach.z; ++k)
    for (int j = -reach.y; j <= reach.y; ++j)
      for (int i = -reach.x; i <= reach.x; ++i) {
        const glm::dvec3 part = glm::dvec3(i, j, k) * spacing / glm::max(glm::dvec3(radius_mm), spacing);
        const double weight = 1.0 - glm::dot(part, part) / 1.44;
        if (glm::dot(part, part) <= 1.0) all.push_back({{i, j, k}, step * glm::dvec3(i, j, k), weight});
      }
  return all;
}

// The plane between the tissue before and after: its normal from the side that each neighbour is more like, its
// place from how many there are of each.
LineWalker::Plane LineWalker::plane_at(const glm::dvec3& p_lps_mm, double before_mrayl, double after_mrayl) const {
  const double middle_mrayl = std::sqrt(before_mrayl * after_mrayl);
  std::array<double, volume::kTissueClasses> side;
  for (std::size_t i = 0; i < side.size(); ++i)
    side[i] = (table_[i].impedance_mrayl > middle_mrayl) == (after_mrayl > before_mrayl) ? 1.0 : -1.0;
  const auto side_at = [&](const Neighbour& n) {
    return n.weight * side[static_cast<std::size_t>(tissue_at_(p_lps_mm + n.offset_mm))];
  };
  Plane plane;
  for (const Neighbour& n : around_) plane.normal += side_at(n) * n.offset_mm;
  const double length = glm::length(plane.normal);
  if (!(length > least_side_mm_)) return {};
  plane.normal /= length;
  plane.is_told = true;
  double after = 0.0, all = 0.0, square = 0.0;
  for (const Neighbour& n : close_) {
    const double along = glm::dot(n.offset_mm, plane.normal);
    after += side_at(n);
    all += n.weight;
    square += n.weight * along * along;
  }
  const glm::dvec3 index = glm::dvec3(voxel_from_lps_ * glm::dvec4(p_lps_mm, 1.0));
  const glm::dvec3 center = glm::dvec3(lps_from_voxel_ * glm::dvec4(glm::floor(index + 0.5), 1.0));
  plane.has_place = square > 1e-9;
  if (plane.has_place)
    plane.off_mm = glm::dot(center - p_lps_mm, plane.normal) - shaders::us_plane_off(after, all, square);
  return plane;
}

void LineWalker::walk(int beam, bool contact, Line& line) const {
  walk(beam, contact, depths_mm_.size(), line, Echoes::found);
}

void LineWalker::walk_down(int beam, bool contact, std::size_t samples, Line& line) const {
  const auto gel = static_cast<std::size_t>(kUsGelMm / fan_.sample_mm) + 2;
  walk(beam, contact, std::min(std::max(samples, gel), depths_mm_.size()), line, Echoes::left_out);
}

void LineWalker::walk(int beam, bool contact, std::size_t count, Line& line, Echoes echoes) const {
  line.tissue.resize(count);
  line.loss_db.assign(count, static_cast<float>(kUsDeadDb));
  line.shift_mm.clear();
  line.echoes.clear();
  line.contact = contact;
  if (!contact) {
    std::fill(line.tissue.begin(), line.tissue.end(), TissueClass::air);
    for (int k = 1; k * kUsLensMm < view_.depth_mm && k <= kUsLensLines; ++k)
      line.echoes.push_back({k * kUsLensMm, shaders::us_lens_line(k)});
    return;
  }
  const BeamPath path = path_of(fan_, motion_, beam);
  const double dz = fan_.sample_mm;
  tissue_along(path, tissue_at_, std::span(depths_mm_).first(count), line.tissue);
  // Gel, unless there is gas beyond what a blurred skin can be; also past a corner of air that a slanted beam
  // clips.
  std::size_t first = 0;
  for (std::size_t k = 0; k < count && static_cast<double>(k) * dz <= kUsGelMm; ++k)
    if (k == first ? is_gas(line.tissue[k]) : line.tissue[k] == TissueClass::air) first = k + 1;
  if (first == count || static_cast<double>(first) * dz > kUsGelMm) first = 0;

  const NeedleLine needle = needle_line(beam);
  double sum_db = 0.0, before_mrayl = shaders::kUsMatchedMrayl;
  bool needle_above = false;
  const bool edges = shows_artefacts(view_) && echoes == Echoes::found;
  std::optional<std::size_t> entered;  // the sample behind the last interface that is heard
  for (std::size_t k = first; k < count; ++k) {
    const auto tissue = static_cast<std::size_t>(line.tissue[k]);
    const double mrayl = table_[tissue].impedance_mrayl;
    double late_mm = 0.0;  // how far below the samples' border the tissues' lies
    if (k > first && line.tissue[k] != line.tissue[k - 1]) {
      late_mm = border_mm(path, k, line) - static_cast<double>(k) * dz;
      sum_db = std::min(kUsDeadDb, sum_db + late_mm * loss_db_mm_[static_cast<std::size_t>(line.tissue[k - 1])]);
    }
    if (k == first && shaders::us_is_matched(mrayl)) before_mrayl = mrayl;
    if (mrayl != before_mrayl && sum_db < kUsDeadDb) {
      const double reflection = shaders::us_reflection(before_mrayl, mrayl);
      std::optional<Lens> lens;
      if (edges && entered && line.tissue[*entered] == line.tissue[k - 1] && is_round(line.tissue[k - 1]) &&
          shaders::us_is_matched(mrayl))
        lens = {static_cast<double>(k - *entered) * dz, shift_per_mm_[static_cast<std::size_t>(line.tissue[k - 1])],
                shift_per_mm_[tissue], *entered, line.tissue[k - 1]};
      if (echoes == Echoes::found)
        add_interface(path, static_cast<int>(k), before_mrayl, mrayl, sum_db, lens, line);
      if (k == 0 || shaders::us_is_heard(reflection)) entered = k;
      sum_db += shaders::us_step_loss_db(reflection);
      before_mrayl = mrayl;
    }
    sum_db -= late_mm * loss_db_mm_[tissue];
    if (!needle_above && needle.depth_mm >= 0.0 && (static_cast<double>(k) + 0.5) * dz >= needle.depth_mm) {
      needle_above = true;
      sum_db += needle.shadow_db;
    }
    const double step_db = loss_db_mm_[tissue] * dz;
    line.loss_db[k] = static_cast<float>(std::min(kUsDeadDb, sum_db + 0.5 * step_db));
    sum_db = std::min(kUsDeadDb, sum_db + step_db);
  }
  for (std::size_t k = 0; k < first; ++k) line.loss_db[k] = 0.0F;
  if (echoes == Echoes::left_out) return;
  for (const NeedleLine::Echo& echo : needle.echoes) {
    const auto k = static_cast<std::size_t>(std::clamp(echo.loss_at_mm / dz - 0.5, 0.0, view_.samples - 1.0));
    line.echoes.push_back({echo.depth_mm, echo.amplitude * us_amplitude(-static_cast<double>(line.loss_db[k]))});
  }
  if (view_.range_error) shift(first, line);
}

double LineWalker::border_mm(const BeamPath& path, std::size_t sample, const Line& line) const {
  double above = (static_cast<double>(sample) - 0.5) * fan_.sample_mm, below = above + fan_.sample_mm;
  for (int i = 0; i < shaders::kUsBorderHalvings; ++i) {
    const double middle = 0.5 * (above + below);
    (tissue_at_(path.at(middle)) == line.tissue[sample - 1] ? above : below) = middle;
  }
  return 0.5 * (above + below);
}

// Sound that was slower than the scanner assumes comes later, and shows deeper: by ∫(1540/c − 1) dz, half a mm
// behind 10 mm of fat.
void LineWalker::shift(std::size_t first, Line& line) const {
  double sum_mm = 0.0, most_mm = 0.0;
  line.shift_mm.resize(line.tissue.size());
  for (std::size_t k = 0; k < line.tissue.size(); ++k) {
    const double step_mm =
        k < first ? 0.0 : shift_per_mm_[static_cast<std::size_t>(line.tissue[k])] * fan_.sample_mm;
    line.shift_mm[k] = static_cast<float>(sum_mm + 0.5 * step_mm);
    sum_mm += step_mm;
    most_mm = std::max(most_mm, std::abs(sum_mm));
  }
  if (most_mm == 0.0) {
    line.shift_mm.clear();
    return;
  }
  for (LineEcho& echo : line.echoes) {
    const double at = std::clamp(echo.depth_mm / fan_.sample_mm - 0.5, 0.0, view_.samples - 1.0);
    echo.depth_mm += static_cast<double>(line.shift_mm[static_cast<std::size_t>(at)]);
  }
}

double LineWalker::reach_mm(const glm::dvec3& from_lps_mm, const glm::dvec3& way, TissueClass inside) const {
  double within_mm = 0.0, beyond_mm = shaders::kUsMostReachMm;
  for (double at_mm = shaders::kUsReachStepMm; at_mm < shaders::kUsMostReachMm;
       at_mm += std::max(shaders::kUsReachStepMm, shaders::kUsReachStepShare * at_mm)) {
    if (tissue_at_(from_lps_mm + at_mm * way) != inside) {
      beyond_mm = at_mm;
      break;
    }
    within_mm = at_mm;
  }
  for (int i = 0; i < shaders::kUsReachHalvings; ++i) {
    const double middle_mm = 0.5 * (within_mm + beyond_mm);
    (tissue_at_(from_lps_mm + middle_mm * way) == inside ? within_mm : beyond_mm) = middle_mm;
  }
  return 0.5 * (within_mm + beyond_mm);
}

double LineWalker::parting_per_mm(const BeamPath& path, const Lens& lens, int left, double cosine,
                                  double depth_mm) const {
  const double width_mm =
      shaders::us_lateral_fwhm_mm(std::max(depth_mm, 1.0), shaders::us_wavelength_mm(frequency_mhz_),
                                  view_.probe.f_number, view_.probe.aperture_mm, view_.focus_mm);
  if (!tells_layers(view_))
    return shaders::us_parting_per_mm(lens.shift_inside, lens.shift_outside, lens.chord_mm, cosine, width_mm);
  if (lens.entered == 0) return 0.0;
  const double middle_mm = 0.5 * (static_cast<double>(lens.entered) + left) * fan_.sample_mm;
  const glm::dvec3 middle = path.at(middle_mm),
                   across = glm::normalize(glm::cross(fan_.elevation, path.along(middle_mm)));
  const auto parting = [&](const glm::dvec3& way) {
    return shaders::us_parting_by_width(lens.shift_inside, lens.shift_outside, reach_mm(middle, way, lens.inside),
                                        reach_mm(middle, -way, lens.inside), width_mm);
  };
  return shaders::us_stronger(parting(across), parting(fan_.elevation));
}

void LineWalker::add_interface(const BeamPath& path, int sample, double before_mrayl, double after_mrayl,
                               double loss_db, const std::optional<Lens>& lens, Line& line) const {
  const double reflection = shaders::us_reflection(before_mrayl, after_mrayl);
  double depth_mm = sample * fan_.sample_mm, cosine = 1.0;
  Plane plane;
  if (sample > 0) {
    if (!shaders::us_is_heard(reflection)) return;
    // The plane lies in tissue at rest, and the beam there goes along with it.
    plane = plane_at(path.at(depth_mm), before_mrayl, after_mrayl);
    const double along = glm::dot(plane.normal, path.along(depth_mm));
    if (plane.is_told) cosine = std::clamp(path.facing(depth_mm, plane.normal), 0.0, 1.0);
    // Between voxels, so that a slanted wall is a line and no staircase; not where it is seen from its side.
    if (plane.has_place && cosine > shaders::kUsLeastPlaceCosine)
      depth_mm = std::max(0.0, depth_mm + std::clamp(plane.off_mm / along, -most_shift_mm_, most_shift_mm_));
  }
  const double face = reflection * shaders::us_interface_law(cosine) * us_amplitude(kUsInterfaceDb - loss_db);
  const double parting = lens ? parting_per_mm(path, *lens, sample, cosine, depth_mm) : 0.0;
  line.echoes.push_back({depth_mm, face, parting});
  if (std::abs(reflection) < shaders::kUsRepeatsFrom || depth_mm <= 0.0) {
    // Gas at the face itself rings in the lens.
    if (std::abs(reflection) >= shaders::kUsRepeatsFrom)
      for (int k = 1; k * kUsLensMm < view_.depth_mm && k <= kUsLensLines; ++k)
        line.echoes.push_back({k * kUsLensMm, shaders::us_lens_line(k)});
    return;
  }
  for (int again = 2; again * depth_mm < view_.depth_mm && again <= shaders::kUsMostAgain; ++again)
    line.echoes.push_back({again * depth_mm, face * shaders::us_repeat(again, loss_db)});
}

LineWalker::NeedleCrossing LineWalker::crossing(const glm::dvec3& start, const glm::dvec3& direction) const {
  NeedleCrossing at;
  const glm::dvec3 along = glm::normalize(needle_->direction);
  const glm::dvec3 across = glm::cross(fan_.elevation, direction);  // in the plane, square to the beam
  const glm::dvec3 tip = needle_->tip_lps_mm - start;
  const double tip_x = glm::dot(tip, across), tip_y = glm::dot(tip, fan_.elevation),
               tip_z = glm::dot(tip, direction);
  const double x1 = -glm::dot(along, across), y1 = -glm::dot(along, fan_.elevation),
               z1 = -glm::dot(along, direction);
  const auto width_at = [&](double depth_mm) {
    const double at_mm = std::clamp(depth_mm, 0.5, view_.depth_mm);
    BeamWidth width = beam_width(view_.probe, frequency_mhz_, view_.focus_mm, at_mm);
    width.lateral_sigma_mm = needle_sigma_mm(view_, width.lateral_sigma_mm, fan_.beam_spacing_mm(at_mm));
    return width;
  };
  // The point of the shaft that the beam sees most of; its widths change slowly with depth, twice is enough.
  double t = 0.0;
  for (int round = 0; round < 3; ++round) {
    const BeamWidth width = width_at(tip_z + t * z1);
    const double wx = 1.0 / (width.lateral_sigma_mm * width.lateral_sigma_mm),
                 wy = 1.0 / (width.elevation_sigma_mm * width.elevation_sigma_mm);
    const double curvature = x1 * x1 * wx + y1 * y1 * wy;
    t = curvature > 1e-9 ? std::clamp(-(tip_x * x1 * wx + tip_y * y1 * wy) / curvature, 0.0, needle_->length_mm)
                         : 0.0;
  }
  const auto weight_at = [&](double x, double y, double z) {
    const BeamWidth width = width_at(z);
    const double u = x / width.lateral_sigma_mm, v = y / width.elevation_sigma_mm;
    return std::exp(-0.5 * (u * u + v * v));
  };
  const double z = tip_z + t * z1;
  const double sine = std::min(1.0, std::abs(z1));
  const double near_mm = z - needle_->radius_mm / std::max(0.25, std::sqrt(1.0 - sine * sine));
  const double weight = weight_at(tip_x + t * x1, tip_y + t * y1, z);
  if (near_mm >= 0.0 && near_mm < view_.depth_mm && weight > kLeastNeedleWeight) {
    at.depth_mm = near_mm;
    at.weight = weight;
    // A strip as wide as the needle, in a Gaussian beam whose width across the strip is:
    const BeamWidth width = width_at(z);
    const double flat = std::sqrt(x1 * x1 + y1 * y1);  // 0: along the beam, a dot
    const double sigma = flat > 1e-6 ? std::hypot(width.elevation_sigma_mm * x1, width.lateral_sigma_mm * y1) / flat
                                     : width.elevation_sigma_mm;
    at.covered = std::min(0.99, weight * 2.0 * needle_->radius_mm / (2.506628 * sigma));
  }
  if (tip_z >= 0.0 && tip_z < view_.depth_mm) {
    at.tip_weight = weight_at(tip_x, tip_y, tip_z);
    if (at.tip_weight > kLeastNeedleWeight) at.tip_depth_mm = tip_z;
  }
  return at;
}

NeedleLine LineWalker::needle_line(int beam) const {
  NeedleLine line;
  if (needle_ == nullptr) return line;
  const glm::dvec3 direction = fan_.direction(beam);
  const NeedleCrossing at = crossing(fan_.start_lps_mm(beam), direction);
  line.depth_mm = at.depth_mm;
  if (at.covered > 0.0)
    line.shadow_db = -20.0 * std::log10(1.0 - at.covered * (1.0 - us_amplitude(-kNeedleShadowDb)));
  if (at.depth_mm >= 0.0) {
    const NeedleEcho echo = needle_echo(view_, *needle_, at.depth_mm, direction);
    line.echoes.push_back({at.depth_mm, echo.shaft() * at.weight, at.depth_mm});
    // Lines from inside: the lumen of a hollow one, as deep as saline shows it; the steel of a solid one.
    const double spacing_mm = needle_->inner_radius_mm > 0.0 ? 2.0 * needle_->inner_radius_mm * 1540.0 / 1480.0
                                                             : 2.0 * needle_->radius_mm * 1540.0 / 5790.0;
    // By laws before clutter they are all there, or none where the shaft's roughness is stronger than its mirror.
    const bool fades = shows_clutter(view_);
    const double per_line_db = fades && needle_->inner_radius_mm > 0.0 ? kLumenDbPerLine : kTailDbPerLine;
    for (int n = 1; n <= kMostTailLines; ++n) {
      const double level = echo.mirror * at.weight * us_amplitude(-n * per_line_db);
      if (fades ? level > us_amplitude(kLeastTailDb) : echo.mirror > echo.rough)
        line.echoes.push_back({at.depth_mm + n * spacing_mm, level, at.depth_mm});
    }
  }
  if (at.tip_depth_mm >= 0.0) {
    // The end of the shaft does not lie in the shaft's shadow.
    const bool own_shadow = view_.sight_law == cases::SightLaw::half_slice || at.depth_mm < 0.0;
    line.echoes.push_back({at.tip_depth_mm,
                           needle_echo(view_, *needle_, at.tip_depth_mm, direction).tip * at.tip_weight,
                           own_shadow ? at.tip_depth_mm : std::min(at.depth_mm, at.tip_depth_mm)});
  }
  return line;
}

}  // namespace seldinger::imaging
