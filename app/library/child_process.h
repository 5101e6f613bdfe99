// This very program as a child of itself: another command, with what it says read as it comes.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace seldinger::app {

struct ChildEnd {
  int exit_code = -1;          // -1: it was ended from outside
  std::string output, errors;  // the first 64 KiB of each
};

// `doing` gets each line of progress (app/cli/progress.h). Asked to stop, it is told to end (SIGTERM), 3 s later
// ended; it never outlives the thread that called this. It has a lower priority than we have, none of our files but
// its three, and writes no file of more than 8 GiB. Throws base::Failure("no_reader").
ChildEnd run_this_program(const std::vector<std::string>& words, const std::function<void(std::string_view)>& doing,
                          const std::stop_token& stop);

}  // namespace seldinger::app
