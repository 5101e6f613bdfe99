// Every command of the program, and what help says of them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/cli/command.h"

namespace seldinger::app {

// Every command, in the order in which help lists them; a command's row is made in its cmd_*.cpp.
std::span<const Command> commands();

// Examples of all of them, without the program's name, in an order in which they can be typed.
std::span<const std::string_view> examples();

// `seldinger help`, `help case`, `help case lesion` and docs/commands.md.
std::string help_text();
std::string help_text_of_noun(std::string_view noun);  // empty: no command begins with that word alone
std::string help_text(const Command& command);
std::string commands_markdown();

// Of bench, goals and haptics stability: becomes seldinger-measure, which lies beside this program.
int run_measure(const Arguments& arguments);

}  // namespace seldinger::app
