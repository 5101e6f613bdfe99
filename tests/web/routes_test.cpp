// Methods, paths, long lists and types of answers.
#include <gmock/gmock.h>

#include <vector>

#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Routes, OtherMethodsAndOtherPathsAreRefused) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT"}) {
    const Response response = browser.send(browser.request(method, "/attempts"));
    EXPECT_EQ(response.status, 405) << method;
    EXPECT_EQ(header_of(response, "Allow"), "GET, HEAD");
  }
  EXPECT_EQ(header_of(browser.send(browser.request("PUT", "/login")), "Allow"), "GET, HEAD, POST");
  for (const char* path : {"/nothing", "/attempts/", "/attempts/x", "/../attempts", "//attempts", "/attempts/..",
                           "/attempts/0190A1B2-0000-7000-8000-0000000000A1", "/style.css/", "/favicon.ico",
                           "/attempts/0190a1b2-0000-7000-8000-0000000000a1/", "/LOGIN"}) {
    EXPECT_EQ(browser.get(path).status, 404) << path;
    EXPECT_EQ(browser.post(path, "token=x").status, 404) << path;
  }
}

TEST(Routes, PagesOfALongListAreCutAndClamped) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  fake.questions.attempts.clear();
  for (int i = 0; i < 120; ++i) {
    std::string id = kOwnAttempt;
    id.replace(33, 3, std::to_string(100 + i));
    fake.questions.attempts.push_back(attempt_row(id, std::nullopt));
  }
  browser.log_in_as(Role::mentor);
  const auto shown = [&](const std::string& path) {
    const std::string html = browser.get(path).body;
    std::size_t count = 0;
    for (std::size_t at = html.find("<tr><th scope=\"row\">"); at != html.npos;
         at = html.find("<tr><th scope=\"row\">", at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(shown("/attempts"), 50U);
  EXPECT_EQ(shown("/attempts?page=3"), 20U);
  EXPECT_EQ(shown("/attempts?page=99999999999999999999999"), 50U);
  for (const char* odd : {"0", "-1", "x", "", "1e3"})
    EXPECT_EQ(shown(std::string("/attempts?page=") + odd), 50U) << odd;
  EXPECT_EQ(shown("/attempts?page=77"), 20U);
}

TEST(Routes, PictureHealthAndMetricsAnswerInTheirTypes) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  const Response picture = browser.get("/attempts/" + kOthersAttempt + "/picture.png");
  EXPECT_EQ(picture.content_type, "image/png");
  EXPECT_EQ(picture.body.size(), fake.questions.picture.size());
  const Response metrics = browser.get("/attempts/" + kOthersAttempt + "/metrics.json");
  EXPECT_EQ(metrics.content_type, "application/json");
  EXPECT_EQ(
      metrics.body,
      R"({"attempt_id":")" + kOthersAttempt +
          R"(","synthetic":false,"metrics":[{"id":"hit","version":1,"value":1.0,"unit":"bool","reason":null},)"
          R"({"id":"vis_joint","version":1,"value":null,"unit":"share","reason":"no_endpoint"}]})"
          "\n");
  EXPECT_EQ(browser.get("/healthz").body, "{\"status\":\"ok\",\"version\":\"9.8.7\"}\n");
  EXPECT_EQ(browser.get("/style.css").content_type, "text/css; charset=utf-8");
}

TEST(Routes, APictureThatIsNoneIsNotServed) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  fake.questions.picture = std::vector<std::byte>(100, std::byte{'<'});
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt + "/picture.png").status, 500);
  fake.questions.attempts[1].picture_sha256.clear();
  EXPECT_EQ(browser.get("/attempts/" + kOthersAttempt + "/picture.png").status, 404);
}

// A page of lists runs the script of lists, and it fetches nothing; other pages run none.
TEST(Routes, OnlyListsRunTheScriptOfLists) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  EXPECT_EQ(browser.get("/tables.js").content_type, "text/javascript; charset=utf-8");
  for (const char* path : {"/attempts", "/cases"}) {
    const std::string list = bytes_of(browser.get(path), true);
    EXPECT_THAT(list, HasSubstr("script-src 'self'; form-action")) << path;
    EXPECT_THAT(list, HasSubstr("src=\"/tables.js\"")) << path;
  }
  for (const char* path : {"/", "/me", "/metrics", "/curricula"}) {
    const std::string other = bytes_of(browser.get(path), true);
    EXPECT_THAT(other, Not(HasSubstr("script"))) << path;
  }
}

