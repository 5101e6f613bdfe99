#include "sim/imaging/ultrasound/visible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/vectors.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/needle_echo.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

constexpr double kWalkMm = 0.5;                     // along a beam: below a voxel of most CT
constexpr double kAroundMm = 2.0;                   // how far the eye looks for a needle's background
constexpr double kBesideMm = 3.0;                   // from the target's side to what it is compared with
constexpr double kNearMm = 2.0, kLessNearMm = 5.0;  // of the geometric rules (recording.h)

double power(double db) {
  return std::pow(10.0, 0.1 * db);
}
double decibels(double of_power) {
  return 10.0 * std::log10(std::max(of_power, 1e-40));
}

constexpr double kNoBeam = std::numeric_limits<double>::quiet_NaN();
// Where a point lies in the picture.
struct Place {
  double beam, depth_mm, off_plane_mm;
};

class Sight {
 public:
  Sight(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
        std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement)
      : view_(view),
        displacement_(displacement),
        fan_(fan_of(view)),
        tissue_at_(tissue, inserted),
        table_(acoustic_table(view.attenuation_db_cm_mhz)),
        below_skin_mm_(depth_below_skin_mm),
        frequency_mhz_(working_mhz(view)) {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      loss_db_mm_[i] =
          shaders::us_loss_db_per_mm(table_[i].attenuation_db_cm_mhz, table_[i].exponent, frequency_mhz_);
    }
    if (tissue::count_sources(displacement) > 0)
      at_rest_ = RestFan::when_asked(view, kSightMm, 0.0,
                                     [&](std::span<const glm::dvec3> at_lps_mm, std::span<glm::dvec3> rest_lps_mm) {
                                       tissue::rest_of(displacement, at_lps_mm, 4, rest_lps_mm);
                                     });
  }

  // Of what is told at rest.
  Place place_of_tissue(const glm::dvec3& rest_lps_mm) const {
    return place(at_rest_ ? tissue::displaced(displacement_, rest_lps_mm) : rest_lps_mm);
  }
  Place place(const glm::dvec3& p_lps_mm) const {
    const glm::dvec3 d = p_lps_mm - fan_.origin_lps_mm;
    const double x_mm = glm::dot(d, fan_.lateral), z_mm = glm::dot(d, fan_.axial);
    const double depth_mm = fan_.depth_mm(x_mm, z_mm), off_plane_mm = glm::dot(d, fan_.elevation);
    // Nobody asks for the beam of what lies too near or too deep, as most of a needle outside the skin does.
    const bool in_depth = depth_mm >= 0.0 && depth_mm <= view_.depth_mm;
    return {in_depth ? fan_.beam(x_mm, z_mm) : kNoBeam, depth_mm, off_plane_mm};
  }
  // The same borders as the screen's (ScanConverter); not with NaN.
  bool in_field(const Place& at) const {
    return at.beam >= -0.5 && at.beam <= view_.beams - 0.5 && at.depth_mm >= 0.0 && at.depth_mm <= view_.depth_mm;
  }
  bool touches(const Place& at) const { return beam_touches(view_, below_skin_mm_, at.beam); }
  bool in_slice(const Place& at, double more_mm) const {
    return std::abs(at.off_plane_mm) <= more_mm + 0.5 * slice_mm(at.depth_mm);
  }
  double slice_mm(double depth_mm) const { return elevation_fwhm_mm(view_.probe, frequency_mhz_, depth_mm); }
  double slice_sigma_mm(double depth_mm) const { return slice_mm(depth_mm) / shaders::kUsFwhmPerSigma; }
  double made_up_db(double depth_mm) const {
    return shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, frequency_mhz_) * depth_mm;
  }
  double beams_of(double across_mm, double depth_mm) const { return across_mm / fan_.beam_spacing_mm(depth_mm); }

  // Two-way, from the face down to a depth, as LineWalker adds it up in finer steps.
  double loss_db(double beam, double depth_mm) const { return loss_db(fan_.way(beam), beam, depth_mm); }
  double loss_db(const Fan::Way& way, double beam, double depth_mm) const {
    if (!beam_touches(view_, below_skin_mm_, beam)) return shaders::kUsDeadDb;
    const double deepest_mm = std::max(depth_mm, shaders::kUsGelMm);
    const BeamPath path =
        at_rest_ ? at_rest_->path_down_to(way, beam, deepest_mm) : BeamPath(way.start_lps_mm, way.direction);
    const int steps = std::max(1, static_cast<int>(std::ceil(depth_mm / kWalkMm)));
    const double dz = depth_mm / steps;
    const auto tissue = [&](double z_mm) { return tissue_at_(path.at(z_mm)); };
    // A blurred skin is gel, unless there is gas beyond what it can be.
    constexpr double kStepMm = 0.25 * kWalkMm;
    double gel_mm = 0.0;
    for (double z_mm = 0.0; z_mm <= shaders::kUsGelMm; z_mm += kStepMm)
      if (z_mm == gel_mm ? is_gas(tissue(z_mm)) : tissue(z_mm) == TissueClass::air) gel_mm = z_mm + kStepMm;
    if (gel_mm > shaders::kUsGelMm) gel_mm = 0.0;
    double sum_db = 0.0, before_mrayl = shaders::kUsMatchedMrayl;
    bool at_face = true;
    for (int k = 0; k < steps && sum_db < shaders::kUsDeadDb; ++k) {
      const double z_mm = (k + 0.5) * dz;
      if (z_mm < gel_mm) continue;
      const auto here = static_cast<std::size_t>(tissue(z_mm));
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
  double scatter(const Fan::Way& way, double beam, double depth_mm) const {
    const glm::dvec3 p = at_rest_ ? at_rest_->rest_of(way, beam, depth_mm) : way.at(depth_mm);
    const double amplitude = static_cast<double>(tissue_at_.speckle(p));
    return amplitude * amplitude;
  }
  double scatter_around(const Fan::Way& way, const Place& at) const {
    const double aside = beams_of(kAroundMm, at.depth_mm);
    if (at_rest_) at_rest_->ask(at.beam - aside, at.beam + aside, at.depth_mm - kAroundMm, at.depth_mm + kAroundMm);
    const auto beside = [&](double beam) { return scatter(fan_.way(beam), beam, at.depth_mm); };
    return 0.2 * (scatter(way, at.beam, at.depth_mm) + beside(at.beam - aside) + beside(at.beam + aside) +
                  scatter(way, at.beam, at.depth_mm - kAroundMm) + scatter(way, at.beam, at.depth_mm + kAroundMm));
  }

  // Amplitude of the needle's echo without loss, at a place on its shaft or at its tip.
  double needle_amplitude(const NeedlePose& needle, const Fan::Way& way, const Place& at, bool tip) const {
    const glm::dvec3 along = glm::normalize(needle.direction);
    const double sine = std::min(1.0, std::abs(glm::dot(along, way.direction)));
    const NeedleEcho echo = needle_echo(view_, needle, at.depth_mm, std::asin(sine));
    const double y = at.off_plane_mm / slice_sigma_mm(at.depth_mm);
    if (!tip) return drawn(echo.shaft(), std::exp(-0.5 * y * y));
    const BeamWidth width = beam_width(view_.probe, frequency_mhz_, view_.focus_mm, std::max(0.5, at.depth_mm));
    const double off_beam = at.beam - std::clamp(std::round(at.beam), 0.0, view_.beams - 1.0);
    const double x = off_beam * fan_.beam_spacing_mm(at.depth_mm) / width.lateral_sigma_mm;
    const double off_plane = std::exp(-0.5 * y * y);
    return std::max(drawn(echo.tip, std::exp(-0.5 * x * x), off_plane), drawn(echo.shaft(), off_plane));
  }
  // Of the amplitude so much as the beam sees of it; by the newest law nothing where the picture draws nothing.
  double drawn(double amplitude, double across, double off_plane = 1.0) const {
    const double weight = across * off_plane;
    return shows_clutter(view_) && !(weight > kLeastNeedleWeight) ? 0.0 : amplitude * across * off_plane;
  }

  // Mean square of what lies over all echoes: the receiver's noise, and clutter where the picture has it.
  double over_all(double depth_mm) const {
    const double noise = power(kReceiverNoiseDb);
    return shows_clutter(view_) ? noise + power(clutter_db(view_, depth_mm)) : noise;
  }

  // A needle at a place of the field and what lies about it there: mean squares before the way takes its share.
  struct Glance {
    Place at;
    Fan::Way way;
    double echo, scatter;
    // Speckle alone hides it, whatever is lost on the way.
    bool is_in_speckle() const { return decibels(echo) < decibels(scatter) + kNeedleAboveDb; }
  };
  Glance glance(const NeedlePose& needle, const Place& at, bool tip) const {
    const Fan::Way way = fan_.way(at.beam);
    return {at, way, std::pow(needle_amplitude(needle, way, at, tip), 2.0), scatter_around(way, at)};
  }
  NeedleLevel level(const Glance& glance) const {
    const Place& at = glance.at;
    NeedleLevel level;
    level.in_field = true;
    level.off_plane_mm = at.off_plane_mm;
    const double loss = loss_db(glance.way, at.beam, at.depth_mm);
    level.echo_db = decibels(glance.echo) - loss;
    // As the picture, the newest law adds up; those before it took the larger (docs/decisions/0090).
    level.background_db = shows_clutter(view_) ? decibels(glance.scatter * power(-loss) + over_all(at.depth_mm))
                                               : std::max(decibels(glance.scatter) - loss, kReceiverNoiseDb);
    return level;
  }

  // Cells of speckle in a ball's largest section in the slice. A cell is the integral of the intensity's
  // correlation, exp(−x²/2σ²) for a beam of exp(−x²/2σ²): √(2π)·σ each way (Wagner, Smith, Sandrik and Lopez, IEEE
  // Trans. Sonics Ultrason. 30 (1983) 156).
  double cells_of(double radius_mm, const Place& at) const {
    const BeamWidth width = beam_width(view_.probe, frequency_mhz_, view_.focus_mm, std::max(0.5, at.depth_mm));
    const double beyond_mm = std::max(0.0, std::abs(at.off_plane_mm) - 0.5 * slice_mm(at.depth_mm));
    const double section_mm2 = std::max(0.0, radius_mm * radius_mm - beyond_mm * beyond_mm);
    return section_mm2 / (2.0 * width.lateral_sigma_mm * width.axial_sigma_mm);
  }
  static double seen_cells(double cells) { return std::clamp(cells, 1.0, kMostCellsSeen); }

  // How much of what the slice shows there is a ball's: speckle's power is weighted by exp(−(y/σ)²).
  double share_of_slice(double radius_mm, const Place& at) const {
    const double sigma_mm = slice_sigma_mm(at.depth_mm), y_mm = at.off_plane_mm;
    return 0.5 * (std::erf((y_mm + radius_mm) / sigma_mm) - std::erf((y_mm - radius_mm) / sigma_mm));
  }

  // Decisions 0013 and 0057.
  TargetLevel level(const cases::Lesion& target) const {
    const Place at = place_of_tissue(target.center_lps_mm);
    TargetLevel level;
    level.in_field = in_field(at);
    level.off_plane_mm = at.off_plane_mm;
    if (!level.in_field || !(target.radius_mm > 0.0)) return level;
    const double z_mm = at.depth_mm, r_mm = target.radius_mm;
    double through = 0.0;
    for (const double across : {-0.5, 0.0, 0.5})
      through += power(-loss_db(at.beam + beams_of(across * r_mm, z_mm), z_mm)) / 3.0;
    level.transmission_db = decibels(through) + made_up_db(z_mm);
    double beside = 0.0, beside_lossless = 0.0;
    for (const double across_mm : {-r_mm - kBesideMm, r_mm + kBesideMm}) {
      const double beam = at.beam + beams_of(across_mm, z_mm);
      const Fan::Way way = fan_.way(beam);
      const double mean = (scatter(way, beam, z_mm - 0.5 * r_mm) + scatter(way, beam, z_mm) +
                           scatter(way, beam, z_mm + 0.5 * r_mm)) /
                          3.0;
      beside_lossless += 0.5 * mean;
      beside += 0.5 * mean * power(-loss_db(beam, z_mm));
    }
    // The slice, thicker than the target or beside it, fills it with the tissue around.
    const cases::LesionEcho echo = echo_of(target);
    const double inner_mm = inner_radius_mm(target, echo);
    const double whole = share_of_slice(r_mm, at), core = inner_mm > 0.0 ? share_of_slice(inner_mm, at) : 0.0;
    const double noise = over_all(z_mm), besides_db = decibels(beside + noise);
    const double inside = core * power(echo.inside_db) + (whole - core) * power(echo.rim_db);
    level.contrast_db = decibels(through * (inside + (1.0 - whole) * beside_lossless) + noise) - besides_db;
    if (view_.sight_law == cases::SightLaw::half_slice) return level;
    level.least_cnr = kLeastCnrBySize;
    level.cells = seen_cells(cells_of(inner_mm > 0.0 ? inner_mm : r_mm, at));
    if (echo.rim_mm > 0.0 && inner_mm > 0.0)
      look_at_rim(target, echo, at, through, beside_lossless, besides_db, level);
    return level;
  }

  // A halo shows what its lesion alone may not: the ring in the plane, as much of it as the slice holds there.
  void look_at_rim(const cases::Lesion& target, const cases::LesionEcho& echo, const Place& at, double through,
                   double beside_lossless, double besides_db, TargetLevel& level) const {
    const double r_mm = target.radius_mm, inner_mm = inner_radius_mm(target, echo);
    const double middle_mm = 0.5 * (r_mm + inner_mm);
    const double behind_mm = std::sqrt(std::max(0.0, r_mm * r_mm - middle_mm * middle_mm));
    const double share = share_of_slice(behind_mm, at), noise = over_all(at.depth_mm);
    TargetLevel rim = level;
    rim.contrast_db =
        decibels(through * (share * power(echo.rim_db) + (1.0 - share) * beside_lossless) + noise) - besides_db;
    rim.cells = seen_cells(cells_of(r_mm, at) - cells_of(inner_mm, at));
    if (rim.cnr() > level.cnr()) level = rim;
  }

 private:
  const UltrasoundView& view_;
  const tissue::Displacement& displacement_;
  Fan fan_;
  TissueAt tissue_at_;
  AcousticTable table_;
  std::array<double, volume::kTissueClasses> loss_db_mm_;
  std::span<const float> below_skin_mm_;
  double frequency_mhz_;
  std::optional<RestFan> at_rest_;  // where tissue moves
};

// The looks of a picture: one, or of a compounded view those whose mean square is shown.
class Looks {
 public:
  Looks(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
        std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement)
      : view_(view) {
    const int count = view.compound_deg > 0.0 ? kLooks : 1;
    for (int i = 0; i < count; ++i) views_[static_cast<std::size_t>(i)] = look_of(view, i);
    for (int i = 0; i < count; ++i)
      looks_.emplace_back(tissue, views_[static_cast<std::size_t>(i)], inserted, depth_below_skin_mm, displacement);
  }
  Looks(const Looks&) = delete;
  Looks& operator=(const Looks&) = delete;
  const Sight& middle() const { return looks_.front(); }

  // At a place in the field of the middle one. Beams are walked down only as far as the answer
  // hangs on them; where a few do not settle it, all are.
  bool needle_stands_out(const NeedlePose& needle, const glm::dvec3& p_lps_mm, bool tip) const {
    const Glances glances = look_at(needle, p_lps_mm, tip);
    const auto hides = [](const Glances::value_type& one) { return !one || one->is_in_speckle(); };
    if (std::all_of(glances.begin(), glances.end(), hides)) return false;
    return stands_out_of_few(glances) || mean_of(glances).stands_out();
  }

  double visible_shaft_mm(const NeedlePose& needle) const {
    const int steps = std::clamp(static_cast<int>(std::ceil(needle.length_mm / kShaftStepMm)), 1, 1000);
    const double step_mm = needle.length_mm / steps;
    const glm::dvec3 along = glm::normalize(needle.direction);
    int seen = 0;
    for (int i = 0; i < steps; ++i) {
      const glm::dvec3 p = needle.tip_lps_mm - ((i + 0.5) * step_mm) * along;
      seen += middle().in_field(middle().place(p)) && needle_stands_out(needle, p, false) ? 1 : 0;
    }
    return seen * step_mm;
  }

  NeedleLevel level(const NeedlePose& needle, const glm::dvec3& p_lps_mm, bool tip) const {
    const Place in_middle = middle().place(p_lps_mm);
    if (middle().in_field(in_middle)) return mean_of(look_at(needle, p_lps_mm, tip));
    NeedleLevel none;
    none.off_plane_mm = in_middle.off_plane_mm;
    return none;
  }

  // Speckle is evened out by as many looks as see the target.
  TargetLevel level(const cases::Lesion& target) const {
    TargetLevel mean = middle().level(target);
    if (looks_.size() == 1 || !mean.in_field) return mean;
    double through = 0.0, contrast = 0.0;
    int count = 0;
    for (const Sight& look : looks_) {
      const TargetLevel one = look.level(target);
      if (!one.in_field) continue;
      through += power(one.transmission_db);
      contrast += power(one.contrast_db);
      ++count;
    }
    mean.transmission_db = decibels(through / count);
    mean.contrast_db = decibels(contrast / count);
    mean.cells *= independent_looks(view_, middle().place_of_tissue(target.center_lps_mm).depth_mm, count);
    return mean;
  }

 private:
  using Glances = std::array<std::optional<Sight::Glance>, kLooks>;  // of the looks that show a place
  // In the field of the middle one; the others as the compounder lays them over it (Compounder::mean).
  Glances look_at(const NeedlePose& needle, const glm::dvec3& p_lps_mm, bool tip) const {
    Glances glances;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      const Place at = looks_[i].place(p_lps_mm);
      if (i == 0 || (looks_[i].in_field(at) && looks_[i].touches(at)))
        glances[i] = looks_[i].glance(needle, at, tip);
    }
    return glances;
  }
  NeedleLevel mean_of(const Glances& glances) const {
    NeedleLevel mean = middle().level(*glances.front());
    if (looks_.size() == 1 || !middle().touches(glances.front()->at)) return mean;
    double echo = 0.0, background = 0.0, count = 0.0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (!glances[i]) continue;
      const NeedleLevel one = i == 0 ? mean : looks_[i].level(*glances[i]);
      const double less_db = begun_db(glances[i]->at, glances.front()->at);
      echo += power(one.echo_db - less_db);
      background += power(one.background_db - less_db);
      count += 1.0;
    }
    mean.echo_db = decibels(echo / count);
    mean.background_db = decibels(background / count);
    return mean;
  }
  // Of the sum that mean_of asks for, a look in which speckle does not hide the needle takes away no more than what
  // lies over all echoes there. Where the others have more than that to spare, nobody need walk down its beam.
  bool stands_out_of_few(const Glances& glances) const {
    if (looks_.size() == 1 || !middle().touches(glances.front()->at)) return false;
    const double least = power(kNeedleAboveDb);
    double spare = 0.0, taken = 0.0, rounding = 0.0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (!glances[i]) continue;
      const Place& at = glances[i]->at;
      const double share = power(-begun_db(at, glances.front()->at));
      if (i > 0 && !glances[i]->is_in_speckle()) {
        taken += share * least * looks_[i].over_all(at.depth_mm);
        continue;
      }
      const NeedleLevel one = looks_[i].level(*glances[i]);
      const double echo = share * power(one.echo_db), background = share * least * power(one.background_db);
      spare += echo - background;
      rounding += 1e-9 * (echo + background);
    }
    return spare - rounding > taken;
  }
  // What a look is lowered by where it is laid over the middle one, because it begins deeper.
  double begun_db(const Place& look, const Place& in_middle) const {
    return middle().made_up_db(std::max(0.0, in_middle.depth_mm - look.depth_mm));
  }
  const UltrasoundView& view_;
  std::array<UltrasoundView, kLooks> views_;
  std::vector<Sight> looks_;
};

