#include "assessment/procedure/evidence.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/metrics/tables.h"
#include "assessment/procedure/deeds.h"
#include "assessment/signals/breath_holds.h"
#include "assessment/signals/signals.h"
#include "sim/base/check.h"
#include "sim/case/c_arm.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;
using When = std::optional<double>;

// Judgement, all of them: how near counts as there, and how long after as because of it.
constexpr double kProbeOnSkinMm = 15.0;  // its middle from the skin: a curved face is pressed in by up to 10
constexpr double kAtSkinMm = 5.0;
constexpr double kAtEdgeMm = 5.0;  // thesis, step 10: a core needle stops at the target's edge
constexpr double kAspirationSeconds = 15.0;
constexpr double kBlindRunMm = 5.0;  // docs/clinical.md, "Common"
constexpr double kJiggleMostMm = 5.0, kJiggleSeconds = 2.0;
constexpr double kReactSeconds = 1.0, kTroubleSeconds = 3.0, kTroubleMm = 2.0;
constexpr double kPushMm = 2.0;                        // so far in breath is no slip of the hand
constexpr double kLossNoticedSeconds = 1.0;            // until then a lost breath is nobody's fault
constexpr double kAlongDeg = 10.0, kAcrossDeg = 30.0;  // docs/clinical.md, case 6: views at least 30° apart

template <EventKind kind>
When event(const Signals& signals) {
  for (const cases::Event& one : *signals.events)
    if (one.kind == kind) return one.t_s;
  return std::nullopt;
}

When earlier(When a, When b) {
  return !a || (b && *b < *a) ? b : a;
}

When decided(const Signals& signals) {
  return earlier(event<EventKind::proceed>(signals), event<EventKind::defer>(signals));
}

When anaesthetised_unaspirated(const Signals& signals) {
  double aspirated_s = -1e300;
  for (const cases::Event& one : *signals.events) {
    if (one.kind == EventKind::aspirate) aspirated_s = one.t_s;
    if (one.kind == EventKind::anaesthetic && one.t_s - aspirated_s > kAspirationSeconds) return one.t_s;
  }
  return std::nullopt;
}

template <typename Is>
When first_pose(const Signals& signals, const Is& is) {
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (is(i)) return signals.poses[i].t_s;
  return std::nullopt;
}

// Calls back with each live frame and the pose that held when it was made.
template <typename Is>
When first_frame(const Signals& signals, const Is& is) {
  std::size_t pose = 0;
  for (const cases::FrameTruth& frame : signals.frames) {
    while (pose + 1 < signals.poses.size() && signals.poses[pose + 1].t_s <= frame.t_s) ++pose;
    if (frame.live && is(frame, pose)) return frame.t_s;
  }
  return std::nullopt;
}

When probe_on_skin(const Signals& signals) {
  const cases::MeshIndex& skin = *signals.setting.skin;
  std::uint32_t hint = 0;
  double asked_s = -1e300;
  return first_pose(signals, [&](std::size_t i) {
    if (signals.poses[i].t_s - asked_s < 0.1 - kTimeTolerance_s) return false;  // a hand is no faster
    asked_s = signals.poses[i].t_s;
    const cases::Closest near = skin.closest(signals.poses[i].probe_origin_lps_mm, hint);
    hint = near.triangle;
    return std::abs(near.distance_mm) <= kProbeOnSkinMm;
  });
}

When needle_at_skin(const Signals& signals) {
  return first_pose(signals, [&](std::size_t i) { return signals.passages[i].depth_mm >= -kAtSkinMm; });
}

When punctured(const Signals& signals) {
  return count_punctures(signals).first_s;
}

// Two turns of the hand along the shaft, in tissue, by more than kJiggleMm and no more than a jiggle.
When jiggled(const Signals& signals) {
  double turned_mm = 0.0, turned_s = -1e300, far_mm = 0.0, far_s = 0.0;
  int way = 0;  // which way it has been going since the last turn
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    if (!signals.passages[i].in_body || (i > 0 && signals.gap(i - 1))) {
      way = 0;
      turned_s = -1e300;
      continue;
    }
    const double now_mm = signals.pushed_mm[i], now_s = signals.poses[i].t_s;
    if (way == 0) {
      way = 1;
      far_mm = turned_mm = now_mm;
      far_s = now_s;
    }
    if ((now_mm - far_mm) * way >= 0.0) {
      far_mm = now_mm;
      far_s = now_s;
    } else if ((far_mm - now_mm) * way >= kJiggleMm) {  // it has turned at far_mm
      const double swing_mm = std::abs(far_mm - turned_mm);
      if (far_s - turned_s <= kJiggleSeconds && swing_mm >= kJiggleMm && swing_mm <= kJiggleMostMm) return now_s;
      turned_mm = far_mm;
      turned_s = far_s;
      far_mm = now_mm;
      far_s = now_s;
      way = -way;
    }
  }
  return std::nullopt;
}

