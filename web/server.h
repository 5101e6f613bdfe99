// The embedded server: a listening socket, one thread that waits for every connection, and workers that answer
// whole requests. They are read by our own guard and answered by Site.
#pragma once

#include <memory>
#include <string>

#include "sim/base/result.h"
#include "web/site/questions.h"
#include "web/site/surroundings.h"

namespace seldinger::web {

struct ServeOptions {
  std::string host = "127.0.0.1";  // loopback only: there is no TLS
  int port = 8080;                 // 0: any free port
  // "https://sim.example.org": what a reverse proxy on this machine serves these pages as. It writes
  // X-Forwarded-For anew with each request; who asked is taken from there. Empty: there is no proxy, and that
  // header counts nothing.
  std::string behind{};
};

class Server {
 public:
  // Listens when it returns. Refused: `not_loopback`, `bad_port`, `port_taken`, `bad_origin`.
  static base::Result<Server> open(std::unique_ptr<Questions> questions, Surroundings surroundings,
                                   const ServeOptions& options);
  // Whether it would, now: nothing of `host` and `port` is held when this returns. Refused as `open`.
  static base::Result<void> can_listen(const ServeOptions& options);
  Server(Server&&) noexcept;
  Server& operator=(Server&&) noexcept;
  ~Server();

  std::string url() const;  // "http://127.0.0.1:8080"
  int port() const noexcept;

  // Answers until stop(). Throws base::Failure ("network") when the socket dies.
  void run();
  // Makes run() return once what was asked is answered, or 5 s later. From any thread, also from a signal handler;
  // before run() too.
  void stop() noexcept;

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::web
