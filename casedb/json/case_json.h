// What a mentor made of a case as JSON, for the command line and the dashboard.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "assessment/statistics/answer.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/received.h"
#include "casedb/cases/versions.h"

namespace seldinger::casedb {

// One case with all that belongs to it.
struct CaseParts {
  CaseRow row;
  std::vector<LesionRow> lesions;
  std::vector<StructureRow> structures;
  std::vector<Decision> decisions;
  std::optional<Received> received{};        // it came in a bundle
  std::optional<Preparation> preparation{};  // nothing: as its CT came
  bool provisional = true;                   // too few consultants have set the standard
  // Of passing cases of the library, by what people did; none: nobody asked (casedb/grading/dependability.h).
  std::optional<assessment::statistics::Answer> dependability{};
};
base::Result<CaseParts> load_parts(Library& library, const std::string& case_id);  // `no_case`
CaseParts load_parts(Library& library, CaseRow row);

nlohmann::ordered_json json_of_lesion(const LesionRow& lesion);
nlohmann::ordered_json json_of_structure(const StructureRow& structure);
nlohmann::ordered_json json_of_rule_of(const assessment::PassRule& rule);
nlohmann::ordered_json json_of_received(const std::optional<Received>& received);
nlohmann::ordered_json json_of_preparation(const std::optional<Preparation>& preparation);
// Fields of the setting, the version, who decided (by pseudonym) and where it came from are added to `json`.
void add_authoring(const CaseParts& parts, nlohmann::ordered_json& json);

}  // namespace seldinger::casedb
