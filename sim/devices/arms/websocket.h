// Text messages over a WebSocket (RFC 6455), each end on a thread of its own. The one door of Boost.Beast and Asio.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/result.h"

namespace seldinger::devices {

// An open connection; to be used in a peer's calls only. A message that waits is replaced by a newer one: what is
// said here is a state, and only the newest counts.
class WebSocketLink {
 public:
  virtual void say(std::string_view text) = 0;
  virtual void say_raw(std::string_view bytes) = 0;  // beside the protocol: for who tests what others say
  virtual void hang_up() = 0;                        // at once; `closed` follows
  virtual double waiting_s() const = 0;              // for how long a message has been waiting to be sent

 protected:
  ~WebSocketLink() = default;
};

// What happens; all calls come on the connection's thread, one at a time.
class WebSocketPeer {
 public:
  virtual void opened(WebSocketLink& link) = 0;
  virtual void heard(WebSocketLink& link, std::string_view text) = 0;
  virtual void closed() = 0;
  virtual void ticked(WebSocketLink* link) = 0;  // null while there is no connection

 protected:
  ~WebSocketPeer() = default;
};

// Longer messages end a connection: no state of a few devices is as long.
inline constexpr std::size_t kMostMessageBytes = 64 * 1024;

struct WebSocketPlace {
  std::string host = "127.0.0.1";
  int port = 10001;
  double tick_s = 0.001;
  double retry_s = 0.25;  // a client's, after a connection that failed or ended
};

// Connects, and connects again, until it is destroyed.
class WebSocketClient {
 public:
  WebSocketClient(const WebSocketPlace& place, WebSocketPeer& peer);
  ~WebSocketClient();

 private:
  struct Thread;
  std::unique_ptr<Thread> thread_;
};

// Answers one client at a time; a new one takes the place of the old.
class WebSocketServer {
 public:
  // Port 0: any that is free. Refused: `port_taken`.
  static base::Result<std::unique_ptr<WebSocketServer>> listen(const WebSocketPlace& place, WebSocketPeer& peer);
  ~WebSocketServer();
  int port() const noexcept;

 private:
  WebSocketServer();
  struct Thread;
  std::unique_ptr<Thread> thread_;
};

}  // namespace seldinger::devices
