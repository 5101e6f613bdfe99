#include "web/server.h"

#include <arpa/inet.h>
#include <malloc.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <utility>

#include "web/connections.h"
#include "web/routes.h"
#include "web/site.h"
#include "web/workers.h"

namespace seldinger::web {
namespace {

constexpr int kBacklog = 512;

class Socket {
 public:
  explicit Socket(int file = -1) noexcept : file_(file) {}
  Socket(Socket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  Socket& operator=(Socket&&) = delete;
  ~Socket() { close(); }
  int file() const noexcept { return file_; }
  void close() noexcept {
    if (file_ >= 0) ::close(std::exchange(file_, -1));
  }

 private:
  int file_;
};

struct Listening {
  Socket socket;
  int port = 0;
};

// `address` is of the loopback. Nothing: the port is taken.
std::optional<Listening> listen_at(const std::string& address, int port) {
  sockaddr_storage at{};
  socklen_t size = 0;
  if (address == "::1") {
    sockaddr_in6 v6{};
    v6.sin6_family = AF_INET6;
    v6.sin6_addr = in6addr_loopback;
    v6.sin6_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&at, &v6, size = sizeof v6);
  } else {
    sockaddr_in v4{};
    v4.sin_family = AF_INET;
    ::inet_pton(AF_INET, address.c_str(), &v4.sin_addr);
    v4.sin_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&at, &v4, size = sizeof v4);
  }
  sockaddr* const generic = reinterpret_cast<sockaddr*>(&at);
  Listening listening{Socket(::socket(at.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0))};
  const int file = listening.socket.file(), yes = 1;
  // Not SO_REUSEPORT, with which another program of this user could listen beside us and take log-ins.
  ::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(file, generic, size) != 0 || ::listen(file, kBacklog) != 0) return std::nullopt;
  if (::getsockname(file, generic, &size) != 0) return std::nullopt;
  // The port stands at the same place for both kinds of address.
  sockaddr_in bound{};
  std::memcpy(&bound, &at, sizeof bound);
  listening.port = ntohs(bound.sin_port);
  return listening;
}

}  // namespace

struct Server::Parts {
  Parts(std::unique_ptr<Questions> questions_in, Surroundings surroundings_in, Listening listening_in)
      : questions(std::move(questions_in)),
        surroundings(std::move(surroundings_in)),
        listening(std::move(listening_in)),
        site(*questions, surroundings),
        connections(listening.socket.file(),
                    {[this](std::uint64_t id, Request request) {
                       const Lane lane = lane_of(request);
                       workers->add(lane, {id, std::move(request)});
                     },
                     [this](const std::string& address) { site.security.note("connection dropped", address); }}) {}

  void answer(Job job) noexcept {
    std::string bytes;
    try {
      Response response = site.answer(job.request);
      bytes = bytes_of(response, job.request.method != "HEAD");
      wipe(response);
    } catch (const std::exception&) {
      // Out of memory, at worst: this connection ends, the server stays.
      surroundings.log("error: internal: a connection was dropped");
    }
    wipe(job.request);
    connections.answer(job.connection, std::move(bytes));
  }

  std::unique_ptr<Questions> questions;
  Surroundings surroundings;
  Listening listening;
  Site site;
  Connections connections;
  std::optional<Workers> workers;  // while it runs
  std::string url;
};

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;
Server::~Server() = default;

base::Result<Server> Server::open(std::unique_ptr<Questions> questions, Surroundings surroundings,
                                  const ServeOptions& options) {
  if (!is_loopback_address(options.host)) {
    return base::Error{"not_loopback", "the server listens on this machine only: 127.0.0.1, ::1 or localhost"};
  }
  ::mallopt(M_ARENA_MAX, 2);  // each thread's own would keep what its largest answer took
  if (options.port < 0 || options.port > 65535) return base::Error{"bad_port", "a port is 0 to 65535"};
  const std::string address = options.host == "localhost" ? "127.0.0.1" : options.host;
  auto listening = listen_at(address, options.port);
  if (!listening) return base::Error{"port_taken", "cannot listen on port " + std::to_string(options.port)};
  surroundings.port = listening->port;
  auto parts = std::make_unique<Parts>(std::move(questions), std::move(surroundings), std::move(*listening));
  const std::string shown = address == "::1" ? "[::1]" : address;
  parts->url = "http://" + shown + ":" + std::to_string(parts->listening.port);
  return Server(std::move(parts));
}

std::string Server::url() const {
  return parts_->url;
}
int Server::port() const noexcept {
  return parts_->listening.port;
}

void Server::run() {
  Parts& parts = *parts_;
  parts.workers.emplace([&parts](Job job) { parts.answer(std::move(job)); });
  try {
    parts.connections.run();
  } catch (...) {
    parts.workers.reset();
    throw;
  }
  parts.listening.socket.close();  // nobody connects to what does not answer
  parts.workers.reset();
}

void Server::stop() noexcept {
  parts_->connections.stop();
}

}  // namespace seldinger::web
