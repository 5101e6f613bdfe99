// case meet.
#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/acting/acting.h"
#include "app/attempts/rehearsal_words.h"
#include "app/cases/case_answers_json.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "session/attempt/rehearsal.h"

namespace seldinger::app {
namespace {

int run_case_meet(const Arguments& arguments) {
  session::RehearsalWish wish;
  wish.people = static_cast<std::size_t>(arguments.whole("--people", 8, 1, 1'000));
  wish.seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  wish.jobs = static_cast<std::size_t>(
      arguments.whole("--jobs", std::clamp(std::thread::hardware_concurrency(), 1U, 16U), 1, 256));
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  Progress progress(session::kRehearsedLevels.size() * wish.people);
  wish.told = [&](std::size_t made, std::size_t) {
    if (made > 0) progress.one_done();
    return true;
  };
  const auto found = session::rehearse(*library, case_id, wish);
  progress.clear();
  if (!found) return refuse(found.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_rehearsal(case_id, *found).c_str(), stdout);
  } else {
    const RehearsalWords words = words_of(*found);
    std::printf("%s\n", words.found.c_str());
    for (const std::string& line : words.levels) std::printf("  %s\n", line.c_str());
    for (const std::string& line : words.missed) std::printf("  %s\n", line.c_str());
    std::printf("%s\n", words.operators.c_str());
  }
  return found->passed() > 0 ? kDone : kCheckFailed;
}

constexpr Option kMeetOptions[] = {
    kLibrary,
    {"--people", "P", "how many at each level: novice, intermediate, expert; default 8"},
    {"--seed", "N", "decides who they are and how it goes; default 1"},
    {"--jobs", "N", "threads; default one for each core. The results are the same"},
    kJson};

}  // namespace

Command case_meet_command() {
  return {.name = "case meet",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kMeetOptions,
          .summary = "Can the case be passed? Simulated operators try it; graded, not kept. 1 when nobody passes.",
          .run = &run_case_meet};
}

}  // namespace seldinger::app
