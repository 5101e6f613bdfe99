// How a case's settings are written for people.
#pragma once

#include <string>
#include <vector>

#include "casedb/cases/setting_table.h"

namespace seldinger::reports {

// "ultrasound, in plane, patient supine, also mpr".
std::string guidance_text(const casedb::CaseSetting& setting);

struct SettingFact {
  const char* words;
  std::string value;
};
// Those that have words on the case's page, in its order, but those that are not set.
std::vector<SettingFact> setting_facts(const casedb::CaseSetting& setting);

}  // namespace seldinger::reports
