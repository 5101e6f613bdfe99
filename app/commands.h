// Every command of the program, and what help says of them.
#pragma once

#include <span>
#include <string>

#include "app/cli/command.h"

namespace seldinger::app {

// Every command, in the order in which help lists them; a command's row is made in its cmd_*.cpp.
std::span<const Command> commands();

// `seldinger help` and docs/commands.md.
std::string help_text();
std::string help_text(const Command& command);
std::string commands_markdown();

// Of bench, goals and haptics stability: becomes seldinger-measure, which lies beside this program.
int run_measure(const Arguments& arguments);

}  // namespace seldinger::app
