#include "sim/imaging/ultrasound/sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/needle_echo.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/view/tissue_along.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

constexpr double kWalkMm = 0.5;    // along a beam: below a voxel of most CT
constexpr double kAroundMm = 2.0;  // how far the eye looks for a needle's background
constexpr double kBesideMm = 3.0;  // from the target's side to what it is compared with
// Of a skin that is blurred.
constexpr double kGelStepMm = 0.25 * kWalkMm;
constexpr std::size_t kGelSteps = static_cast<std::size_t>(shaders::kUsGelMm / kGelStepMm) + 1;

constexpr double kNoBeam = std::numeric_limits<double>::quiet_NaN();

// A blurred skin is gel, unless there is gas beyond what it can be. Of what lies at steps from the face down.
double gel_mm_of(std::span<const TissueClass> tissue) {
  double gel_mm = 0.0;
  for (std::size_t i = 0; i < tissue.size(); ++i) {
    const double z_mm = static_cast<double>(i) * kGelStepMm;
    if (z_mm == gel_mm ? is_gas(tissue[i]) : tissue[i] == TissueClass::air) gel_mm = z_mm + kGelStepMm;
  }
  return gel_mm > shaders::kUsGelMm ? 0.0 : gel_mm;
}

double needle_above() noexcept {
  static const double above = power_of(kNeedleAboveDb);  // asked for at every place of a needle
  return above;
}

double seen_cells(double cells) {
  return std::clamp(cells, 1.0, kMostCellsSeen);
}

}  // namespace

double power_of(double db) noexcept {
  return std::pow(10.0, 0.1 * db);
}
double decibels_of(double power) noexcept {
  return 10.0 * std::log10(std::max(power, 1e-40));
}

Sight::Sight(const TissueAt& tissue_at, const UltrasoundView& view, std::span<const float> depth_below_skin_mm,
             const tissue::Displacement& displacement)
    : view_(view),
      fan_(fan_of(view)),
      tissue_at_(tissue_at),
      table_(acoustic_table(view.attenuation_db_cm_mhz)),
      below_skin_mm_(depth_below_skin_mm),
      frequency_mhz_(working_mhz(view)) {
  for (std::size_t i = 0; i < table_.size(); ++i)
    loss_db_mm_[i] =
        shaders::us_loss_db_per_mm(table_[i].attenuation_db_cm_mhz, table_[i].exponent, frequency_mhz_);
  if (tissue::count_sources(displacement) > 0)
    at_rest_ = RestFan::when_asked(view, kSightMm, 0.0,
                                   [&](std::span<const glm::dvec3> at_lps_mm, std::span<glm::dvec3> rest_lps_mm) {
                                     tissue::rest_of(displacement, at_lps_mm, 4, rest_lps_mm);
                                   });
}

Sight::Place Sight::place(const glm::dvec3& p_lps_mm) const noexcept {
  const glm::dvec3 d = p_lps_mm - fan_.origin_lps_mm;
  const double x_mm = glm::dot(d, fan_.lateral), z_mm = glm::dot(d, fan_.axial);
  const double depth_mm = fan_.depth_mm(x_mm, z_mm), off_plane_mm = glm::dot(d, fan_.elevation);
  // As most of a needle outside the skin.
  const bool in_depth = depth_mm >= 0.0 && depth_mm <= view_.depth_mm;
  return {in_depth ? fan_.beam(x_mm, z_mm) : kNoBeam, depth_mm, off_plane_mm};
}

double Sight::slice_sigma_mm(double depth_mm) const noexcept {
  return slice_mm(depth_mm) / shaders::kUsFwhmPerSigma;
}

double Sight::made_up_db(double depth_mm) const noexcept {
  return shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, frequency_mhz_) * depth_mm;
}

