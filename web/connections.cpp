#include "web/connections.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <variant>

#include "casedb/database/credentials.h"
#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::web {
namespace {

bool would_block() noexcept {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

// Nobody waits for a thread that is gone.
struct EndedLater {
  std::function<void()> end;
  ~EndedLater() { end(); }
};

// "127.0.0.1", "::1"; of a kind that we do not know: all are one.
std::string address_text(const sockaddr_storage& from) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (from.ss_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &from, sizeof v4);
    ::inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size());
  } else if (from.ss_family == AF_INET6) {
    sockaddr_in6 v6{};
    std::memcpy(&v6, &from, sizeof v6);
    ::inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size());
  }
  return text.data();
}

}  // namespace

Response short_refusal(int status) {
  Response refused{
      .status = status, .content_type = "text/plain; charset=utf-8", .body = "The request is refused.\n"};
  if (status == 503) refused.headers.emplace_back("Retry-After", "5");
  return refused;
}

Connections::Connections(int listening, Hooks hooks, const ConnectionLimits& limits)
    : listening_(listening),
      hooks_(std::move(hooks)),
      limits_(limits),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (wake_ < 0) throw base::Failure("network", "the server has no file handles left");
}

Connections::~Connections() {
  while (!table_.empty()) close(table_.begin());
  ::close(wake_);
}

void Connections::wake() noexcept {
  const std::uint64_t one = 1;
  // Full is awake as well.
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof one);
}

void Connections::stop() noexcept {
  static_assert(std::atomic<bool>::is_always_lock_free);
  const int before = errno;
  stopping_.store(true);
  wake();
  errno = before;
}

void Connections::hand_over(std::uint64_t connection, std::string bytes) {
  bytes_on_their_way_ += bytes.size();
  answers_.emplace_back(connection, std::move(bytes));
  wake();
}

void Connections::answer(std::uint64_t connection, std::string bytes) {
  std::unique_lock lock(mutex_);
  taken_.wait(lock, [&] { return ended_ || bytes_on_their_way_ < limits_.most_unsent_bytes / 4; });
  hand_over(connection, std::move(bytes));
}

void Connections::refuse(std::uint64_t id, Connection& connection, int status) {
  casedb::wipe(connection.received);
  connection.state = State::asking;
  const std::lock_guard lock(mutex_);
  hand_over(id, bytes_of(short_refusal(status), true));
}

Connections::Table::iterator Connections::close(Table::iterator which) {
  casedb::wipe(which->second.received);
  casedb::wipe(which->second.unsent);
  ::close(which->second.socket);
  return table_.erase(which);
}

void Connections::drop(Table::iterator which) {
  hooks_.on_dropped(which->second.address);
  close(which);
}

Connections::Table::iterator Connections::oldest(const std::function<bool(const Connection&)>& of_those) {
  return std::find_if(table_.begin(), table_.end(), [&](const auto& one) { return of_those(one.second); });
}