When at_target(const Signals& signals) {
  const cases::Shape target = cases::shape_of(*signals.setting.target);
  const double near_mm = signals.setting.instrument.kind == cases::InstrumentKind::core ? kAtEdgeMm : 0.0;
  return first_pose(signals, [&](std::size_t i) {
    return signals.passages[i].in_body &&
           cases::signed_distance_mm(target, signals.poses[i].tip_at_rest_lps_mm(), near_mm + 1.0) <= near_mm;
  });
}

When fired(const Signals& signals) {
  return signals.endpoint ? When(signals.endpoint->t_s) : std::nullopt;
}

// How far the needle came deeper from kReactSeconds after an event of a mentor's on, for kTroubleSeconds.
template <bool going_on>
When in_trouble(const Signals& signals) {
  for (const cases::Event& one : *signals.events) {
    const cases::EventInfo* info = cases::find_event(one.kind);
    if (info == nullptr || info->source != cases::EventSource::mentor) continue;
    const double from_s = one.t_s + kReactSeconds, to_s = from_s + kTroubleSeconds;
    double advance_mm = 0.0;
    for (std::size_t i = 0; i < signals.poses.size(); ++i)
      if (signals.poses[i].t_s > from_s && signals.poses[i].t_s <= to_s) advance_mm += signals.advance_mm[i];
    if ((advance_mm > kTroubleMm) == going_on) return from_s;
  }
  return std::nullopt;
}

// When the hand had pushed the tip on by over kPushMm on the last of its way, of what counts.
template <typename Counts>
When pushed_on(const Signals& signals, const Counts& counts) {
  const std::vector<double> pushed_mm = pushed_on_last_way_mm(signals);
  double sum_mm = 0.0;
  return first_pose(signals, [&](std::size_t i) {
    if (counts(signals.poses[i].t_s)) sum_mm += pushed_mm[i];
    return sum_mm > kPushMm;
  });
}
When pushed_in_hold(const Signals& signals) {
  const std::vector<BreathHold> holds = breath_holds(signals);
  return pushed_on(signals, [&](double t_s) { return held_at(holds, t_s, kLossNoticedSeconds); });
}
When pushed_in_breath(const Signals& signals) {
  const std::vector<BreathHold> holds = breath_holds(signals);
  return pushed_on(signals, [&](double t_s) { return !held_at(holds, t_s, kLossNoticedSeconds); });
}
When fired_in_breath(const Signals& signals) {
  if (!signals.endpoint) return std::nullopt;
  return held_at(breath_holds(signals), signals.endpoint->t_s) ? std::nullopt : When(signals.endpoint->t_s);
}

When target_seen(const Signals& signals) {
  return first_frame(signals, [](const cases::FrameTruth& frame, std::size_t) { return frame.target; });
}
When tip_seen(const Signals& signals) {
  return first_frame(signals, [&](const cases::FrameTruth& frame, std::size_t pose) {
    return frame.needle_tip && signals.passages[pose].in_body;
  });
}
When both_seen(const Signals& signals) {
  return first_frame(signals, [&](const cases::FrameTruth& frame, std::size_t pose) {
    return frame.joint() && signals.passages[pose].in_body;
  });
}

When blind_run(const Signals& signals) {
  return first_blind_run_s(signals, kBlindRunMm);
}

When beyond_plane(const Signals& signals) {
  return first_beyond_plane_s(signals, kBlindRunMm);
}

When fired_unseen(const Signals& signals) {
  if (!signals.endpoint) return std::nullopt;
  const cases::FrameTruth* last = nullptr;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.t_s <= signals.endpoint->t_s) last = &frame;
  return last != nullptr && last->live && last->needle_tip ? std::nullopt : When(signals.endpoint->t_s);
}

When seen_in_breath_hold(const Signals& signals) {
  return first_frame(signals, [&](const cases::FrameTruth& frame, std::size_t pose) {
    bool held = false;
    for (const cases::Event& one : *signals.events) {
      if (one.t_s > frame.t_s) break;
      if (one.kind == EventKind::breath_held) held = true;
      if (one.kind == EventKind::breath_lost || one.kind == EventKind::breathe_again) held = false;
    }
    return held && frame.joint() && signals.passages[pose].in_body;
  });
}

// The angle between the lines of beam and needle, 0 to 90°.
double beam_angle_deg(const Signals& signals, const cases::BeamTruth& beam, std::size_t pose) {
  const glm::dvec3 ray = cases::beam_direction(beam.lao_deg, beam.cranial_deg, signals.setting.position);
  const double cosine = std::min(1.0, std::abs(glm::dot(ray, signals.poses[pose].needle_direction)));
  return std::acos(cosine) * 180.0 / std::numbers::pi;
}

