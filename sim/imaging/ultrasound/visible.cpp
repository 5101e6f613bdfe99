#include "sim/imaging/ultrasound/visible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
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

  // At how many of these places of the needle it does.
  int stands_out(const NeedlePose& needle, std::span<const glm::dvec3> places_lps_mm, bool tip) const {
    std::vector<Glances> all = look_at(needle, places_lps_mm, tip);
    std::vector<std::size_t> open(all.size());  // not settled yet
    std::iota(open.begin(), open.end(), std::size_t{0});
    int count = 0;
    while (!open.empty()) {
      std::vector<std::pair<std::size_t, std::size_t>> to_walk;  // of which, that look
      for (const std::size_t n : open) {
        const Settling now = settle(all[n]);
        if (now.next)
          to_walk.emplace_back(n, *now.next);
        else
          count += (now.stands_out ? *now.stands_out : stands_out_at_all(all[n])) ? 1 : 0;
      }
      for (std::size_t i = 0; i < looks_.size(); ++i) {
        std::vector<Place> down_to;
        for (const auto& [n, look] : to_walk)
          if (look == i) down_to.push_back(all[n][i]->at);
        looks_[i].get_ready_to_walk(down_to);
      }
      open.clear();
      for (const auto& [n, look] : to_walk) {
        looks_[look].walk_to(*all[n][look]);
        open.push_back(n);
      }
    }
    return count;
  }

  double visible_shaft_mm(const NeedlePose& needle) const {
    const int steps = std::clamp(static_cast<int>(std::ceil(needle.length_mm / kShaftStepMm)), 1, 1000);
    const double step_mm = needle.length_mm / steps;
    const glm::dvec3 along = glm::normalize(needle.direction);
    std::vector<glm::dvec3> places_lps_mm;
    for (int i = 0; i < steps; ++i) places_lps_mm.push_back(needle.tip_lps_mm - ((i + 0.5) * step_mm) * along);
    return stands_out(needle, places_lps_mm, false) * step_mm;
  }

  NeedleLevel level(const NeedlePose& needle, const glm::dvec3& p_lps_mm, bool tip) const {
    const Place in_middle = middle().place(p_lps_mm);
    if (middle().in_field(in_middle)) {
      Glances glances = look_at(needle, places_of(p_lps_mm, in_middle), tip);
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
  using Places = std::array<std::optional<Place>, kLooks>;
  // Of one in the field of the middle one; the others as the compounder lays them over it (Compounder::mean), which
  // shows nothing else where the middle one stands in air.
  Places places_of(const glm::dvec3& p_lps_mm, const Place& in_middle) const {
    Places places{in_middle};
    if (looks_.size() == 1 || !middle().touches(in_middle)) return places;
    for (std::size_t i = 1; i < looks_.size(); ++i) {
      const Place at = looks_[i].place(p_lps_mm);
      if (looks_[i].in_field(at) && looks_[i].touches(at)) places[i] = at;
    }
    return places;
  }
  Glances look_at(const NeedlePose& needle, const Places& places, bool tip) const {
    Glances glances;
    for (std::size_t i = 0; i < looks_.size(); ++i)
      if (places[i]) glances[i] = looks_[i].glance(needle, *places[i], tip);
    return glances;
  }
  // Of those of the places that lie in the field of the middle one.
  std::vector<Glances> look_at(const NeedlePose& needle, std::span<const glm::dvec3> places_lps_mm,
                               bool tip) const {
    std::vector<Places> places;
    for (const glm::dvec3& p_lps_mm : places_lps_mm) {
      const Place in_middle = middle().place(p_lps_mm);
      if (middle().in_field(in_middle)) places.push_back(places_of(p_lps_mm, in_middle));
    }
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      std::vector<Place> to_glance;
      for (const Places& at : places)
        if (at[i]) to_glance.push_back(*at[i]);
      looks_[i].get_ready(to_glance);
    }
    std::vector<Glances> all;
    all.reserve(places.size());
    for (const Places& at : places) all.push_back(look_at(needle, at, tip));
    return all;
  }
  // Where all is known.
  bool stands_out_at_all(Glances& glances) const {
    const auto hides = [](const Glances::value_type& one) { return !one || one->is_in_speckle(); };
    return !std::all_of(glances.begin(), glances.end(), hides) && mean_of(glances).stands_out();
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
  // Whether the mean of what they show stands out, as far as what is not known of them leaves it open: then the
  // beam of that look is walked down next on which it most hangs. Neither: all is known, and it is a matter of
  // rounding.
  struct Settling {
    std::optional<bool> stands_out;
    std::optional<std::size_t> next;
  };
  Settling settle(const Glances& glances) const {
    double least = 0.0, most = 0.0, widest = 0.0, rounding = 0.0;
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < glances.size(); ++i) {
      if (!glances[i]) continue;
      const double share = i == 0 ? 1.0 : power_of(-begun_db(glances[i]->at, glances.front()->at));
      const Sight::Glance::Range spare = glances[i]->range();
      rounding += kRounding * share * glances[i]->size();
      least += share * spare.least;
      most += share * spare.most;
      const double width = share * (spare.most - spare.least);
      if (width > widest) widest = width, next = i;
    }
    if (least > rounding) return {true, {}};
    if (most < -rounding) return {false, {}};
    return {{}, next};
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
      seen.visible.needle_tip = in_reach && looks.stands_out(*needle, {&needle->tip_lps_mm, 1}, true) > 0;
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
