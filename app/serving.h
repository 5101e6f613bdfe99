// Serving the library's pages until the program is told to stop.
#pragma once

#include <functional>
#include <string>

#include "casedb/library.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Blocks until SIGINT or SIGTERM. `ready` gets the address once the port is open. Refused: `not_loopback`; throws
// base::Failure when the port cannot be had.
base::Result<void> serve_until_stopped(casedb::Library library, const std::string& host, int port,
                                       const std::function<void(const std::string& url)>& ready);

}  // namespace seldinger::app
