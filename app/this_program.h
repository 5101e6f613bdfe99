// This program, as attempts know it: its version, and pictures as PNG.
#pragma once

#include "app/program.h"

namespace seldinger::app {

Program this_program();

}  // namespace seldinger::app