When target_under_beam(const Signals& signals) {
  return first_frame(
      signals, [](const cases::FrameTruth& frame, std::size_t) { return frame.beam.has_value() && frame.target; });
}
When looked_along_needle(const Signals& signals) {
  return first_frame(signals, [&](const cases::FrameTruth& frame, std::size_t pose) {
    return frame.beam && frame.needle_tip && beam_angle_deg(signals, *frame.beam, pose) <= kAlongDeg;
  });
}
When looked_across_needle(const Signals& signals) {
  return first_frame(signals, [&](const cases::FrameTruth& frame, std::size_t pose) {
    return frame.beam && frame.joint() && signals.passages[pose].in_body &&
           beam_angle_deg(signals, *frame.beam, pose) >= kAcrossDeg;
  });
}
When hand_in_beam(const Signals& signals) {
  return first_frame(
      signals, [](const cases::FrameTruth& frame, std::size_t) { return frame.beam && frame.beam->hand_in_beam; });
}

constexpr Needs kSaid = kEvents, kSeen = kPictures;

constexpr EvidenceInfo kEvidence[] = {
    {Evidence::none, "never", 0, [](const Signals&) { return When(); }},
    {Evidence::signed_in, "the trainee said the sign-in", kSaid, &event<EventKind::sign_in>},
    {Evidence::decided, "the trainee said to proceed or to defer", kSaid, &decided},
    {Evidence::deferred, "the trainee said to defer", kSaid, &event<EventKind::defer>},
    {Evidence::probe_checked, "the probe's orientation was checked", kSaid, &event<EventKind::probe_checked>},
    {Evidence::plan_noted, "entry and depth were noted", kSaid, &event<EventKind::note_plan>},
    {Evidence::anaesthetised, "local anaesthetic was given", kSaid, &event<EventKind::anaesthetic>},
    {Evidence::anaesthetised_unaspirated, "anaesthetic was given without aspiration in the 15 s before", kSaid,
     &anaesthetised_unaspirated},
    {Evidence::nicked, "the skin was nicked", kSaid, &event<EventKind::nick>},
    {Evidence::introducer_used, "an introducer went in", kSaid | kSkin, &introducer_used_s},
    {Evidence::breath_hold_asked, "the patient was asked to hold the breath", kSaid,
     &event<EventKind::breath_hold_request>},
    {Evidence::signed_out, "the trainee said the sign-out", kSaid, &event<EventKind::sign_out>},
    {Evidence::skin_pain, "skin that was not numb was punctured", kSaid, &event<EventKind::pain_skin>},
    {Evidence::bone_pain, "the needle met bone", kSaid, &event<EventKind::pain_bone>},
    {Evidence::probe_on_skin, "the middle of the probe's face was within 15 mm of the skin", kSkin, &probe_on_skin},
    {Evidence::orientation_tested,
     "on the skin, with a live picture, the probe was slid along its marker's axis by 10 mm and back, or rocked "
     "likewise by 10°, within 10 s",
     kSeen | kPicturePlane | kSkin,
     [](const Signals& signals) { return orientation_tested_s(signals, kProbeOnSkinMm); }},
    {Evidence::needle_at_skin, "the tip was within 5 mm of the skin, or in it", kSkin, &needle_at_skin},
    {Evidence::punctured, "the skin was first punctured (as skin_punctures counts)", kSkin, &punctured},
    {Evidence::angle_kept, "at the first puncture the needle's angle to the skin was within 15° of the planned one",
     kSkin | kPlan, &angle_kept_s},
    {Evidence::jiggled, "in tissue the hand moved the tip to and fro along the shaft, by 1 to 5 mm and within 2 s",
     kSkin, &jiggled},
    {Evidence::at_target, "the tip was in the target; with a core needle: at most 5 mm from its edge",
     kTarget | kSkin, &at_target},
    {Evidence::stylet_exchanged,
     "its stylet was withdrawn with its tip in tissue, at most 10 mm from the target's edge",
     kSaid | kTarget | kSkin, [](const Signals& signals) { return stylet_exchanged_s(signals); }},
    {Evidence::fired_on_stylet, "the trigger was pressed while the introducer's stylet was in", kSaid | kSkin,
     &fired_on_stylet_s},
    {Evidence::at_planned_depth,
     "at the trigger the needle was in to the depth noted before the first puncture, give or take 10 mm",
     kSaid | kSkin | kCalipers, &planned_depth_kept_s},
    {Evidence::fired, "the trigger was pressed", 0, &fired},
    {Evidence::needle_out, "after the trigger the tip left the skin", kSkin,
     [](const Signals& signals) { return signals.after.needle_out_s; }},
    {Evidence::went_on_in_trouble,
     "from 1 to 4 s after a cough, bleeding or drop of pressure the needle went over 2 mm deeper", kSaid | kSkin,
     &in_trouble<true>},
    {Evidence::stopped_in_trouble,
     "from 1 to 4 s after a cough, bleeding or drop of pressure the needle went at most 2 mm deeper", kSaid | kSkin,
     &in_trouble<false>},
    {Evidence::pushed_in_hold,
     "the tip was pushed on by over 2 mm in the target's organ (none marked: at most 20 mm from the target) while "
     "the breath was held",
     kSaid | kTarget | kSkin, &pushed_in_hold},
    {Evidence::pushed_in_breath,
     "it was pushed on in this way by over 2 mm while the breath moved, not counting the second after a hold was "
     "lost",
     kSaid | kTarget | kSkin, &pushed_in_breath},
    {Evidence::fired_in_breath, "the trigger was pressed while the breath moved", kSaid, &fired_in_breath},
    {Evidence::target_seen, "a live picture showed the target", kSeen | kTarget, &target_seen},
    {Evidence::depth_measured,
     "calipers measured the target's depth in a picture that showed it, give or take 5 mm beyond its edges, 15 mm "
     "where tissue moves",
     kSaid | kSeen | kPicturePlane | kTarget | kCalipers, &depth_measured_s},
    {Evidence::tip_seen, "a live picture showed the tip in tissue", kSeen | kSkin, &tip_seen},
    {Evidence::both_seen, "a live picture showed target and tip in tissue at once", kSeen | kTarget | kSkin,
     &both_seen},
    {Evidence::blind_run, "the tip advanced over 5 mm in tissue from one sight of it to the next",
     kSeen | kSkin | kInPlane, &blind_run},
    {Evidence::beyond_plane,
     "the tip advanced over 5 mm in tissue while it was over 3 mm beyond the picture's plane",
     kPicturePlane | kSkin | kOutOfPlane, &beyond_plane},
    {Evidence::fired_unseen, "the picture before the trigger was not live or did not show the tip", kSeen,
     &fired_unseen},
    {Evidence::seen_in_breath_hold, "a live picture showed target and tip in tissue while the breath was held",
     kSaid | kSeen | kTarget | kSkin, &seen_in_breath_hold},
    {Evidence::on_unchecked,
     "with the needle in tissue the breath was held, and the needle was pushed on by over 2 mm or the trigger was "
     "pressed before a picture of that hold had shown the tip",
     kSaid | kSeen | kSkin, [](const Signals& signals) { return breath_checks(signals).on_unchecked_s; }},
    {Evidence::unseen_in_breath_hold,
     "with the needle at rest in tissue the breath was held for 1 s or more, and no live picture showed the tip",
     kSaid | kSeen | kSkin, [](const Signals& signals) { return breath_checks(signals).unseen_s; }},
    {Evidence::found_again, "after that a live picture showed the tip in tissue before the needle went on",
     kSaid | kSeen | kSkin, [](const Signals& signals) { return breath_checks(signals).found_again_s; }},
    {Evidence::on_unfound,
     "after that the needle was pushed on by over 2 mm, or the trigger was pressed, before a live picture showed "
     "the tip",
     kSaid | kSeen | kSkin, [](const Signals& signals) { return breath_checks(signals).on_unfound_s; }},
    {Evidence::scanned_after, "with the needle out a live picture showed the target", kSeen | kTarget | kSkin,
     [](const Signals& signals) { return signals.after.scanned_s; }},
    {Evidence::target_under_beam, "a pulse showed the target", kSeen | kTarget | kXray, &target_under_beam},
    {Evidence::looked_along_needle, "a pulse showed the tip from within 10° of the needle's line",
     kSeen | kXray | kBeam, &looked_along_needle},
    {Evidence::looked_across_needle,
     "a pulse showed target and tip in tissue from at least 30° off the needle's line",
     kSeen | kXray | kBeam | kTarget | kSkin, &looked_across_needle},
    {Evidence::hand_in_beam, "a pulse met the hand", kSeen | kXray | kBeam, &hand_in_beam},
};

}  // namespace

std::span<const EvidenceInfo> evidence() {
  return kEvidence;
}

const EvidenceInfo& about(Evidence evidence) {
  const EvidenceInfo& info = kEvidence[static_cast<std::size_t>(evidence)];
  CHECK(info.evidence == evidence);
  return info;
}

std::optional<double> first_s(Evidence evidence, const Signals& signals, Needs unmet) {
  const EvidenceInfo& info = about(evidence);
  return (info.needs & unmet) == 0 ? info.first_s(signals) : std::nullopt;
}

}  // namespace seldinger::assessment