// Two-way, from the face down to a depth, as LineWalker adds it up in finer steps.
double Sight::loss_db(const Fan::Way& way, double beam, double depth_mm) const {
  if (!beam_touches(view_, below_skin_mm_, beam)) return shaders::kUsDeadDb;
  const double deepest_mm = std::max(depth_mm, shaders::kUsGelMm);
  const BeamPath path =
      at_rest_ ? at_rest_->path_down_to(way, beam, deepest_mm) : BeamPath(way.start_lps_mm, way.direction);
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(depth_mm / kWalkMm)));
  const double dz = depth_mm / static_cast<double>(steps);
  depths_mm_.resize(kGelSteps + steps);
  tissue_.resize(depths_mm_.size());
  for (std::size_t i = 0; i < kGelSteps; ++i) depths_mm_[i] = static_cast<double>(i) * kGelStepMm;
  for (std::size_t k = 0; k < steps; ++k) depths_mm_[kGelSteps + k] = (static_cast<double>(k) + 0.5) * dz;
  tissue_along(path, tissue_at_, depths_mm_, tissue_);
  const double gel_mm = gel_mm_of(std::span(tissue_).first(kGelSteps));
  double sum_db = 0.0, before_mrayl = shaders::kUsMatchedMrayl;
  bool at_face = true;
  for (std::size_t k = kGelSteps; k < tissue_.size() && sum_db < shaders::kUsDeadDb; ++k) {
    if (depths_mm_[k] < gel_mm) continue;
    const auto here = static_cast<std::size_t>(tissue_[k]);
    const double mrayl = table_[here].impedance_mrayl;
    if (at_face && shaders::us_is_matched(mrayl)) before_mrayl = mrayl;  // matched, as LineWalker has it
    at_face = false;
    if (mrayl != before_mrayl) {
      sum_db += shaders::us_step_loss_db(shaders::us_reflection(before_mrayl, mrayl));
      before_mrayl = mrayl;
    }
    sum_db += loss_db_mm_[here] * dz;
  }
  return std::min(sum_db, shaders::kUsDeadDb);
}

// Mean square echo of the tissue in the plane, without loss; liver's is 1.
double Sight::scatter(const Fan::Way& way, double beam, double depth_mm) const {
  const glm::dvec3 p = at_rest_ ? at_rest_->rest_of(way, beam, depth_mm) : way.at(depth_mm);
  const double amplitude = static_cast<double>(tissue_at_.speckle(p));
  return amplitude * amplitude;
}

void Sight::get_ready(std::span<const Place> to_glance) const {
  if (!at_rest_) return;
  boxes_.clear();
  for (const Place& at : to_glance) {
    const double aside = beams_of(kAroundMm, at.depth_mm);
    boxes_.push_back({at.beam - aside, at.beam + aside, at.depth_mm - kAroundMm, at.depth_mm + kAroundMm});
  }
  at_rest_->ask(boxes_);
}

void Sight::get_ready_to_walk(std::span<const Place> down_to) const {
  if (!at_rest_) return;
  boxes_.clear();
  for (const Place& at : down_to)
    if (touches(at)) boxes_.push_back({at.beam, at.beam, 0.0, std::max(at.depth_mm, shaders::kUsGelMm)});
  at_rest_->ask(boxes_);
}

double Sight::scatter_around(const Fan::Way& way, const Place& at) const {
  const double aside = beams_of(kAroundMm, at.depth_mm);
  const auto beside = [&](double beam) { return scatter(fan_.way(beam), beam, at.depth_mm); };
  return 0.2 * (scatter(way, at.beam, at.depth_mm) + beside(at.beam - aside) + beside(at.beam + aside) +
                scatter(way, at.beam, at.depth_mm - kAroundMm) + scatter(way, at.beam, at.depth_mm + kAroundMm));
}

