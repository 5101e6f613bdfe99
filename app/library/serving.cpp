#include "app/library/serving.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <optional>

#include "app/cli/version.h"
#include "app/library/job_program.h"
#include "app/replay/replay_output.h"
#include "casedb/database/audit.h"
#include "session/case/case_check.h"
#include "sim/base/failure.h"
#include "web/library_questions.h"

namespace seldinger::app {
namespace {

std::atomic<web::Server*> running = nullptr;

void on_signal(int) {
  if (web::Server* server = running.load()) server->stop();
}

}  // namespace

void keep_memory_to_itself() {
  const rlimit none{0, 0};
  if (::setrlimit(RLIMIT_CORE, &none) != 0 || ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0)
    throw base::Failure("memory", "the system does not let this process protect its memory from others");
}

base::Result<void> can_serve(const ServeAt& at) {
  auto free = web::Server::can_listen({at.host, at.port});
  if (!free && free.error().code == "port_taken" && at.any_port_if_taken) return {};
  return free;
}

base::Result<void> serve_until_stopped(casedb::Library library, const ServeAt& at,
                                       const std::function<void(const std::string& url)>& ready) {
  keep_memory_to_itself();
  const std::filesystem::path folder = library.folder();
  const casedb::Actor starts = library.actor();
  const auto log = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const web::HeavyWork work{session::check_case, telling_pictures, job_runner(folder)};
  auto server = web::open_server(std::move(library), {at.host, at.port, at.behind}, kVersion, log, work);
  if (!server && server.error().code == "port_taken" && at.any_port_if_taken) {
    auto again = casedb::Library::open(folder);
    if (!again) return again.error();
    server = web::open_server(std::move(*again), {at.host, 0, at.behind}, kVersion, log, work);
  }
  if (!server) return server.error();
  auto noted = casedb::Library::open(folder);
  if (!noted) return noted.error();
  casedb::audit_alone(*noted, starts, casedb::Act::start_server, {}, casedb::Outcome::done);
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
