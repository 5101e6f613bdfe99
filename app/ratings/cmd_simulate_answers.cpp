// simulate answers.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/questionnaires/acting_in_round.h"
#include "app/ratings/rating_json.h"
#include "casedb/ratings/simulated_answers.h"

namespace seldinger::app {
namespace {

int run_simulate_answers(const Arguments& arguments) {
  const auto seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  // Who fills a round writes in it: reading its answers is not enough, nor is opening others.
  if (const auto by = acting(*library, arguments, casedb::Action::manage_questionnaires); !by)
    return refuse(by.error());
  const auto round = round_to_read(*library, arguments);
  if (!round) return refuse(round.error());
  const auto made = casedb::simulate_answers(*library, round->code, seed);
  if (!made) return refuse(made.error());
  if (arguments.has("--json"))
    std::fputs(json_of_simulated(*made).c_str(), stdout);
  else
    std::printf("SIMULATED: %zu sets of answers sent; %zu already existed\n", made->sent, made->there);
  return kDone;
}

constexpr Option kAnswersOptions[] = {
    kLibrary, {"--seed", "N", "decides the raters' severity, halo, drift and errors; default 1"}, kJson};

}  // namespace

Command simulate_answers_command() {
  return {.name = "simulate answers",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kAnswersOptions,
          .acts = true,
          .summary = "Has a study's simulated people answer its questionnaire, or simulated raters rate replays.",
          .run = &run_simulate_answers};
}

}  // namespace seldinger::app
