// A password as somebody types it, or as a file has it.
#pragma once

#include <string>

#include "sim/base/result.h"

namespace seldinger::app {

// One line of standard input; not echoed on a terminal. Whoever called wipes it (casedb::wipe).
std::string read_password();
// The first line of a file; of standard input for "-". `not_found`, `not_readable`.
base::Result<std::string> read_password_of(const std::string& file);

}  // namespace seldinger::app
