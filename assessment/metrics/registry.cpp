#include "assessment/metrics/registry.h"

#include <cmath>

#include "assessment/metrics/endpoint.h"
#include "assessment/metrics/fluoroscopy.h"
#include "assessment/metrics/path.h"
#include "assessment/metrics/punctures.h"
#include "assessment/metrics/time.h"
#include "assessment/metrics/visibility.h"

namespace seldinger::assessment {
namespace {

constexpr const char* kVidal = "F. P. Vidal's thesis, §4.5";
constexpr const char* kJohnson = "Johnson et al., BJR 85 (2012) 555, doi 10.1259/bjr/47436030";

constexpr const char* kPerk = "Perk Tutor's TargetsScanned: 5 mm in its code, 2 mm in its comment";
constexpr const char* kDose =
    "IEC 60601-2-43 (what an interventional machine must tell); SIR's guidelines for patient radiation dose "
    "management, J. Vasc. Interv. Radiol. 20 (2009) S263";
constexpr const char* kTechnique =
    "ICRP Publication 117, Ann. ICRP 40 (6), 2010: radiological protection in fluoroscopically guided procedures";
constexpr const char* kBullsEye = "bull's-eye puncture with depth view; Miller et al., J. Urol. 178 (2007)";

constexpr MetricInfo kRegistry[] = {
    {"hit", 1, "bool", "Target hit", Direction::higher_is_better,
     "1 or 0. At the endpoint (trigger): access needle, the tip is inside the target; core needle, at least 5 mm "
     "of the fired "
     "notch are. A sweep through the target before is no hit. Null: no_endpoint, no_target.",
     kVidal, &hit},
    {"core_in_target", 1, "mm", "Core in target", Direction::higher_is_better,
     "Length of the fired notch inside the target. Null: not_a_core_needle, no_endpoint, no_target.", kJohnson,
     &core_in_target},
    {"tip_target_dist", 1, "mm", "Distance to target centre", Direction::lower_is_better,
     "At the endpoint, from the tip (core needle: the middle of the fired notch) to the target's centre; never the "
     "closest approach. Null: no_endpoint, no_target.",
     kVidal, &tip_target_dist},
    {"tip_target_surface", 1, "mm", "Distance to target surface", Direction::lower_is_better,
     "As tip_target_dist, to the target's surface; negative inside. Null: no_endpoint, no_target.", kVidal,
     &tip_target_surface},
    {"tip_target_axial", 1, "mm", "Short of target", Direction::none,
     "The part of tip_target_dist along the needle; positive when the needle stopped short. Null: no_endpoint, "
     "no_target.",
     kJohnson, &tip_target_axial},
    {"tip_target_lateral", 1, "mm", "Beside target", Direction::lower_is_better,
     "The part of tip_target_dist across the needle. Null: no_endpoint, no_target.", kJohnson, &tip_target_lateral},
    {"time_total", 1, "s", "Time", Direction::lower_is_better,
     "From the first pose to the endpoint; without an endpoint to the last pose.", kJohnson, &time_total},
    {"path_tip", 1, "mm", "Tip path", Direction::lower_is_better,
     "Length of the tip's way, resampled to 100 Hz, low-passed at 10 Hz (zero-phase 4th-order Butterworth); gaps "
     "over "
     "0.25 s are not bridged. One pose: 0. Null: only_gaps.",
     kJohnson, &path_tip},
    {"skin_punctures", 1, "count", "Skin punctures", Direction::lower_is_better,
     "Times the tip went more than 2 mm below the skin for at least 100 ms; the next counts after it was 1 mm "
     "outside. "
     "The ends of the volume are no skin; lung and gas are body. Null: no_skin, only_gaps.",
     kJohnson, &skin_punctures},
    {"withdrawals_partial", 1, "count", "Partial withdrawals", Direction::lower_is_better,
     "Times the inserted length fell below its running maximum by 20 % of it (at least 2, at most 5 mm) and rose "
     "by as "
     "much again without leaving the skin. Null: no_skin, only_gaps.",
     kVidal, &withdrawals_partial},
    {"withdrawals_full", 1, "count", "Full withdrawals", Direction::lower_is_better,
     "Times the needle, once more than 2 mm below the skin for 100 ms, left it by more than 1 mm before the "
     "endpoint.",
     kVidal, &withdrawals_full},
    {"vis_needle", 1, "share", "Needle tip visible", Direction::higher_is_better,
     "Share of the time in tissue with a live picture in which the picture showed the needle's tip. A "
     "fluoroscope's "
     "picture is live from a pulse until the time to the next is over; a held image is not. Null: no_skin, "
     "under_1_s_in_tissue_with_a_live_picture, not_meaningful_out_of_plane (of a slice or ultrasound).",
     kVidal, &vis_needle},
    {"vis_target", 1, "share", "Target visible", Direction::higher_is_better,
     "As vis_needle, for the target. Null: no_skin, under_1_s_in_tissue_with_a_live_picture, no_target.", kVidal,
     &vis_target},
    {"vis_joint", 1, "share", "Needle and target visible", Direction::higher_is_better,
     "As vis_needle, for tip and target at once. Null: no_skin, under_1_s_in_tissue_with_a_live_picture, "
     "no_target, "
     "not_meaningful_out_of_plane.",
     kVidal, &vis_joint},
    {"vis_joint_2_mm", 1, "share", "Both within 2 mm", Direction::higher_is_better,
     "As vis_joint, by geometry alone: tip and target's centre within 2 mm of the picture's plane and inside its "
     "field. Null: as vis_joint, not_ultrasound, near_plane_not_recorded.",
     kPerk, &vis_joint_2_mm},
    {"vis_joint_5_mm", 1, "share", "Both within 5 mm", Direction::higher_is_better,
     "As vis_joint_2_mm, within 5 mm.", kPerk, &vis_joint_5_mm},
    {"visible_needle_length", 1, "mm", "Visible needle length", Direction::higher_is_better,
     "Mean, over the time that vis_needle counts, of the shaft's length that the picture showed. Null: as "
     "vis_needle.",
     kJohnson, &visible_needle_length},
    {"advance_visible_share", 1, "share", "Advance visible", Direction::higher_is_better,
     "Share of the way that the tip advanced in tissue while a live picture showed it; to and fro by under 1 mm is "
     "no advance. Null: not_meaningful_under_xray, not_meaningful_out_of_plane, no_skin, no_picture, "
     "under_1_mm_of_advance.",
     "share of needle advancement in plane, BMC Anesthesiol. 2014, PMC4384236", &advance_visible_share},
    {"fluoroscopy_time", 1, "s", "Fluoroscopy time", Direction::lower_is_better,
     "Time with the beam on: each pulse stands for the time to the next, 1/rate. No pulse: 0. Null: not_xray, "
     "beam_not_recorded.",
     kDose, &fluoroscopy_time},
    {"pulses", 1, "count", "Pulses", Direction::lower_is_better,
     "X-ray pulses fired. Null: not_xray, beam_not_recorded.", kDose, &pulses},
    {"pulse_rate_max", 1, "1/s", "Fastest pulse rate", Direction::lower_is_better,
     "Highest rate at which pulses were fired. Null: not_xray, beam_not_recorded, no_exposure.", kTechnique,
     &pulse_rate_max},
    {"dap", 1, "Gy·cm²", "Dose–area product", Direction::lower_is_better,
     "Sum of the pulses' air kerma times the field's area. No pulse: 0. Null: not_xray, beam_not_recorded.", kDose,
     &dap},
    {"air_kerma", 1, "mGy", "Air kerma", Direction::lower_is_better,
     "Sum of the pulses' air kerma, free in air at the interventional reference point, 150 mm from the isocentre "
     "towards the tube. No pulse: 0. Null: not_xray, beam_not_recorded.",
     kDose, &air_kerma},
    {"beam_while_moving", 1, "s", "Beam while moving", Direction::lower_is_better,
     "Fluoroscopy time of the pulses fired while arm, detector or table moved. Null: not_xray, beam_not_recorded.",
     kTechnique, &beam_while_moving},
    {"collimated_share", 1, "share", "Field collimated", Direction::higher_is_better,
     "Share of the whole field that the collimator shut off, averaged over the fluoroscopy time. Null: not_xray, "
     "beam_not_recorded, "
     "no_exposure.",
     kTechnique, &collimated_share},
    {"views", 1, "count", "Views", Direction::none,
     "Distinct directions, at least 5° apart, from which pulses were fired with the machine at rest; at most 32 "
     "are "
     "told apart. Null: not_xray, beam_not_recorded.",
     kBullsEye, &views},
    {"view_angle_max", 1, "deg", "Widest view angle", Direction::higher_is_better,
     "Widest angle between the lines of sight of two pulses fired at rest, 0 to 90°: opposite views tell the same "
     "depth. Null: not_xray, beam_not_recorded, fewer_than_two_views.",
     kBullsEye, &view_angle_max},
    {"hand_in_beam", 1, "s", "Hand in beam", Direction::lower_is_better,
     "Fluoroscopy time of the pulses in which the hand at the needle's hub (a ball of 45 mm radius; none while it "
     "has "
     "let go) met the collimated beam. Null: not_xray, beam_not_recorded.",
     kTechnique, &hand_in_beam},
    {"longest_advance_between_exposures", 1, "mm", "Advance between exposures", Direction::lower_is_better,
     "Most that the inserted length grew without a pulse: between two, before the first, and after the last. What "
     "was "
     "withdrawn and inserted again counts again; gaps over 0.25 s are not bridged. Null: not_xray, "
     "beam_not_recorded, no_skin, "
     "only_gaps, "
     "never_in_tissue.",
     "advancing between exposures is correct practice under fluoroscopy, as long as it is short",
     &longest_advance_between_exposures},
    {"gap_share", 1, "share", "Tracking gaps", Direction::lower_is_better,
     "Share of the time in gaps of over 0.25 s between poses; gaps belong to no other metric's denominator. Null: "
     "too_short.",
     "data quality", &gap_share},
};

const char* words(Direction direction) {
  switch (direction) {
    case Direction::lower_is_better:
      return "lower";
    case Direction::higher_is_better:
      return "higher";
    case Direction::none:
      break;
  }
  return "–";
}

}  // namespace

std::span<const MetricInfo> registry() {
  return kRegistry;
}

const MetricInfo* find_metric(const std::string& id) {
  for (const MetricInfo& info : kRegistry)
    if (id == info.id) return &info;
  return nullptr;
}

std::vector<MetricValue> measure_all(const Signals& signals) {
  std::vector<MetricValue> values;
  for (const MetricInfo& info : kRegistry) {
    Measured measured = info.measure(signals);
    if (measured.value && !std::isfinite(*measured.value)) measured = Measured::none("not_finite");
    values.push_back({info.id, info.version, measured.value, info.unit, measured.reason});
  }
  return values;
}

std::string metrics_markdown() {
  std::string text =
      "# Metrics\n\nMade from `assessment/metrics/registry.cpp` by `seldinger help --metrics`; a test compares.\n"
      "Lengths in mm, coordinates in LPS. A metric that cannot be given is null with a reason, never 0.\n\n"
      "| id | version | unit | better | definition | source |\n|---|---|---|---|---|---|\n";
  for (const MetricInfo& info : kRegistry)
    text += "| `" + std::string(info.id) + "` | " + std::to_string(info.version) + " | " + info.unit + " | " +
            words(info.direction) + " | " + info.definition + " | " + info.source + " |\n";
  return text;
}

}  // namespace seldinger::assessment
