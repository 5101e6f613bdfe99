// The tables that make up the registry: each stands in the file of its metrics, a row beside the function that it
// names. What one metric takes from another file's is declared here, too.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assessment/metrics/metric.h"
#include "sim/case/structure.h"

namespace seldinger::assessment {

// What the versions of older laws of sight did otherwise.
#define SELDINGER_BY_HALF_SLICE \
  ": what pictures showed by the law half_slice, as cases of that law still have it (decision 0057)."
#define SELDINGER_WITHOUT_CLUTTER \
  ": without clutter in ultrasound, as cases of the law scatter and before still have it (decision 0090)."
#define SELDINGER_WITHOUT_IODINE                                                                              \
  ": with a CT's contrast medium as bone under X-rays, as cases of the law clutter and before still have it " \
  "(decision 0098)."
#define SELDINGER_AT_ANY_TILT                                                                                     \
  ": with a tip that shows at any tilt but the steepest, as cases of the law material and before still have it, " \
  "and with sharp margins of lesions; in those of clutter and before also without portal walls and lesions' "     \
  "texture (decisions 0100, 0102, 0106, 0107)."
#define SELDINGER_BY_ECHO \
  ": without what is scattered under X-rays, as cases of the law echo still have it (decision 0082)."

std::span<const MetricInfo> endpoint_metrics();
std::span<const MetricInfo> approach_metrics();
std::span<const MetricInfo> structure_metrics();
std::span<const MetricInfo> puncture_metrics();
std::span<const MetricInfo> visibility_metrics();
std::span<const MetricInfo> advance_metrics();
std::span<const MetricInfo> probe_metrics();
std::span<const MetricInfo> last_advance_metrics();
std::span<const MetricInfo> path_metrics();
std::span<const MetricInfo> force_metrics();
std::span<const MetricInfo> time_metrics();
std::span<const MetricInfo> fluoroscopy_metrics();
std::span<const MetricInfo> way_metrics();
std::span<const MetricInfo> recording_metrics();
std::span<const MetricInfo> procedure_metrics();
std::span<const MetricInfo> breath_metrics();

inline constexpr double kMostClearanceMm = 20.0;  // of clearance_min: nobody asks how far beyond

// At the endpoint; there is one, and a target.
bool target_hit(const Signals& signals);

// How deep below the skin the tip has punctured it: our judgement.
inline constexpr double kPunctureDepthMm = 2.0;

struct PunctureCounts {
  int punctures = 0, full_withdrawals = 0, partial_withdrawals = 0;
  // Of the first puncture that counted: when it was 2 mm deep, and the first pose of it in the body.
  std::optional<double> first_s;
  std::size_t first_pose = 0;
  bool withdrawn_at_end = false;
  // When each was 2 mm deep; and for each withdrawal, when the tip was deepest before it.
  std::vector<double> punctures_s, full_withdrawals_s, partial_withdrawals_s;
};
PunctureCounts count_punctures(const Signals& signals);

// Whether the needle was put to use, or the case deferred (procedure_performed). There is skin.
bool performed(const Signals& signals);

// When each visit was entered that nogo_contacts counts; of one rule's structures alone, as capsule_punctures
// counts them; and when the far wall of a lumen was gone through, as posterior_wall does.
std::vector<double> nogo_entries_s(const Signals& signals);
template <cases::StructureRule rule>
std::vector<double> entries_s(const Signals& signals);
std::vector<double> far_walls_s(const Signals& signals);

// What blind_advance_max measures, and when; nothing where no advance was unseen.
struct BlindRun {
  double from_s = 0.0, to_s = 0.0, length_mm = 0.0;
};
std::optional<BlindRun> longest_blind_run(const Signals& signals);
// When a blind run, as blind_advance_max counts it, was first longer; when advance_beyond_plane was first more.
std::optional<double> first_blind_run_s(const Signals& signals, double longer_than_mm);
std::optional<double> first_beyond_plane_s(const Signals& signals, double more_than_mm);

// Estimands that many rows share. Rare events are told as a mean: the median of most people's is 0.
inline constexpr Estimand kMedianRatio{Scale::ratio, WithoutEndpoint::left_out, Aggregation::median};
inline constexpr Estimand kMedianRatioOrFailure{Scale::ratio, WithoutEndpoint::failure, Aggregation::median};
inline constexpr Estimand kMedianInterval{Scale::interval, WithoutEndpoint::left_out, Aggregation::median};
inline constexpr Estimand kMedianIntervalOrFailure{Scale::interval, WithoutEndpoint::failure, Aggregation::median};
inline constexpr Estimand kMedianShare{Scale::share, WithoutEndpoint::left_out, Aggregation::median};
inline constexpr Estimand kMedianTimeCensored{Scale::ratio, WithoutEndpoint::censored, Aggregation::median};
inline constexpr Estimand kMeanCount{Scale::count, WithoutEndpoint::left_out, Aggregation::mean};
inline constexpr Estimand kProportion{Scale::yes_no, WithoutEndpoint::left_out, Aggregation::proportion};
inline constexpr Estimand kProportionOrFailure{Scale::yes_no, WithoutEndpoint::failure, Aggregation::proportion};

// Laws that many rows share: of what has a place but no side, and of what is told of the way in the patient at
// rest.
inline constexpr std::uint32_t kAnyPlace = kInAnyFrame | kMirrored;
inline constexpr std::uint32_t kOfTheWay =
    kAnyPlace | kAtAnySpeed | kInAnyBreath | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples;
// Of the trace, which the low-pass cuts short where a hand turns fast.
inline constexpr std::uint32_t kOfTheTrace =
    kAnyPlace | kInAnyBreath | kIdleBefore | kIdleAfter | kOneDarkFrame | kLostSamples;

// Sources that more than one table names.
inline constexpr const char* kVidal = "F. P. Vidal's thesis, §4.5";
inline constexpr const char* kJohnson = "Johnson et al., BJR 85 (2012) 555, doi 10.1259/bjr/47436030";
inline constexpr const char* kSites = "Sites et al., Reg. Anesth. Pain Med. 32 (2007) 107: the commonest errors";

}  // namespace seldinger::assessment
