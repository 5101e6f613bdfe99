// Serving the library's pages until the program is told to stop.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::app {

struct ServeAt {
  std::string host = "127.0.0.1";
  int port = 8080;  // 0: any free one
  bool any_port_if_taken = false;
  std::string behind{};  // as web::ServeOptions
};

// No picture of this process's memory is written when it dies, nor may another process of this user look into it:
// passwords pass through it. Throws base::Failure ("memory") when the system refuses.
void keep_memory_to_itself();

// Whether it would listen now, asked before anything is made for it. Refused as web::Server::open refuses.
base::Result<void> can_serve(const ServeAt& at);

// Blocks until SIGINT or SIGTERM. `ready` gets the address once the port is open. Refused as web::Server::open
// refuses.
base::Result<void> serve_until_stopped(casedb::Library library, const ServeAt& at,
                                       const std::function<void(const std::string& url)>& ready);

}  // namespace seldinger::app
