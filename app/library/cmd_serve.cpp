// serve.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/serving.h"

namespace seldinger::app {
namespace {

int run_serve(const Arguments& arguments) {
  const int port = static_cast<int>(arguments.whole("--port", 8080, 0, 65535));
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto served = serve_until_stopped(
      std::move(*library), {arguments.text("--host", "127.0.0.1"), port, false, arguments.text("--behind", "")},
      [](const std::string& url) {
        std::printf("%s\n", url.c_str());
        std::fflush(stdout);
      });
  return served ? kDone : refuse(served.error());
}

constexpr Option kServeOptions[] = {
    kLibrary,
    {"--host", "ADDRESS", "default 127.0.0.1; only loopback for now"},
    {"--port", "N", "default 8080; 0 takes any free one"},
    {"--behind", "https://NAME",
     "a reverse proxy on this machine serves the pages under that name and adds TLS "
     "(docs/serving.md)"}};

}  // namespace

Command serve_command() {
  return {.name = "serve",
          .options = kServeOptions,
          .summary = "Serves the library's pages on this machine.",
          .run = &run_serve};
}

}  // namespace seldinger::app
