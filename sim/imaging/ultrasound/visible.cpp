#include "sim/imaging/ultrasound/visible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <vector>

#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/needle_echo.h"
#include "sim/imaging/ultrasound/sight.h"

namespace seldinger::imaging {
namespace {

using Place = Sight::Place;

constexpr double kNearMm = 2.0, kLessNearMm = 5.0;  // of the geometric rules (recording.h)
// Of numbers that were found in another order: more than a logarithm and its power can be off by.
constexpr double kRounding = 1e-9;

// The looks of a picture: one, or of a compounded view those whose mean square is shown.
class Looks {
 public:
  Looks(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
        std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement)
      : view_(view), displacement_(displacement), tissue_at_(tissue, inserted) {
    const int count = view.compound_deg > 0.0 ? kLooks : 1;
    looks_.reserve(kLooks);
    for (int i = 0; i < count; ++i) {
      UltrasoundView& one = views_[static_cast<std::size_t>(i)] = look_of(view, i);
      looks_.emplace_back(tissue_at_, one, depth_below_skin_mm, displacement);
    }
  }
  Looks(const Looks&) = delete;
  Looks& operator=(const Looks&) = delete;
  const Sight& middle() const { return looks_.front(); }
  // Of what is told at rest.
  glm::dvec3 now_lps_mm(const glm::dvec3& rest_lps_mm) const {
    return tissue::count_sources(displacement_) > 0 ? tissue::displaced(displacement_, rest_lps_mm) : rest_lps_mm;
  }

  // At a place in the field of the middle one.
  bool needle_stands_out(const NeedlePose& needle, const glm::dvec3& p_lps_mm, const Place& in_middle,
                         bool tip) const {
    Glances glances = look_at(needle, p_lps_mm, in_middle, tip);
    if (const std::optional<bool> settled = settled_by_few(glances)) return *settled;
    const auto hides = [](const Glances::value_type& one) { return !one || one->is_in_speckle(); };
    return !std::all_of(glances.begin(), glances.end(), hides) && mean_of(glances).stands_out();
  }

  double visible_shaft_mm(const NeedlePose& needle) const {
    const int steps = std::clamp(static_cast<int>(std::ceil(needle.length_mm / kShaftStepMm)), 1, 1000);
    const double step_mm = needle.length_mm / steps;
    const glm::dvec3 along = glm::normalize(needle.direction);
    int seen = 0;
    for (int i = 0; i < steps; ++i) {
      const glm::dvec3 p = needle.tip_lps_mm - ((i + 0.5) * step_mm) * along;
      const Place in_middle = middle().place(p);
      seen += middle().in_field(in_middle) && needle_stands_out(needle, p, in_middle, false) ? 1 : 0;
    }
    return seen * step_mm;
  }

  NeedleLevel level(const NeedlePose& needle, const glm::dvec3& p_lps_mm, bool tip) const {
    const Place in_middle = middle().place(p_lps_mm);
    if (middle().in_field(in_middle)) {
      Glances glances = look_at(needle, p_lps_mm, in_middle, tip);
      return mean_of(glances);
    }
    NeedleLevel none;
    none.off_plane_mm = in_middle.off_plane_mm;
    return none;
  }

  // Speckle is evened out by as many looks as see the target, whose middle is at a place now.
  TargetLevel level(const cases::Lesion& target, const glm::dvec3& p_lps_mm) const {
    const Place in_middle = middle().place(p_lps_mm);
    TargetLevel mean = middle().level(target, in_middle);
    if (looks_.size() == 1 || !mean.in_field) return mean;
    double through = 0.0, contrast = 0.0;
    int count = 0;
    for (const Sight& look : looks_) {
      const TargetLevel one = &look == &middle() ? mean : look.level(target, look.place(p_lps_mm));
      if (!one.in_field) continue;
      through += power_of(one.transmission_db);
      contrast += power_of(one.contrast_db);
      ++count;
    }
    mean.transmission_db = decibels_of(through / count);
    mean.contrast_db = decibels_of(contrast / count);
    mean.cells *= independent_looks(view_, in_middle.depth_mm, count);
    return mean;
  }

