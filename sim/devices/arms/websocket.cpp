#include "sim/devices/arms/websocket.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

namespace seldinger::devices {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using Code = boost::system::error_code;
using Clock = std::chrono::steady_clock;

std::chrono::nanoseconds nanoseconds(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
}

// A device's link is as urgent as the servo that waits for it, and below it (80, engine/servo_loop). Where the
// system does not allow that, the finest timer slack.
constexpr int kPriority = 70;
void be_prompt() {
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted) != 0) ::prctl(PR_SET_TIMERSLACK, 1UL);  // ns
}

// Both ends after TCP is there.
class Session final : public WebSocketLink, public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, WebSocketPeer& peer, std::function<void()> ended)
      : stream_(std::move(socket)), peer_(peer), ended_(std::move(ended)) {
    stream_.read_message_max(kMostMessageBytes);
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::chrono::seconds(2);
    timeout.idle_timeout = websocket::stream_base::none();  // silence is the peer's to judge, and sooner
    timeout.keep_alive_pings = false;
    stream_.set_option(timeout);
    stream_.text(true);
    Code ignored;
    beast::get_lowest_layer(stream_).socket().set_option(tcp::no_delay(true), ignored);
  }

  void greet(const std::string& host) {
    stream_.async_handshake(host, "/", [self = shared_from_this()](Code code) { self->begin(code); });
  }
  void answer() {
    stream_.async_accept([self = shared_from_this()](Code code) { self->begin(code); });
  }
  bool is_open() const { return open_; }

  void say(std::string_view text) override { queue(text, false); }
  void say_raw(std::string_view bytes) override { queue(bytes, true); }
  void hang_up() override {
    Code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }
  double waiting_s() const override {
    return writing_ ? std::chrono::duration<double>(Clock::now() - writing_since_).count() : 0.0;
  }

 private:
  void begin(Code code) {
    if (code) return end();
    open_ = true;
    peer_.opened(*this);
    read();
  }
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](Code code, std::size_t) {
      if (code) return self->end();
      const auto bytes = self->buffer_.cdata();
      self->peer_.heard(*self, {static_cast<const char*>(bytes.data()), bytes.size()});
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }
  void queue(std::string_view bytes, bool raw) {
    if (!open_) return;
    if (writing_) {
      next_.emplace(bytes);
      next_raw_ = raw;
      return;
    }
    text_ = bytes;
    writing_ = true;
    writing_since_ = Clock::now();
    const auto done = [self = shared_from_this()](Code code, std::size_t) {
      self->writing_ = false;
      if (code) return;  // reading will find it too
      if (!self->next_) return;
      const std::string next = std::move(*self->next_);
      self->next_.reset();
      self->queue(next, self->next_raw_);
    };
    if (raw)  // by the socket: the stream may be answering a close or a ping, and allows one writer
      asio::async_write(beast::get_lowest_layer(stream_).socket(), asio::buffer(text_), done);
    else
      stream_.async_write(asio::buffer(text_), done);
  }
  void end() {
    if (ended_already_) return;
    ended_already_ = true;
    hang_up();
    if (open_) peer_.closed();
    open_ = false;
    ended_();
  }

  websocket::stream<beast::tcp_stream, false> stream_;  // without compression: nothing here is worth a millisecond
  WebSocketPeer& peer_;
  std::function<void()> ended_;
  beast::flat_buffer buffer_;
  std::string text_;
  std::optional<std::string> next_;
  bool next_raw_ = false, writing_ = false, open_ = false, ended_already_ = false;
  Clock::time_point writing_since_;
};

// What both ends' threads have: the loop, the session, the tick.
struct Loop {
  Loop(const WebSocketPlace& at, WebSocketPeer& who) : place(at), peer(who), tick(io) {}

  void run() {
    due = Clock::now();
    wait();
    thread = std::thread([this] {
      be_prompt();
      io.run();
    });
  }
  void stop() {
    io.stop();
    if (thread.joinable()) thread.join();
  }
  void wait() {
    const auto period = nanoseconds(place.tick_s);
    due = std::max(due + period, Clock::now());  // ticks that were missed are not made up for
    tick.expires_at(due);
    tick.async_wait([this](Code code) {
      if (code) return;
      peer.ticked(session && session->is_open() ? session.get() : nullptr);
      wait();
    });
  }

  WebSocketPlace place;
  WebSocketPeer& peer;
  asio::io_context io{1};
  asio::steady_timer tick;
  Clock::time_point due;
  std::shared_ptr<Session> session;
  std::thread thread;
};

}  // namespace

struct WebSocketClient::Thread : Loop {
  Thread(const WebSocketPlace& at, WebSocketPeer& who) : Loop(at, who), resolver(io), socket(io), retry(io) {}

  void connect() {
    resolver.async_resolve(place.host, std::to_string(place.port), [this](Code code, const auto& found) {
      if (code) return later();
      asio::async_connect(socket, found, [this](Code failed, const tcp::endpoint&) {
        if (failed) return later();
        session = std::make_shared<Session>(std::move(socket), peer, [this] { later(); });
        session->greet(place.host + ":" + std::to_string(place.port));
      });
    });
  }
  void later() {
    socket = tcp::socket(io);
    retry.expires_after(nanoseconds(place.retry_s));
    retry.async_wait([this](Code code) {
      if (!code) connect();
    });
  }

  tcp::resolver resolver;
  tcp::socket socket;
  asio::steady_timer retry;
};

WebSocketClient::WebSocketClient(const WebSocketPlace& place, WebSocketPeer& peer)
    : thread_(std::make_unique<Thread>(place, peer)) {
  thread_->connect();
  thread_->run();
}

WebSocketClient::~WebSocketClient() {
  thread_->stop();
}

struct WebSocketServer::Thread : Loop {
  Thread(const WebSocketPlace& at, WebSocketPeer& who) : Loop(at, who), acceptor(io) {}

  void accept() {
    acceptor.async_accept([this](Code code, tcp::socket socket) {
      if (code == asio::error::operation_aborted) return;
      if (!code) {
        if (session) session->hang_up();
        session = std::make_shared<Session>(std::move(socket), peer, [] {});
        session->answer();
      }
      accept();
    });
  }

  tcp::acceptor acceptor;
  int port = 0;
};

WebSocketServer::WebSocketServer() = default;

base::Result<std::unique_ptr<WebSocketServer>> WebSocketServer::listen(const WebSocketPlace& place,
                                                                       WebSocketPeer& peer) {
  std::unique_ptr<WebSocketServer> server(new WebSocketServer);
  server->thread_ = std::make_unique<Thread>(place, peer);
  Thread& thread = *server->thread_;
  Code code;
  const auto address = asio::ip::make_address(place.host, code);
  if (code) return base::Error{"bad_address", "the server's address is none of this machine's", {}};
  const tcp::endpoint at(address, static_cast<unsigned short>(place.port));
  thread.acceptor.open(at.protocol(), code);
  if (!code) thread.acceptor.set_option(tcp::acceptor::reuse_address(true), code);
  if (!code) thread.acceptor.bind(at, code);
  if (!code) thread.acceptor.listen(4, code);
  if (code) return base::Error{"port_taken", "cannot listen on port " + std::to_string(place.port), {}};
  thread.port = thread.acceptor.local_endpoint().port();
  thread.accept();
  thread.run();
  return server;
}

WebSocketServer::~WebSocketServer() {
  thread_->stop();
}

int WebSocketServer::port() const noexcept {
  return thread_->port;
}

}  // namespace seldinger::devices