// Without whoever draws, or where a replay differs, the page says so and offers nothing broken.
TEST(Routes, PicturesAreDrawnOnceAndTheirAbsenceIsSaid) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  const std::string path = "/attempts/" + kOthersAttempt + "/pictures";
  fake.questions.pictures_refusal = base::Error{"replay_differs", "it <differs>"};
  EXPECT_THAT(browser.get(path).body, HasSubstr("There are no pictures: it &lt;differs&gt;."));
  fake.questions.pictures_refusal.reset();
  const Response first = browser.get(path);
  EXPECT_THAT(first.body, HasSubstr("<p class=\"pictures\">" + kOthersAttempt + "</p>"));
  EXPECT_THAT(bytes_of(first, true), Not(HasSubstr("data:")));
  EXPECT_EQ(browser.get(path).body, first.body);
  EXPECT_EQ(browser.get(path + ".png?n=2").body, "\2");
  for (const char* odd : {"?n=0", "?n=3", "?n=-1", "?n=99999999999999999999999"})
    EXPECT_EQ(browser.get(path + ".png" + odd).status, 404) << odd;
  EXPECT_EQ(fake.questions.pictures_made, 2) << "the refusal, and once";
}

// A page with a dozen pictures asks a dozen times: they do not wait while somebody else's are drawn.
TEST(Routes, PicturesThatAreDrawnAreAnsweredAsPages) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  const std::string page = "/attempts/" + kOthersAttempt + "/pictures";
  const auto lane = [&](const std::string& path) { return fake.site->lane_of(browser.request("GET", path)); };
  for (const char* end : {"", ".png?n=1"}) EXPECT_EQ(lane(page + end), Lane::heavy) << end;
  ASSERT_EQ(browser.get(page).status, 200);
  for (const char* end : {"", ".png?n=1"}) EXPECT_EQ(lane(page + end), Lane::pages) << end;
  EXPECT_EQ(lane("/attempts/" + kOwnAttempt + "/pictures"), Lane::heavy) << "another's";
}

// What a browser has kept it is not sent again, while it is theirs to see; nothing else is kept.
TEST(Routes, AKeptPictureIsAskedForAndNotSentAgain) {
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  for (const char* end : {"/picture.png", "/pictures.png?n=1"}) {
    const std::string path = "/attempts/" + kOthersAttempt + end;
    const Response first = browser.get(path);
    ASSERT_EQ(first.status, 200);
    EXPECT_THAT(bytes_of(first, true), HasSubstr("Cache-Control: private, no-cache\r\n"));
    Request again = browser.request("GET", path);
    again.headers["if-none-match"] = header_of(first, "ETag");
    const std::string kept = bytes_of(browser.send(again), true);
    EXPECT_THAT(kept, HasSubstr("HTTP/1.1 304 Not Modified\r\n"));
    EXPECT_THAT(kept, Not(HasSubstr("Content-Length"))) << "a length would be that of the picture";
    EXPECT_TRUE(kept.ends_with("\r\n\r\n"));
    fake.questions.picture.push_back(std::byte{1});
    EXPECT_EQ(browser.send(again).status, std::string(end) == "/picture.png" ? 200 : 304)
        << "what was drawn is kept";
    again.headers["if-none-match"] = "\"" + std::string(64, 'a') + "\"";
    EXPECT_EQ(browser.send(again).status, 200);
    again.headers["if-none-match"] = header_of(first, "ETag");
    const auto relations = std::exchange(fake.questions.relations, {});
    EXPECT_EQ(browser.send(again).status, 404) << "not theirs any more";
    fake.questions.relations = relations;
  }
  EXPECT_THAT(bytes_of(browser.get("/attempts/" + kOthersAttempt + "/pictures"), true), HasSubstr("no-store"));
}

}  // namespace
}  // namespace seldinger::web
