#include "session/case/target_organ.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "sim/volume/organs/organ_classes.h"

namespace seldinger::session {

std::optional<volume::OrganFound> organ_of_target(casedb::Library& library, const casedb::CaseRow& row,
                                                  const glm::dvec3& target_lps_mm) {
  if (!row.labels_sha256.empty() || row.subject == cases::Subject::phantom) return std::nullopt;
  const auto volume = casedb::load_volume(library, row);
  const auto classes = casedb::load_classes(library, row);
  if (!volume || !classes) return std::nullopt;
  const auto organ = volume::organ_at(volume::find_organs(*volume, *classes), target_lps_mm);
  if (!organ) return std::nullopt;
  const glm::ivec3 at = glm::clamp(
      glm::ivec3(glm::round(glm::dvec3(volume::voxel_from_lps(*volume) * glm::dvec4(target_lps_mm, 1.0)))),
      glm::ivec3(0), volume->size_voxels - 1);
  if (!volume::may_lie_in(organ->organ, (*classes)[volume->index(at.x, at.y, at.z)])) return std::nullopt;
  return organ;
}

}  // namespace seldinger::session
