// Where a training lesion goes when nobody has placed one: the demo's stated rule.
#pragma once

#include "assessment/operators/plan.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/form/mesh_index.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/volume.h"

namespace seldinger::assessment {

struct LesionRule {
  double radius_mm = 6.0;
  double min_depth_mm = 30.0, max_depth_mm = 90.0;  // below the nearest skin, and along the path
  double homogeneous_radius_mm = 16.0;              // soft tissue around the centre
  double min_mean_hu = 30.0, max_mean_hu = 180.0;   // parenchyma with or without contrast agent
  double contrast_hu = -45.0;                       // the lesion against its surroundings
  std::optional<double> lesion_hu{};                // instead: its own
  double grid_mm = 6.0;
  cases::Modality modality = cases::Modality::mpr;
  cases::PatientPosition position = cases::PatientPosition::supine;
  // Of a CT without labels: a place within a solid organ that is named comes before all others, and none is taken
  // beside the lungs (organ_places.h). Nothing: nobody asked.
  const volume::Organs* organs = nullptr;
  std::span<const volume::TissueClass> classes{};  // as PathLimits'
  // As PathLimits::looks_from, of a plan to this lesion.
  std::function<std::optional<ProbeView>(const PuncturePlan&, const WorthTaking&, const cases::Lesion&)>
      looks_from{};
};

// The rule of a case. Under xray soft tissue shows no soft lesion: there it is one filled with contrast agent, on a
// path along which the machine can look. Under ultrasound it is a cyst, seen from a place beside the path.
LesionRule lesion_rule(cases::Modality modality, cases::PatientPosition position);

struct LesionSite {
  cases::Lesion lesion;
  PuncturePlan plan;
  double skin_distance_mm = 0.0;      // of the centre to the nearest skin
  double mean_hu = 0.0, sd_hu = 0.0;  // within homogeneous_radius_mm
};

// One sentence: the rule with its numbers.
std::string describe(const LesionRule& rule);

// The most homogeneous place of the rule that a plan reaches, within an organ where one is named. The same for the
// same scene. Refused: `no_lesion_site`, with what was found against what the rule asks for.
base::Result<LesionSite> find_lesion_site(const volume::Volume& volume, const cases::MeshIndex& skin,
                                          const LesionRule& rule = {});

}  // namespace seldinger::assessment
