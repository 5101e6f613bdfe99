#include "app/library/serving.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <optional>

#include "app/cli/version.h"
#include "casedb/database/audit.h"
#include "session/case/case_check.h"
#include "web/library_questions.h"

namespace seldinger::app {
namespace {

std::atomic<web::Server*> running = nullptr;

void on_signal(int) {
  if (web::Server* server = running.load()) server->stop();
}

}  // namespace

base::Result<void> serve_until_stopped(casedb::Library library, const ServeAt& at,
                                       const std::function<void(const std::string& url)>& ready) {
  const std::filesystem::path folder = library.folder();
  casedb::audit_alone(library, casedb::Act::start_server);
  const auto log = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  auto server = web::open_server(std::move(library), {at.host, at.port}, kVersion, log, session::check_case);
  if (!server && server.error().code == "port_taken" && at.any_port_if_taken) {
    auto again = casedb::Library::open(folder);
    if (!again) return again.error();
    server = web::open_server(std::move(*again), {at.host, 0}, kVersion, log, session::check_case);
  }
  if (!server) return server.error();
  running = &*server;
  struct sigaction action {};
  action.sa_handler = on_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ready(server->url());
  server->run();
  running = nullptr;
  return {};
}

}  // namespace seldinger::app
