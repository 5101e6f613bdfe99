// One look at a needle and a target: the levels that visible.h tells of, of one face.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/visible.h"

namespace seldinger::imaging {

double power_of(double db) noexcept;
double decibels_of(double power) noexcept;  // not below −400

class Sight {
 public:
  // What it is given outlives it. One thread's.
  Sight(const TissueAt& tissue_at, const UltrasoundView& view, std::span<const float> depth_below_skin_mm,
        const tissue::Displacement& displacement);

  // Where a point lies in the picture. Nobody asks for the beam of what lies too near or too deep: NaN.
  struct Place {
    double beam, depth_mm, off_plane_mm;
  };
  Place place(const glm::dvec3& p_lps_mm) const noexcept;
  // The same borders as the screen's (ScanConverter); not with NaN.
  bool in_field(const Place& at) const noexcept {
    return at.beam >= -0.5 && at.beam <= view_.beams - 0.5 && at.depth_mm >= 0.0 && at.depth_mm <= view_.depth_mm;
  }
  bool touches(const Place& at) const noexcept { return beam_touches(view_, below_skin_mm_, at.beam); }
  bool in_slice(const Place& at, double more_mm) const noexcept {
    return std::abs(at.off_plane_mm) <= more_mm + 0.5 * slice_mm(at.depth_mm);
  }
  double made_up_db(double depth_mm) const noexcept;  // by the scanner, for depth

  // A needle at a place of the field, on its shaft or at its tip, and what lies about it there: mean squares before
  // the way takes its share, and what lies over all echoes.
  struct Glance {
    Place at;
    Fan::Way way;
    double echo, scatter, over_all;
    bool adds_up;                     // speckle and what lies over it; else the larger is the background
    std::optional<double> loss_db{};  // none: nobody has walked down to it yet
    // Speckle alone hides it, whatever is lost on the way.
    bool is_in_speckle() const noexcept { return decibels_of(echo) < decibels_of(scatter) + kNeedleAboveDb; }
    // By how much its power stands above what is asked for, where so much of what is there comes through; between
    // what that lies as far as is known; and of what it is the difference at most, which says how it rounds.
    double spare(double through) const noexcept;
    struct Range {
      double least, most;
    };
    Range range() const noexcept;
    double size() const noexcept;
  };
  Glance glance(const NeedlePose& needle, const Place& at, bool tip) const;
  // Places that glance() or walk_to() will be asked about: where tissue moves, its way back is found sooner for all
  // of them at once.
  void get_ready(std::span<const Place> to_glance) const;
  void get_ready_to_walk(std::span<const Place> down_to) const;
  void walk_to(Glance& glance) const {
    if (!glance.loss_db) glance.loss_db = loss_db(glance.way, glance.at.beam, glance.at.depth_mm);
  }
  static NeedleLevel level(const Glance& walked) noexcept;

  // Of a target whose middle is there now (docs/decisions/0013 and 0057).
  TargetLevel level(const cases::Lesion& target, const Place& at) const;

 private:
  double slice_mm(double depth_mm) const noexcept {
    return elevation_fwhm_mm(view_.probe, frequency_mhz_, depth_mm);
  }
  double slice_sigma_mm(double depth_mm) const noexcept;
  double beams_of(double across_mm, double depth_mm) const noexcept {
    return across_mm / fan_.beam_spacing_mm(depth_mm);
  }
  double loss_db(double beam, double depth_mm) const { return loss_db(fan_.way(beam), beam, depth_mm); }
  double loss_db(const Fan::Way& way, double beam, double depth_mm) const;
  double scatter(const Fan::Way& way, double beam, double depth_mm) const;
  double scatter_around(const Fan::Way& way, const Place& at) const;
  double needle_amplitude(const NeedlePose& needle, const Fan::Way& way, const Place& at, bool tip) const;
  double drawn(double amplitude, double across, double off_plane = 1.0) const noexcept;
  double over_all(double depth_mm) const noexcept;
  double cells_of(double radius_mm, const Place& at) const noexcept;
  double share_of_slice(double radius_mm, const Place& at) const noexcept;
  void look_at_rim(const cases::Lesion& target, const cases::LesionEcho& echo, const Place& at, double through,
                   double beside_lossless, double besides_db, TargetLevel& level) const;

  const UltrasoundView& view_;
  Fan fan_;
  const TissueAt& tissue_at_;
  AcousticTable table_;
  std::array<double, volume::kTissueClasses> loss_db_mm_;
  std::span<const float> below_skin_mm_;
  double frequency_mhz_;
  std::optional<RestFan> at_rest_;         // where tissue moves
  mutable std::vector<double> depths_mm_;  // of a walk, and what lies there
  mutable std::vector<volume::TissueClass> tissue_;
  mutable std::vector<RestFan::Box> boxes_;
};

}  // namespace seldinger::imaging
