#include "app/case_build.h"

#include <glm/mat4x4.hpp>

#include "sim/imaging/ultrasound/echogenicity.h"

namespace seldinger::app {

base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row,
                                     const std::optional<cases::Lesion>& target,
                                     const cases::Instrument& instrument, const cases::Picture& picture,
                                     cases::Approach approach) {
  auto volume = casedb::load_volume(library, row);
  if (!volume) return volume.error();
  auto skin = casedb::load_skin(library, row);
  if (!skin) return skin.error();
  cases::Case scene;
  scene.volume = std::move(*volume);
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  if (target) scene.lesions.push_back(*target);
  scene.instrument = instrument;
  scene.picture = picture;
  scene.approach = approach;
  scene.position = row.position;
  // The table is set so that the machine turns about the middle of what there is.
  const glm::dvec4 middle(glm::dvec3(scene.volume.size_voxels - 1) / 2.0, 1.0);
  scene.fluoroscope.start.isocentre_lps_mm = glm::dvec3(scene.volume.lps_from_voxel * middle);
  return scene;
}

base::Result<void> add_tissue(casedb::Library& library, const casedb::CaseRow& row, cases::Case& scene) {
  auto classes = casedb::load_classes(library, row);
  if (!classes) return classes.error();
  scene.classes = std::move(*classes);
  return {};
}

base::Result<void> add_ultrasound_tissue(casedb::Library& library, const casedb::CaseRow& row, cases::Case& scene) {
  if (const auto added = add_tissue(library, row, scene); !added) return added.error();
  scene.echogenicity = imaging::echogenicity(scene.volume, scene.classes);
  return {};
}

}  // namespace seldinger::app
