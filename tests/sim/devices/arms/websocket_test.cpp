// Tests of sim/devices/arms/websocket: both ends on loopback, where one of them breaks the protocol.
#include "sim/devices/arms/websocket.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/fixtures/until.h"

namespace seldinger::devices {
namespace {

// Who greets with bytes beside the protocol, and goes on with them until the other end is gone.
struct Babbler final : WebSocketPeer {
  void opened(WebSocketLink& link) override { link.say_raw(bytes); }
  void heard(WebSocketLink&, std::string_view) override {}
  void closed() override { ++ended; }
  void ticked(WebSocketLink* link) override {
    if (link != nullptr) link->say_raw(bytes);
  }
  std::string bytes = std::string(1 << 20, 'x');  // more than a socket takes at once: they are still being sent
                                                  // when the other end says that it closes, which is to be answered
  std::atomic<int> ended = 0;
};

struct Listener final : WebSocketPeer {
  void opened(WebSocketLink&) override { ++begun; }
  void heard(WebSocketLink&, std::string_view) override {}
  void closed() override {}
  void ticked(WebSocketLink*) override {}
  std::atomic<int> begun = 0;
};

TEST(WebSocket, WhoIsClosedWhileItBabblesIsThereForTheNext) {
  Babbler babbler;
  WebSocketPlace place;
  place.port = 0;
  auto server = WebSocketServer::listen(place, babbler);
  ASSERT_TRUE(server);
  Listener listener;
  place.port = (*server)->port();
  place.retry_s = 0.001;
  const WebSocketClient client(place, listener);
  fixtures::until([&] { return listener.begun >= 20 && babbler.ended >= 20; });
  EXPECT_GE(listener.begun, 20) << "the client found its way back each time";
  EXPECT_GE(babbler.ended, 20);
}

}  // namespace
}  // namespace seldinger::devices
