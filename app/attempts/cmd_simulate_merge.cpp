// simulate merge.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "casedb/attempts/merge_simulated.h"

namespace seldinger::app {
namespace {

int run_simulate_merge(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::simulate_attempts); !by)
    return refuse(by.error());
  auto from = casedb::open_to_merge(arguments.positional(0));
  if (!from) return refuse(from.error());
  const auto merged = casedb::merge_simulated(*library, *from);
  if (!merged) return refuse(merged.error());
  if (arguments.has("--json"))
    std::fputs(json_of_merged(*merged).c_str(), stdout);
  else
    std::printf("%zu simulated people and %zu of their attempts added; %zu attempts already existed\n",
                merged->people, merged->attempts, merged->there);
  return kDone;
}

}  // namespace

Command simulate_merge_command() {
  return {.name = "simulate merge",
          .positionals = "LIBRARY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Adds the simulated people of another library and their attempts, each once.",
          .run = &run_simulate_merge};
}

}  // namespace seldinger::app