// The address's own oldest that waits goes first; when all is full, the oldest of the address that holds most. What
// is being answered is never dropped. False: there is no room.
bool Connections::make_room(const std::string& address) {
  const auto waits_for = [&](const Connection& one) {
    return one.state == State::reading && one.address == address;
  };
  const auto own =
      std::count_if(table_.begin(), table_.end(), [&](const auto& one) { return waits_for(one.second); });
  if (static_cast<std::size_t>(own) >= limits_.most_waiting_of_address) drop(oldest(waits_for));
  if (table_.size() < limits_.most) return true;
  std::map<std::string, std::size_t> held;
  for (const auto& [id, one] : table_)
    if (one.state != State::asking) ++held[one.address];
  if (held.empty()) return false;
  const auto most =
      std::max_element(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  drop(oldest([&](const Connection& one) { return one.state != State::asking && one.address == most->first; }));
  return true;
}

// An address may hold as many of a lane as it leaves free: however many others hold it, there is room for one more.
bool Connections::has_room(Lane lane, const std::string& address) const {
  std::size_t own = 0, all = 0;
  for (const auto& [id, one] : table_) {
    if (one.state != State::asking || one.lane != lane) continue;
    ++all;
    if (one.address == address) ++own;
  }
  return own + all < limits_.most_asking[static_cast<std::size_t>(lane)];
}

void Connections::accept_one(int socket, std::string address) {
  if (!make_room(address)) {
    const std::string refused = bytes_of(short_refusal(503), true);
    [[maybe_unused]] const ssize_t sent =
        ::send(socket, refused.data(), refused.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    ::close(socket);
    return;
  }
  // What the kernel keeps for who does not read; it doubles this.
  const int most_kept = 64 * 1024;
  ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &most_kept, sizeof most_kept);
  const std::uint64_t id = next_id_++;
  Connection& connection = table_[id];
  connection.socket = socket;
  connection.address = std::move(address);
  connection.deadline = Clock::now() + limits_.read;
  if (!read(id, connection)) close(table_.find(id));  // mostly it is here already
}

void Connections::accept_all() {
  for (int i = 0; i < 64; ++i) {  // then those that are here have their turn
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    sockaddr* const generic = reinterpret_cast<sockaddr*>(&from);
    const int socket = ::accept4(listening_, generic, &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket >= 0) {
      accept_one(socket, address_text(from));
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      // No file is left: the oldest that waits makes room, or the next moment does.
      const auto waits = oldest([](const Connection& one) { return one.state != State::asking; });
      if (waits == table_.end()) return;
      drop(waits);
    } else if (errno == EBADF || errno == EINVAL || errno == ENOTSOCK) {
      throw base::Failure("network", "the listening socket failed");
    } else if (errno != ECONNABORTED && errno != EINTR) {
      return;
    }
  }
}

void Connections::take_request(std::uint64_t id, Connection& connection) {
  const auto head_bytes = head_size(connection.received);
  if (!head_bytes) {
    if (connection.received.size() >= kMaxHeadBytes) refuse(id, connection, 431);
    return;
  }
  auto parsed = parse_head(std::string_view(connection.received).substr(0, *head_bytes));
  if (const auto* refused = std::get_if<Refusal>(&parsed)) return refuse(id, connection, refused->status);
  Head& head = std::get<Head>(parsed);
  if (connection.received.size() < *head_bytes + head.body_bytes) {
    wipe(head.request);
    return;
  }
  const Lane lane = hooks_.lane_of(head.request);
  if (!has_room(lane, connection.address)) {
    wipe(head.request);
    return refuse(id, connection, 503);
  }
  head.request.body.assign(connection.received, *head_bytes, head.body_bytes);
  head.request.from = connection.address;
  casedb::wipe(connection.received);
  connection.state = State::asking;
  connection.lane = lane;
  hooks_.on_request(id, lane, std::move(head.request));
}

bool Connections::read(std::uint64_t id, Connection& connection) {
  const std::size_t room = kMaxHeadBytes + kMaxBodyBytes - connection.received.size();
  const ssize_t count = ::recv(connection.socket, buffer_.data(), std::min(room, buffer_.size()), MSG_DONTWAIT);
  if (count < 0 && would_block()) return true;
  if (count <= 0) return false;
  const std::string_view came(buffer_.data(), static_cast<std::size_t>(count));
  casedb::append_secret(connection.received, came);
  casedb::wipe(std::span(buffer_.data(), came.size()));
  take_request(id, connection);
  return true;
}

bool Connections::write(Connection& connection) {
  while (connection.sent < connection.unsent.size()) {
    const ssize_t count = ::send(connection.socket, connection.unsent.data() + connection.sent,
                                 connection.unsent.size() - connection.sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count < 0) return would_block();
    connection.sent += static_cast<std::size_t>(count);
  }
  casedb::wipe(connection.unsent);
  connection.unsent.shrink_to_fit();
  // Closing with unread bytes would reset the connection and could destroy the answer on its way: read on a little.
  ::shutdown(connection.socket, SHUT_WR);
  connection.state = State::lingering;
  connection.deadline = Clock::now() + limits_.linger;
  connection.sent = 0;  // from here on: bytes dropped
  return true;
}

bool Connections::linger(Connection& connection) {
  constexpr std::size_t kMostDropped = 1024 * 1024;
  const ssize_t count = ::recv(connection.socket, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
  if (count < 0 && would_block()) return true;
  if (count <= 0) return false;
  connection.sent += static_cast<std::size_t>(count);
  return connection.sent < kMostDropped;
}

void Connections::send_answers() {
  std::vector<std::pair<std::uint64_t, std::string>> answers;
  {
    const std::lock_guard lock(mutex_);
    answers.swap(answers_);
    bytes_on_their_way_ = 0;
  }
  taken_.notify_all();
  for (auto& [id, bytes] : answers) {
    const auto found = table_.find(id);
    CHECK(found != table_.end() && found->second.state == State::asking);
    if (bytes.empty()) {
      close(found);
      continue;
    }
    found->second.unsent = std::move(bytes);
    found->second.sent = 0;
    found->second.state = State::writing;
    found->second.deadline = Clock::now() + limits_.write;
    if (!write(found->second)) close(found);
  }
  if (!answers.empty()) bound_unsent();
}

// Who asks for much and reads nothing is closed, oldest first, until the rest is bearable.
void Connections::bound_unsent() {
  for (;;) {
    std::size_t in_all = 0;
    std::map<std::string, std::size_t> held;
    for (const auto& [id, one] : table_) {
      if (one.state != State::writing) continue;
      in_all += one.unsent.size();
      held[one.address] += one.unsent.size();
    }
    if (in_all <= limits_.most_unsent_bytes) return;
    const auto most = std::max_element(held.begin(), held.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    drop(oldest([&](const Connection& one) { return one.state == State::writing && one.address == most->first; }));
  }
}

void Connections::pass_deadlines() {
  const auto now = Clock::now();
  for (auto it = table_.begin(); it != table_.end();) {
    Connection& one = it->second;
    if (one.state == State::asking || one.deadline > now) {
      ++it;
    } else if (one.state == State::reading) {
      refuse(it->first, one, 408);
      ++it;
    } else {
      it = close(it);
    }
  }
}

int Connections::ms_to_next_deadline() const {
  constexpr std::chrono::milliseconds kLongest{1000};
  auto next = Clock::now() + kLongest;
  for (const auto& [id, one] : table_)
    if (one.state != State::asking) next = std::min(next, one.deadline);
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now());
  return static_cast<int>(std::clamp(left, std::chrono::milliseconds(0), kLongest).count());
}

void Connections::serve(const std::vector<std::pair<std::uint64_t, short>>& ready) {
  for (const auto& [id, events] : ready) {
    const auto found = table_.find(id);
    if (found == table_.end()) continue;
    Connection& one = found->second;
    const bool open = one.state == State::reading     ? read(id, one)
                      : one.state == State::writing   ? write(one)
                      : one.state == State::lingering ? linger(one)
                                                      : true;
    if (!open) close(found);
  }
}

void Connections::wait_and_serve() {
  std::vector<pollfd> waited = {{wake_, POLLIN, 0}, {stopping_.load() ? -1 : listening_, POLLIN, 0}};
  std::vector<std::uint64_t> ids = {0, 0};
  for (const auto& [id, one] : table_) {
    if (one.state == State::asking) continue;
    waited.push_back({one.socket, static_cast<short>(one.state == State::writing ? POLLOUT : POLLIN), 0});
    ids.push_back(id);
  }
  if (::poll(waited.data(), waited.size(), ms_to_next_deadline()) < 0 && errno != EINTR)
    throw base::Failure("network", "the server cannot wait for its connections");
  std::uint64_t woken = 0;
  [[maybe_unused]] const ssize_t drained = ::read(wake_, &woken, sizeof woken);
  std::vector<std::pair<std::uint64_t, short>> ready;
  for (std::size_t i = 2; i < waited.size(); ++i)
    if (waited[i].revents != 0) ready.emplace_back(ids[i], waited[i].revents);
  serve(ready);
  send_answers();
  pass_deadlines();
  if (waited[1].revents != 0) accept_all();
}

// Who has asked gets the answer; who has not is closed.
void Connections::finish() {
  for (auto it = table_.begin(); it != table_.end();)
    it = it->second.state == State::reading ? close(it) : std::next(it);
  const auto deadline = Clock::now() + limits_.stop;
  while (!table_.empty() && Clock::now() < deadline) wait_and_serve();
}

void Connections::run() {
  const EndedLater ended{[this] {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    taken_.notify_all();
  }};
  while (!stopping_.load()) wait_and_serve();
  finish();
}

}  // namespace seldinger::web
