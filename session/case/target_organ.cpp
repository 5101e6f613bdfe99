#include "session/case/target_organ.h"

namespace seldinger::session {

std::optional<volume::OrganFound> organ_of_target(casedb::Library& library, const casedb::CaseRow& row,
                                                  const glm::dvec3& target_lps_mm) {
  if (!row.labels_sha256.empty() || row.subject == cases::Subject::phantom) return std::nullopt;
  const auto volume = casedb::load_volume(library, row);
  const auto classes = casedb::load_classes(library, row);
  if (!volume || !classes) return std::nullopt;
  return volume::organ_at(volume::find_organs(*volume, *classes), target_lps_mm);
}

}  // namespace seldinger::session
