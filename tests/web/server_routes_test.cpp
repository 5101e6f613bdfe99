// What is asked of the server itself: the audit log for its admin, and the routes for programs.
#include <gmock/gmock.h>

#include "tests/web/fake_site.h"
#include "web/routes/openapi_json.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(AuditPage, TellsWhoDidWhatAndThatTheLogStands) {
  FakeSite fake;
  fake.questions.audit.rows = {
      {2, 1'772'373'909'123'456, "person", "person-of-mentor", "log_in", "", "", "done", ""},
      {1, 0, "operator", std::nullopt, "erase_person", "person", "person-of-trainee", "refused", ""}};
  fake.questions.audit.names = {{"person-of-mentor", "<b>mentor</b>"}, {"person-of-trainee", "trainee"}};
  fake.questions.audit.count = 2;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::admin);
  const std::string page = browser.get("/audit?days=7").body;
  EXPECT_THAT(page, HasSubstr("Every row is as it was written"));
  EXPECT_THAT(page, HasSubstr("2026-03-01 14:05 UTC"));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;mentor"));
  EXPECT_THAT(page, Not(HasSubstr("<b>mentor")));
  EXPECT_THAT(page, HasSubstr("erases a person <span class=\"no\">refused</span>"));
  EXPECT_THAT(page, HasSubstr("value=\"7\""));
  for (const auto& [query, days] :
       {std::pair{"?days=0", "1"}, {"?days=99999", "3650"}, {"?days=x", "30"}, {"", "30"}})
    EXPECT_THAT(browser.get(std::string("/audit") + query).body, HasSubstr(std::string("value=\"") + days + "\""))
        << query;
}

TEST(AuditPage, SaysWhatWasChanged) {
  FakeSite fake;
  fake.questions.audit.problems = {"row 3 was changed"};
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::admin);
  const std::string page = browser.get("/audit").body;
  EXPECT_THAT(page, HasSubstr("row 3 was changed"));
  EXPECT_THAT(page, Not(HasSubstr("as it was written.</span>")));
}

TEST(OpenApi, HoldsEveryRouteWithItsMethodAndWhoMayAsk) {
  const std::string json = openapi_json(routes(), "9.8.7");
  EXPECT_THAT(json, HasSubstr("\"openapi\": \"3.1.0\""));
  EXPECT_THAT(json, HasSubstr("\"version\": \"9.8.7\""));
  for (const Route& route : routes()) {
    const std::size_t path = json.find("    \"" + std::string(route.pattern) + "\": {");
    ASSERT_NE(path, json.npos) << route.pattern;
    const std::size_t end = std::min(json.find("\n    \"/", path + 1), json.size());
    const std::string part = json.substr(path, end - path);
    EXPECT_THAT(part, HasSubstr(route.method == "POST" ? "\"post\"" : "\"get\"")) << route.pattern;
    for (const Role role : casedb::kAllRoles) {
      if (!route.who.roles.has(role)) continue;
      EXPECT_THAT(part, HasSubstr("\"" + casedb::name_of(role) + "\"")) << route.pattern;
    }
    EXPECT_EQ(part.find("\"uuid\"") != part.npos, route.pattern.find('{') != route.pattern.npos) << route.pattern;
  }
  FakeSite fake;
  FakeBrowser browser(*fake.site);
  EXPECT_EQ(browser.get("/openapi.json").body, json);
}

}  // namespace
}  // namespace seldinger::web
