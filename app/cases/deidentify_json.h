// What `deidentify` answers with --json.
#pragma once

#include <string>

#include "casedb/export/deidentify.h"

namespace seldinger::app {

std::string json_of_deidentified(const casedb::Deidentified& done);

}  // namespace seldinger::app
