// Was: the server's memory, with passwords that passed through it, could be read by other processes of its user and
// was written to disk when it crashed.
#include "app/library/serving.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace seldinger::app {
namespace {

TEST(Serving, TheServersMemoryIsItsOwn) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    keep_memory_to_itself();
    rlimit core{1, 1};
    const bool none = ::getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_cur == 0 && core.rlim_max == 0;
    ::_exit(none && ::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) == 0 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

// Asked before a case is made for it; a taken port was told when all was made.
TEST(Serving, WhetherItCouldIsKnownBefore) {
  const int listening = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listening, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listening, 1), 0);
  ASSERT_EQ(::getsockname(listening, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const int port = ntohs(address.sin_port);
  EXPECT_EQ(can_serve({"127.0.0.1", port, false}).error().code, "port_taken");
  EXPECT_TRUE(can_serve({"127.0.0.1", port, true}));
  EXPECT_EQ(can_serve({"0.0.0.0", 0, false}).error().code, "not_loopback");
  ::close(listening);
  EXPECT_TRUE(can_serve({"127.0.0.1", port, false}));
  EXPECT_TRUE(can_serve({"127.0.0.1", port, false})) << "it holds nothing";
}

}  // namespace
}  // namespace seldinger::app
