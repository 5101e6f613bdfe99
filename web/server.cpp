#include "web/server.h"

#include <poll.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <httplib.h>
#pragma GCC diagnostic pop

#include "sim/base/check.h"
#include "sim/base/failure.h"
#include "web/request_guard.h"
#include "web/site.h"

namespace seldinger::web {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// A slow client holds one worker until its deadline, so there are more workers than slow clients we promise to
// stand.
constexpr std::size_t kWorkers = 64;
constexpr std::size_t kWaiting = 64;
constexpr milliseconds kReadDeadline{5000};    // the whole request
constexpr milliseconds kWriteDeadline{10000};  // the whole answer
constexpr milliseconds kStopLatency{100};
constexpr int kBacklog = 128;

thread_local bool t_overloaded = false;

// Workers and a bounded queue. Beyond it a connection is answered 503 at once, by the thread that accepted it.
class BoundedQueue final : public httplib::TaskQueue {
 public:
  BoundedQueue(const std::atomic<bool>& stopping, std::function<void()> stop_listening)
      : stopping_(stopping), stop_listening_(std::move(stop_listening)) {
    for (std::size_t i = 0; i < kWorkers; ++i) workers_.emplace_back([this] { work(); });
  }

  void enqueue(std::function<void()> task) override {
    on_idle();
    {
      const std::lock_guard lock(mutex_);
      if (held_ < kWorkers + kWaiting) {
        ++held_;
        tasks_.push_back(std::move(task));
        task = nullptr;
      }
    }
    if (task == nullptr) {
      arrived_.notify_one();
    } else {
      t_overloaded = true;
      task();
      t_overloaded = false;
    }
  }