// Amplitude of the needle's echo without loss.
double Sight::needle_amplitude(const NeedlePose& needle, const Fan::Way& way, const Place& at, bool tip) const {
  const NeedleEcho echo = needle_echo(view_, needle, at.depth_mm, way.direction);
  const double y = at.off_plane_mm / slice_sigma_mm(at.depth_mm);
  if (!tip) return drawn(echo.shaft(), std::exp(-0.5 * y * y));
  const BeamWidth width = beam_width(view_.probe, frequency_mhz_, view_.focus_mm, std::max(0.5, at.depth_mm));
  const double off_beam = at.beam - std::clamp(std::round(at.beam), 0.0, view_.beams - 1.0);
  const double spacing_mm = fan_.beam_spacing_mm(at.depth_mm);
  const double x = off_beam * spacing_mm / needle_sigma_mm(view_, width.lateral_sigma_mm, spacing_mm);
  const double off_plane = std::exp(-0.5 * y * y);
  return std::max(drawn(echo.tip, std::exp(-0.5 * x * x), off_plane), drawn(echo.shaft(), off_plane));
}

// Of the amplitude so much as the beam sees of it; by the newest law nothing where the picture draws nothing.
double Sight::drawn(double amplitude, double across, double off_plane) const noexcept {
  const double weight = across * off_plane;
  return shows_clutter(view_) && !(weight > kLeastNeedleWeight) ? 0.0 : amplitude * across * off_plane;
}

// Mean square of what lies over all echoes: the receiver's noise, and clutter where the picture has it.
double Sight::over_all(double depth_mm) const noexcept {
  static const double noise = power_of(kReceiverNoiseDb);
  return shows_clutter(view_) ? noise + power_of(clutter_db(view_, depth_mm)) : noise;
}

double Sight::Glance::spare(double through) const noexcept {
  const double speckle = through * scatter;
  return through * echo - needle_above() * (adds_up ? speckle + over_all : std::max(speckle, over_all));
}

// spare() is straight in what comes through, or bends down once, where speckle begins to be the larger.
Sight::Glance::Range Sight::Glance::range() const noexcept {
  if (loss_db) {
    const double only = spare(power_of(-*loss_db));
    return {only, only};
  }
  const double none = spare(0.0), all = spare(1.0);
  const double bend = adds_up || !(scatter > over_all) ? none : spare(over_all / scatter);
  return {std::min(none, all), std::max({none, all, bend})};
}

double Sight::Glance::size() const noexcept {
  return echo + needle_above() * (scatter + over_all);
}

Sight::Glance Sight::glance(const NeedlePose& needle, const Place& at, bool tip) const {
  const Fan::Way way = fan_.way(at.beam);
  const double amplitude = needle_amplitude(needle, way, at, tip);
  return {at, way, amplitude * amplitude, scatter_around(way, at), over_all(at.depth_mm), shows_clutter(view_)};
}

NeedleLevel Sight::level(const Glance& walked) noexcept {
  const double loss_db = walked.loss_db.value();
  NeedleLevel level;
  level.in_field = true;
  level.off_plane_mm = walked.at.off_plane_mm;
  level.echo_db = decibels_of(walked.echo) - loss_db;
  // As the picture, the newest law adds up; those before it took the larger (docs/decisions/0090).
  level.background_db = walked.adds_up ? decibels_of(walked.scatter * power_of(-loss_db) + walked.over_all)
                                       : std::max(decibels_of(walked.scatter) - loss_db, kReceiverNoiseDb);
  return level;
}

// Cells of speckle in a ball's largest section in the slice. A cell is the integral of the intensity's
// correlation, exp(−x²/2σ²) for a beam of exp(−x²/2σ²): √(2π)·σ each way (Wagner, Smith, Sandrik and Lopez, IEEE
// Trans. Sonics Ultrason. 30 (1983) 156).
double Sight::cells_of(double radius_mm, const Place& at) const noexcept {
  const BeamWidth width = beam_width(view_.probe, frequency_mhz_, view_.focus_mm, std::max(0.5, at.depth_mm));
  const double beyond_mm = std::max(0.0, std::abs(at.off_plane_mm) - 0.5 * slice_mm(at.depth_mm));
  const double section_mm2 = std::max(0.0, radius_mm * radius_mm - beyond_mm * beyond_mm);
  return section_mm2 / (2.0 * width.lateral_sigma_mm * width.axial_sigma_mm);
}

