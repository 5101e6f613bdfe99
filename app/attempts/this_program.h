// This program, as attempts know it: its version, and pictures as PNG.
#pragma once

#include "session/case/program.h"

namespace seldinger::app {

session::Program this_program();

}  // namespace seldinger::app
