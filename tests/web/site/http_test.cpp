// Forms, cookies, hosts and origins: what is read from outside, and the headers of every answer.
#include "web/site/http.h"

#include <gmock/gmock.h>

namespace seldinger::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Forms, DecodePlusPercentAndEmptyValues) {
  const auto fields = form_fields("name=Zo%C3%AB+M&password=a%2Bb%26c&empty=&bare");
  ASSERT_TRUE(fields.has_value());
  EXPECT_EQ(fields->at("name"), "Zoë M");
  EXPECT_EQ(fields->at("password"), "a+b&c");
  EXPECT_EQ(fields->at("empty"), "");
  EXPECT_EQ(fields->at("bare"), "");
  EXPECT_TRUE(form_fields("").has_value());
}

TEST(Forms, BrokenEscapesDoubleNamesAndNulAreRefused) {
  for (const char* bad : {"a=%", "a=%4", "a=%zz", "a=%00", "a=1&a=2", "%6=1"}) {
    EXPECT_FALSE(form_fields(bad).has_value()) << bad;
  }
}

TEST(Cookies, AreFoundByTheirWholeNameAndRefusedWhenGivenTwice) {
  Request request;
  request.headers["cookie"] = "other=1; seldinger_session=abc;xseldinger_session=bad; empty=";
  EXPECT_EQ(cookie(request, "seldinger_session"), "abc");
  EXPECT_EQ(cookie(request, "session"), "");
  EXPECT_EQ(cookie(request, "empty"), "");
  request.headers["cookie"] = "a=1; a=2";
  EXPECT_EQ(cookie(request, "a"), "");
}

TEST(Proxies, AnHttpsOriginIsANameWithOrWithoutAPort) {
  EXPECT_EQ(authority_of_https("https://sim.example.org"), "sim.example.org");
  EXPECT_EQ(authority_of_https("https://sim.example.org:8443"), "sim.example.org:8443");
  for (const char* bad :
       {"", "https://", "http://sim.example.org", "https://sim.example.org/", "https://Sim.example.org",
        "https://sim.example.org:", "https://sim.example.org:123456", "https://.org", "https://a b",
        "https://user@sim.example.org", "https://sim.example.org:80a"})
    EXPECT_FALSE(authority_of_https(bad).has_value()) << bad;
}

TEST(Proxies, WhoAskedIsTheLastWordAndAnAddress) {
  Request request;
  request.from = "127.0.0.1";
  const auto from = [&](const std::string& header) {
    request.headers["x-forwarded-for"] = header;
    return asker_of(request, "sim.example.org");
  };
  EXPECT_EQ(from("10.1.2.3"), "10.1.2.3");
  EXPECT_EQ(from("6.6.6.6, 10.1.2.3 "), "10.1.2.3") << "what a browser sent before it is not believed";
  EXPECT_EQ(from("fd00::1"), "fd00::1");
  for (const char* bad : {"", " ", ",", "10.1.2.3,", "unknown", "10.1.2.3:80", "10.1.2"})
    EXPECT_EQ(from(bad), "127.0.0.1") << bad;
  request.headers["x-forwarded-for"] = "10.1.2.3";
  EXPECT_EQ(asker_of(request, ""), "127.0.0.1") << "without a proxy nobody is believed";
}

TEST(Hosts, OnlyTheLoopbackCounts) {
  for (const char* good :
       {"127.0.0.1", "127.0.0.1:8080", "127.8.9.10:1", "localhost", "localhost:65535", "[::1]", "[::1]:80"}) {
    EXPECT_TRUE(is_loopback_host_header(good)) << good;
  }
  for (const char* bad :
       {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "0.0.0.0", "10.0.0.1:8080",
        "192.168.1.1", "[::]", "[::1", "::1]", "[::1]evil", "127.0.0.1:", "127.0.0.1:80x", "127.1", "2130706433",
        "127.0.0.1:8080:1", "evil.example@127.0.0.1", "[::ffff:127.0.0.1]"}) {
    EXPECT_FALSE(is_loopback_host_header(bad)) << bad;
  }
  EXPECT_TRUE(is_loopback_address("::1"));
  EXPECT_FALSE(is_loopback_address("::"));
  EXPECT_FALSE(is_loopback_address("0.0.0.0"));
}

TEST(Origins, TheBrowserMustSayThatThePageIsOurs) {
  struct Row {
    const char *origin, *site;
    bool same;
  };
  for (const Row& row :
       {Row{"", "", false}, Row{"null", "", false}, Row{"http://127.0.0.1:8080", "", true},
        Row{"http://127.0.0.1:9090", "", false}, Row{"https://127.0.0.1:8080", "", false},
        Row{"null", "same-origin", true}, Row{"", "same-origin", true}, Row{"", "same-site", false},
        Row{"", "cross-site", false}, Row{"", "none", false}, Row{"http://127.0.0.1:8080", "cross-site", false},
        Row{"http://evil.example", "same-origin", false}, Row{"null", "cross-site", false}}) {
    Request request;
    request.headers["host"] = "127.0.0.1:8080";
    if (*row.origin != 0) request.headers["origin"] = row.origin;
    if (*row.site != 0) request.headers["sec-fetch-site"] = row.site;
    EXPECT_EQ(is_same_origin(request), row.same) << row.origin << " " << row.site;
  }
}

TEST(Answers, CarryThePolicyTheirLengthAndTheEndOfTheConnection) {
  const std::string bytes = bytes_of({.status = 404, .body = "gone", .headers = {{"X-A", "b"}}}, true);
  EXPECT_EQ(bytes.substr(0, bytes.find("\r\n")), "HTTP/1.1 404 Not Found");
  for (const char* line :
       {"default-src 'none'; style-src 'self'; img-src 'self'; form-action 'self'; base-uri 'none'; "
        "frame-ancestors 'none'\r\n",
        "X-Content-Type-Options: nosniff\r\n", "Referrer-Policy: no-referrer\r\n", "Cache-Control: no-store\r\n",
        "X-Frame-Options: DENY\r\n", "Content-Length: 4\r\n", "Connection: close\r\n", "X-A: b\r\n",
        "\r\n\r\ngone"}) {
    EXPECT_THAT(bytes, HasSubstr(line));
  }
  const std::string head = bytes_of({.status = 200, .body = "gone"}, false);
  EXPECT_THAT(head, HasSubstr("Content-Length: 4\r\n"));
  EXPECT_THAT(head, Not(HasSubstr("gone")));
}

TEST(AnswersDeathTest, ALineBreakInAHeaderEndsTheProgramRatherThanSplitTheAnswer) {
  const Response split{.headers = {{"Location", "/a\r\nSet-Cookie: x=y"}}};
  EXPECT_DEATH(static_cast<void>(bytes_of(split, true)), "");
}

TEST(Tokens, AreEqualOnlyWhenEveryCharacterIs) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "ab"));
  EXPECT_FALSE(equal_in_constant_time("", "a"));
}

}  // namespace
}  // namespace seldinger::web