 private:
  using Glances = std::array<std::optional<Sight::Glance>, kLooks>;  // of the looks that show a place
  // In the field of the middle one; the others as the compounder lays them over it (Compounder::mean), which shows
  // nothing else where the middle one stands in air.
  Glances look_at(const NeedlePose& needle, const glm::dvec3& p_lps_mm, const Place& in_middle, bool tip) const {
    Glances glances;
    glances.front() = middle().glance(needle, in_middle, tip);
    if (looks_.size() == 1 || !middle().touches(in_middle)) return glances;
    for (std::size_t i = 1; i < looks_.size(); ++i) {
      const Place at = looks_[i].place(p_lps_mm);
      if (looks_[i].in_field(at) && looks_[i].touches(at)) glances[i] = looks_[i].glance(needle, at, tip);
    }
    return glances;
  }
  NeedleLevel mean_of(Glances& glances) const {
    double echo = 0.0, background = 0.0, count = 0.0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (!glances[i]) continue;
      looks_[i].walk_to(*glances[i]);
      const NeedleLevel one = Sight::level(*glances[i]);
      const double less_db = begun_db(glances[i]->at, glances.front()->at);
      echo += power_of(one.echo_db - less_db);
      background += power_of(one.background_db - less_db);
      count += 1.0;
    }
    NeedleLevel mean = Sight::level(*glances.front());
    if (looks_.size() == 1 || !middle().touches(glances.front()->at)) return mean;
    mean.echo_db = decibels_of(echo / count);
    mean.background_db = decibels_of(background / count);
    return mean;
  }
  // Whether the mean of what they show stands out, beams being walked down one by one, that first of which most
  // hangs, until what is not known of the others changes nothing. Nothing where it is a matter of rounding.
  std::optional<bool> settled_by_few(Glances& glances) const {
    std::array<double, kLooks> share{};
    double rounding = 0.0;
    for (std::size_t i = 0; i < glances.size(); ++i) {
      if (!glances[i]) continue;
      share[i] = i == 0 ? 1.0 : power_of(-begun_db(glances[i]->at, glances.front()->at));
      rounding += kRounding * share[i] * glances[i]->size();
    }
    for (;;) {
      double least = 0.0, most = 0.0, widest = 0.0;
      std::size_t next = glances.size();
      for (std::size_t i = 0; i < glances.size(); ++i) {
        if (!glances[i]) continue;
        const Sight::Glance::Range spare = glances[i]->range();
        least += share[i] * spare.least;
        most += share[i] * spare.most;
        const double width = share[i] * (spare.most - spare.least);
        if (width > widest) widest = width, next = i;
      }
      if (least > rounding) return true;
      if (most < -rounding) return false;
      if (next == glances.size()) return std::nullopt;
      looks_[next].walk_to(*glances[next]);
    }
  }
  // What a look is lowered by where it is laid over the middle one, because it begins deeper.
  double begun_db(const Place& look, const Place& in_middle) const {
    return middle().made_up_db(std::max(0.0, in_middle.depth_mm - look.depth_mm));
  }
  const UltrasoundView& view_;
  const tissue::Displacement& displacement_;
  TissueAt tissue_at_;
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
      seen.visible.needle_tip = in_reach && looks.needle_stands_out(*needle, needle->tip_lps_mm, tip, true);
    }
    seen.visible.needle_length_mm = looks.visible_shaft_mm(*needle);
  }
  if (!inserted.lesions.empty()) {
    const cases::Lesion& target = inserted.lesions.front();
    const glm::dvec3 center_lps_mm = looks.now_lps_mm(target.center_lps_mm);
    const Place center = sight.place(center_lps_mm);
    if (sight.in_field(center)) {
      seen.near_plane.target_2_mm = std::abs(center.off_plane_mm) <= kNearMm;
      seen.near_plane.target_5_mm = std::abs(center.off_plane_mm) <= kLessNearMm;
      if (sight.in_slice(center, target.radius_mm)) {
        const TargetLevel level = looks.level(target, center_lps_mm);
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
  if (inserted.lesions.empty()) return {};
  const Looks looks(tissue, view, inserted, depth_below_skin_mm, displacement);
  const cases::Lesion& target = inserted.lesions.front();
  return looks.level(target, looks.now_lps_mm(target.center_lps_mm));
}

}  // namespace seldinger::imaging
