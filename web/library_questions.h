// The questions put to a real library, and the server that `seldinger serve` runs over it.
#pragma once

#include <memory>

#include "casedb/library.h"
#include "web/questions.h"
#include "web/server.h"

namespace seldinger::web {

// Opens two further handles of the same library for log-ins, so that hashing a password holds up no page. Refused
// as Library::open.
base::Result<std::unique_ptr<Questions>> questions_of(casedb::Library library);

// As Server::open, with time, chance and hash of this machine. `log` gets one line a fault.
base::Result<Server> open_server(casedb::Library library, const ServeOptions& options, std::string program_version,
                                 std::function<void(const std::string&)> log);

}  // namespace seldinger::web
