// An attempt's metrics as JSON, in the form of the command line's `score`.
#pragma once

#include <string>

#include "casedb/store.h"

namespace seldinger::web {

std::string metrics_json(const casedb::AttemptRow& row);
std::string health_json(const std::string& program_version);

}  // namespace seldinger::web
