// Metrics of an attempt guided by fluoroscopy: what was spent, and how the machine was used.
#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"
#include "sim/case/fluoroscope.h"
#include "sim/case/viewing_angles.h"

namespace seldinger::assessment {
namespace {

constexpr double kMgyPerGy = 1000.0, kMm2PerCm2 = 100.0;
constexpr cases::Fluoroscope kMachine{};  // the built-in one, the only one there is
constexpr double kMarginMm = 20.0;        // about the target: judgement; a tip on its way in is seen so far off

// Sum over the pulses.
template <typename Part>
Measured sum(const Signals& signals, const Part& part) {
  double total = 0.0;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam) total += part(*frame.beam);
  return Measured::of(total);
}

cases::ViewingAngles viewing_angles(const Signals& signals) {
  cases::ViewingAngles views;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam && !frame.beam->arm_moving) cases::add_view(frame.beam->lao_deg, frame.beam->cranial_deg, views);
  return views;
}

Measured fluoroscopy_time(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.beam_s; });
}

Measured pulses(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth&) { return 1.0; });
}

Measured pulse_rate_max(const Signals& signals) {
  double shortest_s = 0.0;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam && frame.beam->beam_s > 0.0)
      shortest_s = shortest_s > 0.0 ? std::min(shortest_s, frame.beam->beam_s) : frame.beam->beam_s;
  return shortest_s > 0.0 ? Measured::of(1.0 / shortest_s) : Measured::none("no_exposure");
}

Measured dap(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.dap_mgy_cm2 / kMgyPerGy; });
}

Measured air_kerma(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.air_kerma_mgy; });
}

Measured beam_while_moving(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.arm_moving ? beam.beam_s : 0.0; });
}

Measured hand_in_beam(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.hand_in_beam ? beam.beam_s : 0.0; });
}

// Of the whole field, how much may be shut off so that the target and kMarginMm about it are still in it. Told at
// the isocentre: what a pulse's dose–area product is in terms of its air kerma is the open field's area at the
// reference point, and that grows with the square of the distance from the source.
std::optional<double> useful_share(const cases::BeamTruth& beam, double target_radius_mm) {
  const double open_share = 1.0 - beam.collimated_share;
  if (!(beam.air_kerma_mgy > 0.0 && beam.dap_mgy_cm2 > 0.0 && open_share > 0.0)) return std::nullopt;
  const double reference_mm = kMachine.source_isocentre_mm - cases::kReferenceBeforeIsocentreMm;
  const double grown = kMachine.source_isocentre_mm / reference_mm;
  const double field_mm2 = beam.dap_mgy_cm2 / beam.air_kerma_mgy * kMm2PerCm2 * grown * grown / open_share;
  const double side_mm = 2.0 * (target_radius_mm + kMarginMm);
  return std::max(0.0, 1.0 - side_mm * side_mm / field_mm2);
}

Measured collimated_share(const Signals& signals) {
  double time_s = 0.0, shut_s = 0.0;
  for (const cases::FrameTruth& frame : signals.frames) {
    if (!frame.beam || !(frame.beam->beam_s > 0.0)) continue;
    const auto useful = useful_share(*frame.beam, signals.setting.target->radius_mm);
    if (!useful) return Measured::none("field_not_known");
    time_s += frame.beam->beam_s;
    shut_s += std::min(frame.beam->collimated_share, *useful) * frame.beam->beam_s;
  }
  return time_s > 0.0 ? Measured::of(shut_s / time_s) : Measured::none("no_exposure");
}

Measured views(const Signals& signals) {
  return Measured::of(viewing_angles(signals).count);
}

Measured view_angle_max(const Signals& signals) {
  const cases::ViewingAngles angles = viewing_angles(signals);
  if (angles.count < 2) return Measured::none("fewer_than_two_views");
  return Measured::of(angles.widest_deg);
}

Measured longest_advance_between_exposures(const Signals& signals) {
  double longest_mm = 0.0, lowest_mm = 0.0, last_mm = 0.0;
  std::size_t frame = 0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    // Poses are held until the next: an exposure since the one before shows the tip where that one has it.
    bool exposed = false;
    for (; frame < signals.frames.size() && signals.frames[frame].t_s <= signals.poses[i].t_s; ++frame)
      exposed = exposed || signals.frames[frame].beam.has_value();
    if (exposed) lowest_mm = last_mm;
    const double inserted_mm = signals.pushed_mm[i];
    // What starts inside has advanced before anybody looked; what happened in a gap is not known.
    if (i == 0 || signals.gap(i - 1)) lowest_mm = inserted_mm;
    lowest_mm = std::min(lowest_mm, inserted_mm);
    longest_mm = std::max(longest_mm, inserted_mm - lowest_mm);
    last_mm = inserted_mm;
  }
  return Measured::of(longest_mm);
}

