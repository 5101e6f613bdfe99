// Every connection, waited for by one thread: who sends slowly, reads slowly or holds a connection open costs a few
// bytes of a table and no worker. One request a connection, with a deadline for each part of it.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "web/request_guard.h"
#include "web/workers.h"

struct pollfd;

namespace seldinger::web {

// A class behind one proxy is one address: what an address may hold open is more than a class needs at a time, and
// what it holds beyond that costs itself, never others.
struct ConnectionLimits {
  std::size_t most = 896;                    // in all; a process has 1024 files by default
  std::size_t most_waiting_of_address = 64;  // whose request has not come whole
  // Whose request is being answered, by lane: of these an address may hold as many as it leaves free, half when it
  // is alone. All lanes together leave room for others to ask; a class of 100 fits into the log-ins.
  std::array<std::size_t, kLanes> most_asking = {384, 224, 128, 128};
  std::size_t most_unsent_bytes = std::size_t{16} << 20;
  std::chrono::milliseconds read{5000};    // the whole request
  std::chrono::milliseconds write{10000};  // the whole answer
  std::chrono::milliseconds linger{1000};  // until the other side has closed, too
  std::chrono::milliseconds stop{5000};    // for answers that are being made when the server is stopped
};

class Connections {
 public:
  struct Hooks {
    std::function<Lane(const Request& request)> lane_of;
    // A whole request; answered later by answer(), or at once.
    std::function<void(std::uint64_t connection, Lane lane, Request request)> on_request;
    // A connection of this address was closed to make room.
    std::function<void(const std::string& address)> on_dropped;
  };
  // `listening` is a socket that listens; it stays the caller's.
  Connections(int listening, Hooks hooks, const ConnectionLimits& limits = {});
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  // Until stop(); then whoever asks is still answered, nobody else. Throws base::Failure ("network") when the
  // listening socket dies.
  void run();
  void stop() noexcept;  // from any thread, also from a signal handler; before run() too
  // The whole answer to its request, from any thread but run()'s; empty: the connection is closed without one.
  // Waits while many bytes are on their way.
  void answer(std::uint64_t connection, std::string bytes);

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { reading, asking, writing, lingering };
  struct Connection {
    int socket = -1;
    std::string address;
    State state = State::reading;
    std::optional<Lane> lane{};  // that makes the answer; none: a refusal
    Clock::time_point deadline;
    std::string received{}, unsent{};
    std::size_t sent = 0;
  };
  using Table = std::map<std::uint64_t, Connection>;  // in the order in which they came

  void wake() noexcept;
  void hand_over(std::uint64_t connection, std::string bytes);  // under mutex_
  void refuse(std::uint64_t id, Connection& connection, int status);
  void accept_all();
  void accept_one(int socket, std::string address);
  bool make_room(const std::string& address);
  Table::iterator close(Table::iterator which);
  void drop(Table::iterator which);
  Table::iterator oldest(const std::function<bool(const Connection&)>& of_those);
  // False: it is closed.
  bool read(std::uint64_t id, Connection& connection);
  void take_request(std::uint64_t id, Connection& connection);
  bool write(Connection& connection);
  bool linger(Connection& connection);
  bool has_room(Lane lane, const std::string& address) const;
  void wait_and_serve();
  void finish();
  void send_answers();
  void bound_unsent();
  void pass_deadlines();
  int ms_to_next_deadline() const;
  void serve(const std::vector<std::pair<std::uint64_t, short>>& ready);

  const int listening_;
  const Hooks hooks_;
  const ConnectionLimits limits_;
  int wake_ = -1;
  std::atomic<bool> stopping_ = false;
  Table table_;
  std::uint64_t next_id_ = 1;
  std::array<char, 16 * 1024> buffer_{};
  std::mutex mutex_;  // guards what follows
  std::condition_variable taken_;
  std::vector<std::pair<std::uint64_t, std::string>> answers_;
  std::size_t bytes_on_their_way_ = 0;
  bool ended_ = false;
};

// Refused before there is a page for it.
Response short_refusal(int status);

}  // namespace seldinger::web
