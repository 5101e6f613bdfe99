#include "web/server.h"

#include <fcntl.h>
#include <httplib.h>
#include <malloc.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "web/connections.h"
#include "web/routes/routes.h"
#include "web/site/site.h"
#include "web/workers.h"

namespace seldinger::web {
namespace {

constexpr int kBacklog = 512;

// Opens the listening socket. More of cpp-httplib is not used: it holds a thread for each connection (decision
// 0049).
class Listener final : public httplib::Server {
 public:
  Listener() {
    // Theirs sets SO_REUSEPORT, with which another program of this user could listen beside us and take log-ins.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
  }
  ~Listener() override { close(); }

  // The port; 0 is any. None: it is taken.
  std::optional<int> listen_at(const std::string& address, int port) {
    const int bound = port == 0 ? bind_to_any_port(address) : bind_to_port(address, port) ? port : -1;
    if (bound <= 0) return std::nullopt;
    ::listen(file(), kBacklog);  // theirs listens with a queue of 5
    ::fcntl(file(), F_SETFL, ::fcntl(file(), F_GETFL) | O_NONBLOCK);
    return bound;
  }
  int file() const noexcept { return svr_sock_; }
  void close() noexcept {
    if (const socket_t socket = svr_sock_.exchange(INVALID_SOCKET); socket != INVALID_SOCKET) ::close(socket);
  }
};

}  // namespace

struct Server::Parts {
  Parts(std::unique_ptr<Questions> questions_in, Surroundings surroundings_in,
        std::unique_ptr<Listener> listener_in)
      : questions(std::move(questions_in)),
        surroundings(std::move(surroundings_in)),
        listener(std::move(listener_in)),
        site(*questions, surroundings, routes()),
        connections(listener->file(),
                    {[this](const Request& request) { return site.lane_of(request); },
                     [this](std::uint64_t id, Lane lane, Request request) {
                       request.from = asker_of(request, surroundings.public_authority);
                       workers->add(lane, {id, std::move(request)});
                     },
                     [this](const std::string& address) { site.security.note("connection dropped", address); }},
                    limits_behind(this->surroundings)) {}

  // All of a proxy's connections are of one address; it holds back requests that have not come whole.
  static ConnectionLimits limits_behind(const Surroundings& where) {
    ConnectionLimits limits;
    if (!where.public_authority.empty()) limits.most_waiting_of_address = limits.most;
    return limits;
  }

  // Once a minute, so that no request waits for it.
  void keep_sessions(const std::stop_token& stop) noexcept {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      never.wait_for(lock, stop, std::chrono::minutes(1), [] { return false; });
      if (stop.stop_requested()) return;
      try {
        site.keep_sessions();
      } catch (const std::exception&) {
        // The next minute.
      }
    }
  }

  void answer(QueuedRequest job) noexcept {
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
  std::unique_ptr<Listener> listener;
  Site site;
  Connections connections;
  std::optional<Workers> workers;  // while it runs
  std::string url;
};

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;
Server::~Server() = default;

namespace {

std::string address_of(const ServeOptions& options) {
  return options.host == "localhost" ? "127.0.0.1" : options.host;
}

// The port, which may be any free one.
base::Result<int> listen(Listener& listener, const ServeOptions& options) {
  if (!is_loopback_address(options.host)) {
    return base::Error{"not_loopback", "the server listens on this machine only: 127.0.0.1, ::1 or localhost"};
  }
  if (!options.behind.empty() && !authority_of_https(options.behind))
    return base::Error{"bad_origin",
                       "what a proxy serves is https:// and a name in small letters, with a port or without"};
  if (options.port < 0 || options.port > 65535) return base::Error{"bad_port", "a port is 0 to 65535"};
  const auto port = listener.listen_at(address_of(options), options.port);
  if (!port) return base::Error{"port_taken", "cannot listen on port " + std::to_string(options.port)};
  return *port;
}

}  // namespace

base::Result<void> Server::can_listen(const ServeOptions& options) {
  Listener listener;
  const auto port = listen(listener, options);
  if (!port) return port.error();
  return {};
}

base::Result<Server> Server::open(std::unique_ptr<Questions> questions, Surroundings surroundings,
                                  const ServeOptions& options) {
  ::mallopt(M_ARENA_MAX, 2);  // each thread's own would keep what its largest answer took
  const std::string address = address_of(options);
  auto listener = std::make_unique<Listener>();
  const auto port = listen(*listener, options);
  if (!port) return port.error();
  surroundings.port = *port;
  if (!options.behind.empty()) surroundings.public_authority = *authority_of_https(options.behind);
  auto parts = std::make_unique<Parts>(std::move(questions), std::move(surroundings), std::move(listener));
  const std::string shown = address == "::1" ? "[::1]" : address;
  parts->url = "http://" + shown + ":" + std::to_string(*port);
  return Server(std::move(parts));
}

std::string Server::url() const {
  return parts_->url;
}
int Server::port() const noexcept {
  return parts_->surroundings.port;
}

void Server::run() {
  Parts& parts = *parts_;
  parts.workers.emplace([&parts](QueuedRequest job) { parts.answer(std::move(job)); });
  const std::jthread keeper([&parts](const std::stop_token& stop) { parts.keep_sessions(stop); });
  try {
    parts.connections.run();
  } catch (...) {
    parts.workers.reset();
    throw;
  }
  parts.listener->close();  // nobody connects to what does not answer
  parts.workers.reset();
}

void Server::stop() noexcept {
  parts_->connections.stop();
}

}  // namespace seldinger::web