const NeedlePose* usable_needle(const Inserted& inserted) {
  return inserted.needle && is_usable(*inserted.needle) ? &*inserted.needle : nullptr;
}

}  // namespace

double TargetLevel::cnr() const noexcept {
  return std::abs(contrast_db) / (kSpeckleDb / std::sqrt(cells));
}

UltrasoundVisible ultrasound_visible(const TissueVolume& tissue, const UltrasoundView& view,
                                     const Inserted& inserted, std::span<const float> depth_below_skin_mm,
                                     const tissue::Displacement& displacement) {
  const Looks looks(tissue, view, inserted, depth_below_skin_mm, displacement);
  const Sight& sight = looks.middle();
  UltrasoundVisible seen;
  if (const NeedlePose* needle = usable_needle(inserted)) {
    const Place tip = sight.place(needle->tip_lps_mm);
    if (sight.in_field(tip)) {
      seen.near_plane.tip_2_mm = std::abs(tip.off_plane_mm) <= kNearMm;
      seen.near_plane.tip_5_mm = std::abs(tip.off_plane_mm) <= kLessNearMm;
      const bool in_reach = view.sight_law != cases::SightLaw::half_slice || sight.in_slice(tip, 0.0);
      seen.visible.needle_tip = in_reach && looks.needle_stands_out(*needle, needle->tip_lps_mm, true);
    }
    seen.visible.needle_length_mm = looks.visible_shaft_mm(*needle);
  }
  if (!inserted.lesions.empty()) {
    const cases::Lesion& target = inserted.lesions.front();
    const Place center = sight.place_of_tissue(target.center_lps_mm);
    if (sight.in_field(center)) {
      seen.near_plane.target_2_mm = std::abs(center.off_plane_mm) <= kNearMm;
      seen.near_plane.target_5_mm = std::abs(center.off_plane_mm) <= kLessNearMm;
      if (sight.in_slice(center, target.radius_mm)) {
        const TargetLevel level = looks.level(target);
        seen.visible.target = level.transmission_db >= kLeastTransmissionDb && level.stands_out();
      }
    }
  }
  seen.visible.joint = seen.visible.needle_tip && seen.visible.target;
  return seen;
}

NeedleLevel needle_level(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                         std::span<const float> depth_below_skin_mm, double behind_tip_mm,
                         const tissue::Displacement& displacement) {
  const NeedlePose* needle = usable_needle(inserted);
  return needle == nullptr
             ? NeedleLevel{}
             : Looks(tissue, view, inserted, depth_below_skin_mm, displacement)
                   .level(*needle, needle->tip_lps_mm - behind_tip_mm * glm::normalize(needle->direction),
                          behind_tip_mm == 0.0);
}

TargetLevel target_level(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                         std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement) {
  return inserted.lesions.empty()
             ? TargetLevel{}
             : Looks(tissue, view, inserted, depth_below_skin_mm, displacement).level(inserted.lesions.front());
}

}  // namespace seldinger::imaging
