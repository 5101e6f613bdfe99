#include "assessment/procedure/deeds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "assessment/metrics/tables.h"
#include "assessment/signals/breath_holds.h"
#include "assessment/signals/signals.h"
#include "sim/base/vectors.h"
#include "sim/case/introducer.h"

namespace seldinger::assessment {
namespace {

using cases::Introducer;
using When = std::optional<double>;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kAskedSeconds = 0.1;  // between two questions for the skin: a hand is no faster
constexpr double kSkinAboutMm = 8.0;   // the skin's slope is that of its neighbourhood, not of one triangle

// The pose that held at a time; the first one before.
std::size_t pose_at(const Signals& signals, double t_s) {
  const auto after = std::upper_bound(signals.poses.begin(), signals.poses.end(), t_s + kTimeTolerance_s,
                                      [](double t, const cases::PoseSample& pose) { return t < pose.t_s; });
  return after == signals.poses.begin() ? 0 : static_cast<std::size_t>(after - signals.poses.begin()) - 1;
}

// Whether what was walked lately had a way out and back of `least` or more, in places kApart of it apart.
class ToAndFro {
 public:
  explicit ToAndFro(double least) : least_(least) {}
  void forget() { places_.clear(); }
  bool add(double t_s, double moved) {
    at_ += moved;
    if (!places_.empty() && std::abs(at_ - places_.back().at) < kApart * least_) return false;
    std::erase_if(places_, [&](const Place& place) { return place.t_s < t_s - kTestSeconds; });
    places_.push_back({t_s, at_});
    double low = at_, high = at_;  // of the places up to one
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double turned = places_[i].at;
      low = i == 0 ? turned : std::min(low, turned);
      high = i == 0 ? turned : std::max(high, turned);
      if (std::min(turned - low, turned - at_) >= least_ || std::min(high - turned, at_ - turned) >= least_)
        return true;
    }
    return false;
  }

 private:
  static constexpr double kApart = 0.05;
  struct Place {
    double t_s, at;
  };
  double least_, at_ = 0.0;
  std::vector<Place> places_;
};

// The unit normal of the skin about a point.
glm::dvec3 skin_normal(const cases::MeshIndex& skin, const glm::dvec3& at_lps_mm) {
  const glm::dvec3 middle = skin.normal(skin.closest_skin(at_lps_mm).triangle);
  const auto [u, v] = base::perpendiculars(middle);
  glm::dvec3 sum = middle;
  for (const glm::dvec3& beside : {u, -u, v, -v})
    sum += skin.normal(skin.closest_skin(at_lps_mm + kSkinAboutMm * beside).triangle);
  return glm::dot(sum, sum) > 0.0 ? glm::normalize(sum) : middle;
}

double angle_to_skin_deg(const glm::dvec3& direction, const glm::dvec3& normal) {
  return std::asin(std::min(1.0, std::abs(glm::dot(direction, normal)))) * kDegrees;
}

// Whether a picture that was made `t_s` showed the target at that depth below the face.
bool shows_target_at(const Signals& signals, const cases::FrameTruth& frame, double depth_mm) {
  if (!frame.live || !frame.target) return false;
  const cases::PoseSample& pose = signals.poses[pose_at(signals, frame.t_s)];
  const cases::Lesion& target = *signals.setting.target;
  const double is_mm = glm::dot(target.center_lps_mm - pose.probe_origin_lps_mm, pose.probe_axial);
  const bool moves = signals.setting.breathes || signals.setting.yields;
  return std::abs(depth_mm - is_mm) <= target.radius_mm + (moves ? kMovedMm : kMeasuredMm);
}

// Of one hold that began with the needle in tissue: when a live picture showed the tip first since, and when the
// hand had pushed the needle on by over kUncheckedMm or pulled the trigger. The needle out of the body ends both.
struct HoldCheck {
  BreathHold hold;
  When seen_s, on_s;
  bool unseen() const noexcept {
    return hold.to_s - hold.from_s >= kCheckSeconds && !(seen_s && *seen_s <= hold.to_s + kTimeTolerance_s) &&
           !(on_s && *on_s <= hold.to_s + kTimeTolerance_s);
  }
  bool seen_before_on() const noexcept { return seen_s && !(on_s && *on_s < *seen_s); }
};

HoldCheck check_of(const Signals& signals, const BreathHold& hold, std::size_t first) {
  HoldCheck check{hold, {}, {}};
  double end_s = signals.poses.back().t_s;
  for (std::size_t i = first; i < signals.poses.size(); ++i) {
    if (!signals.passages[i].in_body) {
      end_s = signals.poses[i].t_s;
      break;
    }
    if (!check.on_s && signals.pushed_mm[i] - signals.pushed_mm[first] > kUncheckedMm)
      check.on_s = signals.poses[i].t_s;
  }
  if (signals.endpoint && signals.endpoint->t_s >= hold.from_s && signals.endpoint->t_s <= end_s + kTimeTolerance_s)
    check.on_s = std::min(check.on_s.value_or(signals.endpoint->t_s), signals.endpoint->t_s);
  for (const cases::FrameTruth& frame : signals.frames) {
    if (frame.t_s <= hold.from_s + kTimeTolerance_s || !frame.live || !frame.needle_tip) continue;
    if (frame.t_s < end_s + kTimeTolerance_s) check.seen_s = frame.t_s;
    break;
  }
  return check;
}

// What an introducer is from when on, by what was said; the first is of before all.
struct IntroducerFrom {
  double t_s = 0.0;
  Introducer is = Introducer::none;
};
std::vector<IntroducerFrom> introducer_course(const Signals& signals) {
  std::vector<IntroducerFrom> course = {{-std::numeric_limits<double>::infinity()}};
  if (signals.setting.instrument.kind != cases::InstrumentKind::core || signals.poses.empty()) return course;
  for (const cases::Event& event : *signals.events) {
    const bool in_body = signals.passages[pose_at(signals, event.t_s)].in_body;
    const Introducer is = cases::introducer_after(event.kind, in_body, course.back().is);
    if (is != course.back().is) course.push_back({event.t_s, is});
  }
  return course;
}

}  // namespace

