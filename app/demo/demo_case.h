// The case of the main job: a CT of the user's or the built-in torso, with a lesion where the stated rule puts it.
#pragma once

#include <filesystem>
#include <optional>

#include "app/cli/command.h"
#include "app/demo/demo_library.h"
#include "casedb/cases/cases.h"
#include "sim/base/result.h"

namespace seldinger::app {

struct DemoCaseFound {
  casedb::CaseRow row;
  casedb::LesionRow lesion;
};

// One that is in the library is used again, so that a second run is quick and makes nothing twice. `library` is
// opened, and made in `folder` only once case and lesion are sure: a CT that is refused leaves nothing behind. What
// import noticed of it is among the findings.
base::Result<DemoCaseFound> demo_case(std::optional<casedb::Library>& library, MadeFolder& folder,
                                      const Arguments& arguments);

}  // namespace seldinger::app