  void on_idle() override {
    if (stopping_.load()) stop_listening_();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    arrived_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

 private:
  void work() {
    for (;;) {
      std::function<void()> task;
      {
        std::unique_lock lock(mutex_);
        arrived_.wait(lock, [&] { return ended_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      task();
      const std::lock_guard lock(mutex_);
      --held_;
    }
  }

  const std::atomic<bool>& stopping_;
  std::function<void()> stop_listening_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<std::function<void()>> tasks_;
  std::size_t held_ = 0;  // in work or waiting
  std::vector<std::thread> workers_;
  bool ended_ = false;
};

// One accepted connection.
class Connection {
 public:
  Connection(socket_t socket, const std::atomic<bool>& stopping) : socket_(socket), stopping_(stopping) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { ::close(socket_); }

  // Appends what has come. False when the other side closed, failed, or the deadline passed.
  bool read_some(std::string& received, std::size_t at_most, Clock::time_point deadline) {
    if (!wait_for(POLLIN, deadline)) return false;
    char buffer[4096];
    const ssize_t count = ::recv(socket_, buffer, std::min(sizeof buffer, at_most), MSG_DONTWAIT);
    if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
    received.append(buffer, static_cast<std::size_t>(count));
    return true;
  }

  void write_all(std::string_view bytes, Clock::time_point deadline) {
    while (!bytes.empty() && wait_for(POLLOUT, deadline)) {
      const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (count < 0 && errno != EAGAIN && errno != EINTR) return;
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  // Closing with unread bytes would reset the connection and could destroy the answer on its way: read some on.
  void finish(Clock::time_point deadline) {
    ::shutdown(socket_, SHUT_WR);
    std::string dropped;
    for (std::size_t total = 0; total < 1024 * 1024; total += dropped.size()) {
      dropped.clear();
      if (!read_some(dropped, 4096, deadline)) return;
    }
  }

  bool timed_out() const noexcept { return timed_out_; }

 private:
  bool wait_for(short events, Clock::time_point deadline) {
    for (;;) {
      const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
      if (left.count() <= 0) timed_out_ = true;
      if (left.count() <= 0 || stopping_.load()) return false;
      pollfd waited{socket_, events, 0};
      const int ready = ::poll(&waited, 1, static_cast<int>(std::min(left, kStopLatency).count()));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
  }

  socket_t socket_;
  const std::atomic<bool>& stopping_;
  bool timed_out_ = false;
};

class Listener final : public httplib::Server {
 public:
  Listener(Site& site, const std::atomic<bool>& stopping) : site_(site), stopping_(stopping) {
    // Theirs sets SO_REUSEPORT, with which another program of this user could listen beside us and take log-ins.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_idle_interval(kStopLatency);
    new_task_queue = [this] { return new BoundedQueue(stopping_, [this] { stop(); }); };
  }

  // Bound but never run: nobody else closes it.
  ~Listener() override {
    if (const socket_t socket = svr_sock_.exchange(INVALID_SOCKET); socket != INVALID_SOCKET) ::close(socket);
  }

  // Theirs listens with a queue of 5, which a few slow clients fill.
  void widen_backlog() { ::listen(svr_sock_, kBacklog); }

 private:
  struct Got {
    std::optional<Request> request;
    int refused_with = 0;  // 0: the other side is gone, nobody to answer
  };

  Got read_request(Connection& connection) const {
    const Clock::time_point deadline = Clock::now() + kReadDeadline;
    std::string received;
    std::optional<std::size_t> head_bytes;
    while (!(head_bytes = head_size(received)).has_value()) {
      if (received.size() >= kMaxHeadBytes) return {{}, 431};
      if (!connection.read_some(received, kMaxHeadBytes - received.size(), deadline)) {
        return {{}, connection.timed_out() ? 408 : 0};
      }
    }
    auto parsed = parse_head(std::string_view(received).substr(0, *head_bytes));
    if (const auto* refused = std::get_if<Refusal>(&parsed)) return {{}, refused->status};
    Head& head = std::get<Head>(parsed);
    std::string body = received.substr(*head_bytes, head.body_bytes);
    while (body.size() < head.body_bytes) {
      if (!connection.read_some(body, head.body_bytes - body.size(), deadline)) {
        return {{}, connection.timed_out() ? 408 : 0};
      }
    }
    head.request.body = std::move(body);
    return {std::move(head.request), 0};
  }

  static Response short_refusal(int status) {
    return {.status = status, .content_type = "text/plain; charset=utf-8", .body = "The request is refused.\n"};
  }

  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, stopping_);
    try {
      if (t_overloaded) {  // on the accepting thread: no waiting here
        connection.write_all(bytes_of(short_refusal(503), true), Clock::now() + milliseconds(50));
        return true;
      }
      const Got got = read_request(connection);
      if (!got.request.has_value() && got.refused_with == 0) return true;
      const bool with_body = !got.request.has_value() || got.request->method != "HEAD";
      const Response response =
          got.request.has_value() ? site_.answer(*got.request) : short_refusal(got.refused_with);
      connection.write_all(bytes_of(response, with_body), Clock::now() + kWriteDeadline);
      connection.finish(Clock::now() + milliseconds(got.request.has_value() ? 200 : 1000));
    } catch (const std::exception&) {
      // Out of memory, at worst: this connection ends, the server stays.
      site_.surroundings.log("error: internal: a connection was dropped");
    }
    return true;
  }

  Site& site_;
  const std::atomic<bool>& stopping_;
};

}  // namespace

struct Server::Parts {
  Parts(std::unique_ptr<Questions> questions_in, Surroundings surroundings_in)
      : questions(std::move(questions_in)),
        surroundings(std::move(surroundings_in)),
        site(*questions, surroundings),
        listener(site, stopping) {}

  std::unique_ptr<Questions> questions;
  Surroundings surroundings;
  Site site;
  std::atomic<bool> stopping = false;
  Listener listener;
  std::string url;
  int port = 0;
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
  if (options.port < 0 || options.port > 65535) return base::Error{"bad_port", "a port is 0 to 65535"};
  auto parts = std::make_unique<Parts>(std::move(questions), std::move(surroundings));
  const std::string address = options.host == "localhost" ? "127.0.0.1" : options.host;
  if (options.port == 0) {
    parts->port = parts->listener.bind_to_any_port(address);
  } else if (parts->listener.bind_to_port(address, options.port)) {
    parts->port = options.port;
  }
  if (parts->port <= 0) {
    return base::Error{"port_taken", "cannot listen on port " + std::to_string(options.port)};
  }
  parts->listener.widen_backlog();
  const std::string shown = address == "::1" ? "[::1]" : address;
  parts->url = "http://" + shown + ":" + std::to_string(parts->port);
  return Server(std::move(parts));
}

std::string Server::url() const {
  return parts_->url;
}
int Server::port() const noexcept {
  return parts_->port;
}

void Server::run() {
  const bool ended_well = parts_->listener.listen_after_bind();
  if (!ended_well && !parts_->stopping.load()) throw base::Failure("network", "the listening socket failed");
}

void Server::stop() noexcept {
  static_assert(std::atomic<bool>::is_always_lock_free);
  parts_->stopping.store(true);
}

}  // namespace seldinger::web
