// Workstations as pages and JSON tell of them: use to directors of their own programmes, timing to admins in
// shares.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reports/pages/people/stations_page.h"
#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Stations, AreAskedForTheOwnProgrammesAlone) {
  FakeSite fake;
  fake.questions.relations["person-of-director"]["person-of-trainee"].own_cohort = true;
  fake.questions.relations["person-of-director"]["person-of-mentor"].own = true;
  casedb::StationUse& use = fake.questions.station_use.emplace_back();
  use.station = "Lab <1>";
  use.attempts = 3;
  use.people = 2;
  use.days = 2;
  use.duration_s = 5400.0;
  use.last_us = 1700000000000000;
  use.results = {{30.0, 2.0, true}, {61.0, 8.25, false}, {10.0, std::nullopt, std::nullopt}};
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::director);
  EXPECT_THAT(browser.get("/stations").body, Not(HasSubstr("simulated"))) << "where there is nothing simulated";
  casedb::StationUse simulated = use;
  simulated.simulated = true;
  fake.questions.station_use.push_back(std::move(simulated));
  const std::string page = browser.get("/stations").body;
  EXPECT_THAT(fake.questions.stations_asked_for, ElementsAre("person-of-other-zzz999"));
  EXPECT_THAT(page, HasSubstr("Lab &lt;1&gt;"));
  EXPECT_THAT(page, HasSubstr(">1.5</td>"));
  EXPECT_THAT(page, HasSubstr("2023-11-14"));
  EXPECT_THAT(page, HasSubstr("1 of 2")) << "what came to no endpoint is no miss";
  EXPECT_THAT(page, HasSubstr("5.1 mm")) << "the median of 2 and 8.25";
  EXPECT_THAT(page, HasSubstr("point hollow"));
  const json told = json::parse(browser.get("/stations.json").body)["stations"][0];
  EXPECT_EQ(told["station"], "Lab <1>");
  EXPECT_EQ(told["duration_s"], 5400.0);
  EXPECT_EQ(told["simulated"], false);
  EXPECT_EQ(json::parse(browser.get("/stations.json").body)["stations"][1]["simulated"], true);
  EXPECT_THAT(page, HasSubstr("<bdi>Lab &lt;1&gt;</bdi> <span class=\"mark\">simulated</span></th>"));
  EXPECT_THAT(page, HasSubstr("<h3><bdi>Lab &lt;1&gt;, simulated</bdi></h3>"));
  EXPECT_THAT(page, HasSubstr("simulated attempts are in rows of their own"));
  EXPECT_TRUE(told["newest"][2]["target_mm"].is_null());
}

TEST(Stations, TimingIsToldInSharesAndTellsNotHowMuchWasDone) {
  FakeSite fake;
  casedb::StationTiming& timing = fake.questions.station_timing.emplace_back();
  timing.ticks = 123456;
  timing.missed = 31;
  for (int i = 0; i < 3; ++i) timing.latency.add(15'000);
  timing.latency.add(2'000'000);
  timing.window_hz = {60.0, 20.0};
  timing.pictures = {{"scatterers, GPU", false, {24.0, 26.0}}, {"scatterers, CPU", true, {12.0}}};
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::admin);
  const std::string page = browser.get("/stations/timing").body, list = browser.get("/stations/timing.json").body;
  EXPECT_THAT(page, HasSubstr("not recorded"));
  EXPECT_THAT(page, HasSubstr("25.0 Hz"));
  EXPECT_THAT(page, HasSubstr("simplified"));
  for (const std::string& text : {page, list})
    for (const char* count : {"123456", "123487", "123,456"}) EXPECT_THAT(text, Not(HasSubstr(count)));
  const json told = json::parse(list)["stations"][0];
  EXPECT_TRUE(told["station"].is_null());
  double late = 0.0, frames = 0.0;
  for (const json& one : told["late_shares"]) late += one["share"].get<double>();
  for (const json& one : told["frame_shares"]) frames += one["share"].get<double>();
  EXPECT_DOUBLE_EQ(late, 1.0);
  EXPECT_DOUBLE_EQ(frames, 1.0);
  EXPECT_EQ(told["late_shares"][1], (json{{"class", "10–20"}, {"share", 0.75}}));
  EXPECT_EQ(told["late_shares"].back()["share"], 0.25);
}

TEST(Stations, AClassHoldsItsLowerEnd) {
  const std::vector<double> rates = {14.9, 15.0, 58.0};
  const auto shares = reports::frame_shares(rates);
  ASSERT_EQ(shares.size(), 6U);
  EXPECT_EQ(shares[0].label, "under 15");
  for (const std::size_t at : {0, 1, 5}) EXPECT_DOUBLE_EQ(shares[at].share, 1.0 / 3.0) << at;
}

// A station's name is something that somebody wrote.
TEST(Stations, AreNotToldToAResearcher) {
  FakeSite fake;
  for (casedb::AttemptRow& row : fake.questions.attempts) {
    row.conditions.needle_hand = cases::HandKind::mouse;
    row.conditions.station = "Lab of Dr Miller";
  }
  fake.questions.relations["person-of-researcher"]["person-of-other-zzz999"].own_study = true;
  for (const Role role : {Role::researcher, Role::director}) {
    FakeBrowser browser(*fake.site);
    browser.log_in_as(role);
    const std::string page = browser.get("/attempts/" + kOthersAttempt).body;
    EXPECT_EQ(page.find("Lab of Dr Miller") != page.npos, role == Role::director) << casedb::name_of(role);
  }
}

}  // namespace
}  // namespace seldinger::web
