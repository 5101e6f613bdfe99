// A way to a target: skin entry, straight path, and where the probe stands to see both.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "assessment/operators/conduct.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/form/mesh_index.h"
#include "sim/case/inputs.h"
#include "sim/case/patient_position.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::assessment {

struct PuncturePlan {
  glm::dvec3 target_lps_mm{0.0};
  glm::dvec3 entry_lps_mm{0.0};
  glm::dvec3 direction{0.0};  // unit, entry → target
  double depth_mm = 0.0;      // entry to target
  // In plane, the picture's plane holds entry and target; out of plane, it holds the target and the way crosses it.
  // Without a picture under a probe, laid aside.
  cases::Approach approach = cases::Approach::in_plane;
  cases::ToolPose probe;
  // Over the first of the way: out of plane it slides from there to `probe`, in plane it is rocked from there.
  cases::ToolPose probe_first;
  double pressed_mm = 0.0;                  // deeper than it takes for the ends of the probe's face to touch
  std::optional<cases::Picture> picture{};  // to be set at that probe, where `looks_from` chose it
  // From this insertion on the picture shows a tip that keeps to the plan; before, it is beside the picture.
  double tip_shows_from_mm = 0.0;
  // From this insertion on the way is inside the organ that carries the target, as the CT showed; 0: no organ.
  double organ_from_mm = 0.0;
  Brief brief{};          // what the sign-in tells
  double ct_level = 0.0;  // of breath, at which the CT was taken: tissue then lies as planned
};

// What a picture would show of a plan from where its probe touches the skin.
struct ProbeView {
  cases::ToolPose probe, probe_first;  // as it is held there: pressed in
  cases::Picture picture;
  double tip_shows_from_mm = 0.0;  // as PuncturePlan's
  double needle_mm = 0.0;          // of the shaft that is seen when the tip is at the target
  double shadow_db = 0.0;          // ≥ 0: what ribs and gas above take from the target's echoes
};

// What a picture shows from where a plan's probe stands. Nothing: the target is not seen from there, the probe is
// in the way, or the place is not worth taking. `worth` tells that of a view: the sooner its tip shows, the rather,
// so whoever looks may ask how soon it would have to. An empty one takes every place.
using WorthTaking = std::function<bool(const ProbeView&)>;
using LooksFrom = std::function<std::optional<ProbeView>(const PuncturePlan&, const WorthTaking&)>;

struct PathLimits {
  double min_depth_mm = 10.0, max_depth_mm = 130.0;
  double clearance_mm = 4.0;  // around the path
  double bone_hu = 350.0;     // where no class tells: five noise SD above a contrast-filled vessel of 200 HU
  double gas_hu = -300.0;     // the skin's threshold
  double skin_free_mm = 4.0;  // the first millimetres mix skin and air
  cases::PatientPosition position = cases::PatientPosition::supine;
  bool needs_probe = true;                               // target and way must be seen from a place on the skin …
  cases::Approach approach = cases::Approach::in_plane;  // … so
  LooksFrom looks_from{};  // told by whoever makes pictures; left empty, every place on the skin will do
  // What the way, and what a core needle is thrown through behind the target, keeps clear of (major and critical),
  // and what it must lead through for must_cross_mm. Outlive the plan's making.
  std::span<const cases::Structure> structures{};
  double structure_clearance_mm = 2.0;  // room for a hand's sway (design)
  double must_cross_mm = 10.0;          // docs/clinical.md, cases 3 and 5: renal parenchyma
  double behind_target_mm = 0.0;        // how far beyond the target's centre the tip may come
  // Of every voxel, in the volume's order: bone and metal by class. Empty: by HU, to which an artery full of
  // contrast agent is bone, and a rib of slices of 5 mm none. Outlive the plan's making.
  std::span<const volume::TissueClass> classes{};
  // Here HU do not count: a target, or the lumen it is in, may be full of contrast agent.
  std::vector<cases::Shape> open{};
  // How far the making of the plan is, 0 to 1: the share of the ways that were judged.
  std::function<void(double share)> told{};
  // How far a C-arm may turn to look along the path; beyond 180°, 90° are none.
  double max_lao_deg = 180.0, max_cranial_deg = 90.0;
};

// Limits of a path for a bull's-eye view: arm and detector stay clear of table and patient.
constexpr double kBullsEyeLaoDeg = 55.0, kBullsEyeCranialDeg = 35.0;

// Whether what points so out of the body comes from where the patient lies (LPS +y when supine): no hand gets
// there.
bool towards_table(const glm::dvec3& outward, cases::PatientPosition position) noexcept;

// Whether no needle gets through the volume there. `voxel`: of the place, within the volume; `hu`: sampled there.
bool is_bone(const PathLimits& limits, const volume::Volume& volume, const glm::dvec3& voxel, double hu) noexcept;

// The limits of a case: under xray, those of a bull's-eye view.
PathLimits path_limits(cases::Modality modality, cases::PatientPosition position);
// As that, of a case with its structures and its needle: no way is longer than it. The case outlives the limits.
PathLimits path_limits(const cases::Case& scene);

// The shortest straight path to the target that starts on skin (not a cut cap, not the side on the table), is free
// of bone and gas and of structures as the limits say, and can be seen. Where `looks_from` judges, the probe stands
// where the tip shows from the skin on, or as soon as possible. The same for the same scene. Refused: `no_path`.
base::Result<PuncturePlan> plan_puncture(const volume::Volume& volume, const cases::MeshIndex& skin,
                                         const glm::dvec3& target_lps_mm, const PathLimits& limits = {});

}  // namespace seldinger::assessment
