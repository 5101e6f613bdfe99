// The JSON documents that the commands of a case's author answer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/cases/case_checks.h"
#include "casedb/json/case_json.h"
#include "session/attempt/rehearsal.h"
#include "session/case/case_check.h"
#include "session/case/case_needs.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::app {

struct LabelCount {
  int label = 0;
  std::string name;
  std::size_t voxels = 0;
  std::optional<volume::TissueClass> tissue;  // what its voxels are now
};

std::string json_of_structure(const std::string& structure_id);
std::string json_of_labels(const std::vector<LabelCount>& labels, bool resampled);
std::string json_of_checks(const std::string& case_id, const casedb::CaseCheck& check);
// A case with what its CT holds, as json_of_needs tells it.
std::string json_of_imported(const casedb::CaseParts& parts, const volume::TissueTold& tissue,
                             const std::optional<volume::Organs>& organs);
std::string json_of_needs(const std::string& case_id, cases::SightLaw sight_law, const session::CaseNeeds& needs,
                          const volume::TissueTold& tissue, const std::optional<volume::Organs>& organs);
std::string json_of_rehearsal(const std::string& case_id, const session::Rehearsal& rehearsal);
std::string json_of_version(const casedb::CaseRow& row);

}  // namespace seldinger::app