constexpr const char* kSpent =
    "IEC 60601-2-43 (what an interventional machine must report); SIR's guidelines for patient radiation dose "
    "management, J. Vasc. Interv. Radiol. 20 (2009) S263";
constexpr const char* kTechnique =
    "ICRP Publication 117, Ann. ICRP 40 (6), 2010: radiological protection in fluoroscopically guided procedures";
constexpr const char* kBullsEye = "bull's-eye puncture with depth view; Miller et al., J. Urol. 178 (2007)";
constexpr Needs kUnderBeam = kXray | kBeam;

constexpr MetricInfo kFluoroscopyMetrics[] = {
    {"fluoroscopy_time", 1, "s", "Fluoroscopy time", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Time with the beam on: each pulse stands for the time to the next, 1/rate. No pulse: 0.", kSpent,
     &fluoroscopy_time, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame},
    {"pulses", 1, "count", "Pulses", Group::dose, Direction::lower_is_better, kUnderBeam, "X-ray pulses fired.",
     kSpent, &pulses, kMeanCount,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed},
    {"pulse_rate_max", 1, "1/s", "Fastest pulse rate", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Highest rate at which pulses were fired. Null: no_exposure.", kTechnique, &pulse_rate_max, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kNothingIsNothing},
    {"dap", 1, "Gy·cm²", "Dose–area product", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Sum of the pulses' air kerma times the field's area. No pulse: 0.", kSpent, &dap, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed},
    {"air_kerma", 1, "mGy", "Air kerma", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Sum of the pulses' air kerma, free in air at the interventional reference point, 150 mm from the isocentre "
     "towards the tube. No pulse: 0.",
     kSpent, &air_kerma, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed},
    {"beam_while_moving", 1, "s", "Beam while moving", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Fluoroscopy time of the pulses fired while arm, detector or table moved.", kTechnique, &beam_while_moving,
     kMedianRatio, kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame},
    {"collimated_share", 2, "share", "Field collimated", Group::dose, Direction::higher_is_better,
     kUnderBeam | kTarget,
     "Share of the whole field that the collimator shut off, averaged over the fluoroscopy time. It counts down to "
     "a field that still holds the target (as a ball) and 20 mm around it on every side, sized as at the "
     "isocentre; shutting off more earns nothing. Null: no_exposure; field_not_known (a pulse without a dose).",
     kTechnique, &collimated_share, kMedianShare,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed |
         kNothingIsNothing,
     "1: the whole share shut off, however small the field that was left."},
    {"views", 1, "count", "Views", Group::picture, Direction::none, kUnderBeam,
     "Distinct directions, at least 5° apart, from which pulses were fired with the machine at rest; at most 32 "
     "are distinguished.",
     kBullsEye, &views, kMeanCount,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed},
    {"view_angle_max", 1, "deg", "Widest view angle", Group::picture, Direction::higher_is_better, kUnderBeam,
     "Widest angle between the lines of sight of two pulses fired at rest, 0 to 90°: opposite views show the same "
     "about depth. Null: fewer_than_two_views.",
     kBullsEye, &view_angle_max, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame | kAtAnySpeed |
         kNothingIsNothing},
    {"hand_in_beam", 1, "s", "Hand in beam", Group::dose, Direction::lower_is_better, kUnderBeam,
     "Fluoroscopy time of the pulses in which the hand at the needle's hub (a ball of 45 mm radius; none while it "
     "has "
     "let go) met the collimated beam.",
     kTechnique, &hand_in_beam, kMedianRatio,
     kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kLostSamples | kOneDarkFrame},
    {"longest_advance_between_exposures", 2, "mm", "Advance between exposures", Group::picture,
     Direction::lower_is_better, kUnderBeam | kSkin | kMotion | kTissue,
     "Greatest length by which the hand pushed the needle in without a pulse: between two, before the first, and "
     "after the last. What was withdrawn and inserted again counts again; breath that slides past a hand at rest "
     "does not; gaps over 0.25 s are not bridged.",
     "advancing between exposures is correct practice under fluoroscopy, as long as it is short",
     &longest_advance_between_exposures, kMedianRatio,
     kAnyPlace | kAtAnySpeed | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples | kNothingIsNothing,
     "1: how far the needle came in, so that breath past a resting hand was advance."},
};

}  // namespace

std::span<const MetricInfo> fluoroscopy_metrics() {
  return kFluoroscopyMetrics;
}

}  // namespace seldinger::assessment