std::optional<double> orientation_tested_s(const Signals& signals, double on_skin_mm) {
  const cases::MeshIndex& skin = *signals.setting.skin;
  ToAndFro slid(kSlideMm), rocked(kRockDeg);
  std::uint32_t hint = 0;
  double asked_s = -1e300;
  bool on_skin = false;
  const cases::PoseSample* before = nullptr;
  std::size_t next_frame = 0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::PoseSample& pose = signals.poses[i];
    while (next_frame < signals.frames.size() && signals.frames[next_frame].t_s <= pose.t_s + kTimeTolerance_s)
      ++next_frame;
    const cases::FrameTruth* picture = next_frame > 0 ? &signals.frames[next_frame - 1] : nullptr;
    if (pose.t_s - asked_s >= kAskedSeconds - kTimeTolerance_s) {
      asked_s = pose.t_s;
      const cases::Closest near = skin.closest(pose.probe_origin_lps_mm, hint);
      hint = near.triangle;
      on_skin = near.distance_mm <= on_skin_mm;  // however far a hand presses it in
    }
    const bool looked = picture != nullptr && picture->live && pose.t_s - picture->t_s <= kPictureSeconds;
    if (!on_skin || !looked || (i > 0 && signals.gap(i - 1))) {
      before = nullptr;
      slid.forget();
      rocked.forget();
    }
    if (!on_skin || !looked) continue;
    double slid_mm = 0.0, rocked_deg = 0.0;
    if (before != nullptr) {
      slid_mm = glm::dot(pose.probe_origin_lps_mm - before->probe_origin_lps_mm, before->probe_lateral);
      rocked_deg = std::atan2(glm::dot(pose.probe_axial, before->probe_lateral),
                              glm::dot(pose.probe_axial, before->probe_axial)) *
                   kDegrees;
    }
    before = &pose;
    const bool slid_so = slid.add(pose.t_s, slid_mm), rocked_so = rocked.add(pose.t_s, rocked_deg);
    if (slid_so || rocked_so) return pose.t_s;
  }
  return std::nullopt;
}

