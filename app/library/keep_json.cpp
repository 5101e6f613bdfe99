#include "app/library/keep_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

Json problems_json(const std::vector<base::Problem>& problems) {
  Json list = Json::array();
  for (const base::Problem& problem : problems) list.push_back({{"code", problem.code}, {"text", problem.text}});
  return list;
}

}  // namespace

std::string json_of_copied(const casedb::Copied& copied) {
  return Json({{"files", copied.files}, {"bytes", copied.bytes}}).dump(2) + "\n";
}

std::string json_of_check(const casedb::CheckReport& report) {
  return Json({{"holds", report.holds()},
               {"cases", report.cases},
               {"attempts", report.attempts},
               {"assets", report.assets},
               {"findings", problems_json(report.findings)},
               {"repaired", problems_json(report.repaired)},
               {"healed", problems_json(report.healed)},
               {"accepted", problems_json(report.accepted)}})
             .dump(2) +
         "\n";
}

std::string json_of_bundle(const casedb::Bundle& bundle) {
  return Json({{"schema", bundle.schema},
               {"program_version", bundle.program_version},
               {"cases", bundle.case_ids},
               {"assets", bundle.assets},
               {"bytes", bundle.bytes},
               {"signing_key", bundle.signing_key ? Json(*bundle.signing_key) : Json(nullptr)}})
             .dump(2) +
         "\n";
}

std::string json_of_unbundled(const casedb::Unbundled& cases) {
  return Json({{"stored", cases.stored},
               {"present", cases.present},
               {"healed", cases.healed},
               {"for_review", cases.for_review},
               {"signing_key", cases.signing_key ? Json(*cases.signing_key) : Json(nullptr)},
               {"trusted_as", cases.trusted_as ? Json(*cases.trusted_as) : Json(nullptr)}})
             .dump(2) +
         "\n";
}

std::string json_of_trusted_keys(const std::vector<casedb::TrustedKey>& keys) {
  Json list = Json::array();
  for (const casedb::TrustedKey& key : keys)
    list.push_back({{"public_key", key.public_key}, {"label", key.label}, {"added_us", key.added_us}});
  return Json({{"trusted_keys", list}}).dump(2) + "\n";
}

}  // namespace seldinger::app
