// What somebody calls a case, a lesion, an attempt, a study, a cohort or a curriculum: its id, its title, or how
// one of these begins. The one place where names become ids.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/cli/arguments.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::app {

struct Called {
  std::string id, title;  // title: empty where it has none
};

// Its id, if it is the only one: of that id, else of that title, else whose id or title begins so; capitals and
// small letters are one (A to Z). Empty: none is called so, or nothing was typed. Refused: `ambiguous`, with how
// many and ids.
base::Result<std::string> id_of(std::string_view typed, const std::vector<Called>& known);

// What was typed in the place of CASE, LESION, ATTEMPT, STUDY, COHORT and CURRICULUM (words and options' values)
// becomes an id. Only what the person may see for whom the library acts is looked among, so that nobody learns by
// trying beginnings what there is; all else stays as it was typed, for the command to refuse as it refuses what is
// not there. Refused: `ambiguous`.
base::Result<void> settle_names(casedb::Library& library, const Arguments& arguments);

}  // namespace seldinger::app