// How much of what the slice shows there is a ball's: speckle's power is weighted by exp(−(y/σ)²).
double Sight::share_of_slice(double radius_mm, const Place& at) const noexcept {
  const double sigma_mm = slice_sigma_mm(at.depth_mm), y_mm = at.off_plane_mm;
  return 0.5 * (std::erf((y_mm + radius_mm) / sigma_mm) - std::erf((y_mm - radius_mm) / sigma_mm));
}

TargetLevel Sight::level(const cases::Lesion& target, const Place& at) const {
  TargetLevel level;
  level.in_field = in_field(at);
  level.off_plane_mm = at.off_plane_mm;
  if (!level.in_field || !(target.radius_mm > 0.0)) return level;
  const double z_mm = at.depth_mm, r_mm = target.radius_mm;
  double through = 0.0;
  for (const double across : {-0.5, 0.0, 0.5})
    through += power_of(-loss_db(at.beam + beams_of(across * r_mm, z_mm), z_mm)) / 3.0;
  level.transmission_db = decibels_of(through) + made_up_db(z_mm);
  double beside = 0.0, beside_lossless = 0.0;
  for (const double across_mm : {-r_mm - kBesideMm, r_mm + kBesideMm}) {
    const double beam = at.beam + beams_of(across_mm, z_mm);
    const Fan::Way way = fan_.way(beam);
    const double mean =
        (scatter(way, beam, z_mm - 0.5 * r_mm) + scatter(way, beam, z_mm) + scatter(way, beam, z_mm + 0.5 * r_mm)) /
        3.0;
    beside_lossless += 0.5 * mean;
    beside += 0.5 * mean * power_of(-loss_db(way, beam, z_mm));
  }
  // The slice, thicker than the target or beside it, fills it with the tissue around.
  const cases::LesionEcho echo = echo_of(target);
  const double seen_mm = seen_radius_mm(target, echo), inner_mm = std::min(seen_mm, inner_radius_mm(target, echo));
  const double whole = share_of_slice(seen_mm, at), core = inner_mm > 0.0 ? share_of_slice(inner_mm, at) : 0.0;
  const double noise = over_all(z_mm), besides_db = decibels_of(beside + noise);
  const double inside = core * power_of(echo.inside_db) + (whole - core) * power_of(echo.rim_db);
  level.contrast_db = decibels_of(through * (inside + (1.0 - whole) * beside_lossless) + noise) - besides_db;
  if (view_.sight_law == cases::SightLaw::half_slice) return level;
  level.least_cnr = kLeastCnrBySize;
  level.cells = seen_cells(cells_of(inner_mm > 0.0 ? inner_mm : seen_mm, at));
  if (inner_mm > 0.0 && inner_mm < seen_mm)
    look_at_rim(target, echo, at, through, beside_lossless, besides_db, level);
  return level;
}

// A halo shows what its lesion alone may not: the ring in the plane, as much of it as the slice holds there.
void Sight::look_at_rim(const cases::Lesion& target, const cases::LesionEcho& echo, const Place& at, double through,
                        double beside_lossless, double besides_db, TargetLevel& level) const {
  const double r_mm = seen_radius_mm(target, echo), inner_mm = inner_radius_mm(target, echo);
  const double middle_mm = 0.5 * (r_mm + inner_mm);
  const double behind_mm = std::sqrt(std::max(0.0, r_mm * r_mm - middle_mm * middle_mm));
  const double share = share_of_slice(behind_mm, at), noise = over_all(at.depth_mm);
  TargetLevel rim = level;
  rim.contrast_db =
      decibels_of(through * (share * power_of(echo.rim_db) + (1.0 - share) * beside_lossless) + noise) - besides_db;
  rim.cells = seen_cells(cells_of(r_mm, at) - cells_of(inner_mm, at));
  if (rim.cnr() > level.cnr()) level = rim;
}

}  // namespace seldinger::imaging
