// The guard: everything that is not a plain small request is refused.
#include "web/request_guard.h"

#include <gtest/gtest.h>

namespace seldinger::web {
namespace {

// The status of the refusal, 0 when the head passes.
int refused_with(const std::string& head) {
  const auto parsed = parse_head(head);
  const auto* refusal = std::get_if<Refusal>(&parsed);
  return refusal == nullptr ? 0 : refusal->status;
}

std::string get(const std::string& target, const std::string& more = "") {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
}
std::string post(const std::string& more) {
  return "POST /login HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
}

TEST(Guard, APlainRequestPassesWithItsParts) {
  const auto parsed = parse_head(
      "GET /attempts?page=2&x=%41 HTTP/1.1\r\nHost: localhost:1\r\nCOOKIE:\t a=b \r\nREMOTE_ADDR: 6.6.6.6\r\n"
      "X-Real-Ip: 6.6.6.6\r\nRange: bytes=0-1\r\n\r\n");
  const Head* head = std::get_if<Head>(&parsed);
  ASSERT_NE(head, nullptr);
  EXPECT_EQ(head->request.method, "GET");
  EXPECT_EQ(head->request.path, "/attempts");
  EXPECT_EQ(head->request.query, "page=2&x=%41");
  EXPECT_EQ(head->body_bytes, 0U);
  // Only what is needed gets through: neither REMOTE_ADDR nor Range exists further in.
  const std::map<std::string, std::string> kept = {{"host", "localhost:1"}, {"cookie", "a=b"}};
  EXPECT_EQ(head->request.headers, kept);
}

TEST(Guard, BodiesNeedALengthOfAtMost64KiB) {
  EXPECT_EQ(refused_with(post("Content-Length: 65536\r\n")), 0);
  EXPECT_EQ(refused_with(post("Content-Length: 65537\r\n")), 413);
  EXPECT_EQ(refused_with(post("Content-Length: 99999999999999999999999\r\n")), 413);
  EXPECT_EQ(refused_with(post("")), 411);
  for (const char* bad : {"-1", "+5", "0x10", "5,5", "", "5 5"}) {
    EXPECT_EQ(refused_with(post(std::string("Content-Length: ") + bad + "\r\n")), 400) << bad;
  }
  EXPECT_EQ(refused_with(post("Content-Length: 5\r\nContent-Length: 5\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", "Content-Length: 5\r\n")), 400);
}

TEST(Guard, ChunkedCompressedAndExpectingRequestsAreRefused) {
  EXPECT_EQ(refused_with(post("Transfer-Encoding: chunked\r\n")), 411);
  EXPECT_EQ(refused_with(post("Content-Length: 5\r\ntransfer-encoding: identity\r\n")), 411);
  EXPECT_EQ(refused_with(post("Content-Length: 5\r\nContent-Encoding: gzip\r\n")), 415);
  EXPECT_EQ(refused_with(post("Content-Length: 5\r\nExpect: 100-continue\r\n")), 417);
  EXPECT_EQ(refused_with(post("Transfer-Encoding : chunked\r\n")), 400);  // the blank that hides it from others
  EXPECT_EQ(refused_with(post("Content-Length: 5\r\nX: 1\r\n Transfer-Encoding: chunked\r\n")), 400);  // folded
}

TEST(Guard, PathsTakeNoEscapesNoControlsNoBackslash) {
  for (const char* bad : {"/a%00.png", "/%2e%2e/etc", "/..%2fetc", "/..\\etc", "/a\tb", "/a\x01", "/\xC3\xA9", "a",
                          "http://evil/", "*", "/a#b", "//%0d%0a"}) {
    EXPECT_EQ(refused_with(get(bad)), 400) << bad;
  }
  EXPECT_EQ(refused_with(get(std::string("/a\0b", 4))), 400);
  EXPECT_EQ(refused_with(get("/?a\x7f")), 400);
  EXPECT_EQ(refused_with(get("/../../etc/passwd")), 0);  // well formed: the registry knows no such route
  EXPECT_EQ(refused_with(get("/" + std::string(2047, 'a'))), 0);
  EXPECT_EQ(refused_with(get("/" + std::string(2048, 'a'))), 414);
}

TEST(Guard, RequestLinesAreStrict) {
  for (const char* bad :
       {"GET /\r\n\r\n", "GET  / HTTP/1.1\r\n\r\n", "GET / HTTP/1.1 \r\n\r\n", " / HTTP/1.1\r\n\r\n",
        "G\x01T / HTTP/1.1\r\n\r\n", "\r\n\r\n", "GET / FTP/1.1\r\n\r\n"}) {
    EXPECT_EQ(refused_with(bad), 400) << bad;
  }
  EXPECT_EQ(refused_with("GET / HTTP/2.0\r\nHost: localhost\r\n\r\n"), 505);
}

TEST(Guard, HeadersAreCountedAndMeasured) {
  std::string many;
  for (int i = 0; i < 63; ++i) many += "X-" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(refused_with(get("/", many)), 0);
  EXPECT_EQ(refused_with(get("/", many + "X-64: 1\r\n")), 431);
  EXPECT_EQ(refused_with(get("/", "X: " + std::string(kMaxHeadBytes, 'a') + "\r\n")), 431);
}

TEST(Guard, HeadersThatCouldBeReadTwoWaysAreRefused) {
  EXPECT_EQ(refused_with(get("/", "Host: evil.example\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", "Origin: a\r\norigin: b\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", "Cookie: a=1\r\nCookie: b=1\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", "no colon\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", ": empty\r\n")), 400);
  EXPECT_EQ(refused_with(get("/", "X: a\nTransfer-Encoding: chunked\r\n")), 400);  // bare LF
  EXPECT_EQ(refused_with(get("/", "X: a\rY: b\r\n")), 400);                        // bare CR
  EXPECT_EQ(refused_with(get("/", std::string("X: a\0b\r\n", 8))), 400);
}

TEST(Guard, TheHeadEndsWithItsEmptyLine) {
  EXPECT_EQ(head_size("GET / HTTP/1.1\r\n"), std::nullopt);
  EXPECT_EQ(head_size("GET / HTTP/1.1\n\n"), std::nullopt);
  EXPECT_EQ(head_size("A\r\n\r\nbody"), std::optional<std::size_t>(5));
}

}  // namespace
}  // namespace seldinger::web
