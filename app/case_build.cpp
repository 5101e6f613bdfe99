#include "app/case_build.h"

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
  return scene;
}

}  // namespace seldinger::app
