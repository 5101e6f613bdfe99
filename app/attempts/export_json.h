// What `export` answers with --json.
#pragma once

#include <string>

#include "reports/export/raw_export.h"

namespace seldinger::app {

std::string json_of_export(const reports::RawExport& done);

}  // namespace seldinger::app