std::optional<double> depth_measured_s(const Signals& signals) {
  for (const cases::Event& event : *signals.events) {
    const auto depth_mm = event.length_mm();
    if (event.kind != cases::EventKind::depth_measured || !depth_mm) continue;
    bool last = true;  // a frozen picture is the last live one, however long ago that was
    for (auto frame = signals.frames.rbegin(); frame != signals.frames.rend(); ++frame) {
      if (frame->t_s > event.t_s + kTimeTolerance_s || !frame->live) continue;
      if (!last && frame->t_s < event.t_s - kPictureSeconds) break;
      if (shows_target_at(signals, *frame, *depth_mm)) return event.t_s;
      last = false;
    }
  }
  return std::nullopt;
}

std::optional<double> angle_kept_s(const Signals& signals) {
  const PunctureCounts counts = count_punctures(signals);
  if (!counts.first_s) return std::nullopt;
  const glm::dvec3 normal = skin_normal(*signals.setting.skin, signals.passages[counts.first_pose].entry_lps_mm);
  const double is_deg = angle_to_skin_deg(signals.poses[counts.first_pose].needle_direction, normal),
               planned_deg = angle_to_skin_deg(signals.setting.plan->direction, normal);
  return std::abs(is_deg - planned_deg) <= kAngleDeg ? counts.first_s : std::nullopt;
}

std::optional<double> planned_depth_kept_s(const Signals& signals) {
  const When punctured_s = count_punctures(signals).first_s;
  if (!punctured_s || !signals.endpoint) return std::nullopt;
  When planned_mm;
  for (const cases::Event& event : *signals.events)
    if (event.kind == cases::EventKind::note_plan && event.t_s <= *punctured_s) planned_mm = event.length_mm();
  const double is_mm = signals.inserted_mm(pose_at(signals, signals.endpoint->t_s));
  return planned_mm && std::abs(is_mm - *planned_mm) <= kPlannedDepthMm ? When(signals.endpoint->t_s)
                                                                        : std::nullopt;
}

std::optional<double> introducer_used_s(const Signals& signals) {
  const std::vector<IntroducerFrom> course = introducer_course(signals);
  for (std::size_t i = 0, at = 0; i < signals.poses.size(); ++i) {
    while (at + 1 < course.size() && course[at + 1].t_s <= signals.poses[i].t_s) ++at;
    if (course[at].is == Introducer::closed && signals.passages[i].in_body) return signals.poses[i].t_s;
  }
  return std::nullopt;
}

std::optional<double> stylet_exchanged_s(const Signals& signals) {
  const cases::Shape target = cases::shape_of(*signals.setting.target);
  for (const IntroducerFrom& one : introducer_course(signals)) {
    if (one.is != Introducer::open) continue;
    const glm::dvec3& tip_lps_mm = signals.poses[pose_at(signals, one.t_s)].tip_at_rest_lps_mm();
    if (cases::signed_distance_mm(target, tip_lps_mm, kExchangeMm + 1.0) <= kExchangeMm) return one.t_s;
  }
  return std::nullopt;
}

std::optional<double> fired_on_stylet_s(const Signals& signals) {
  if (!signals.endpoint) return std::nullopt;
  Introducer is = Introducer::none;
  for (const IntroducerFrom& one : introducer_course(signals))
    if (one.t_s <= signals.endpoint->t_s) is = one.is;
  return is == Introducer::closed ? std::optional(signals.endpoint->t_s) : std::nullopt;
}

BreathChecks breath_checks(const Signals& signals) {
  BreathChecks checks;
  for (const BreathHold& hold : breath_holds(signals)) {
    const std::size_t first = pose_at(signals, hold.from_s);
    if (!signals.passages[first].in_body) continue;
    const HoldCheck check = check_of(signals, hold, first);
    const bool seen_first = check.seen_before_on();
    if (check.on_s && !seen_first && *check.on_s <= hold.to_s + kTimeTolerance_s && !checks.on_unchecked_s)
      checks.on_unchecked_s = check.on_s;
    if (!check.unseen()) continue;
    if (!checks.unseen_s) {
      checks.unseen_s = hold.to_s;
      if (seen_first) checks.found_again_s = check.seen_s;
    }
    if (check.on_s && !seen_first && !checks.on_unfound_s) checks.on_unfound_s = check.on_s;
  }
  return checks;
}

}  // namespace seldinger::assessment
