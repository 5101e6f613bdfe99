// A program of commands: finds the command, runs it, and turns what goes wrong into exit codes.
#pragma once

#include <span>

#include "app/cli/command.h"

namespace seldinger::app {

// What main() does with its arguments. Never throws.
int run_program(int argc, char** argv, std::span<const Command> commands);

}  // namespace seldinger::app
