// What raters see of a replay: not a word of whose it is, of when, or of what the recording knows.
#include "reports/sheets/blinded_replay.h"

#include <gmock/gmock.h>

#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ReplaySheet sheet_to_rate() {
  ReplaySheet sheet;
  sheet.attempt = sample_attempt();
  sheet.course.t1_s = 10.0;
  SheetPlane plane;
  plane.name = "Axial";
  plane.side_mm = 100.0;
  plane.png = {std::byte{1}, std::byte{2}};
  for (int i = 0; i <= 100; ++i) {
    const double t_s = 0.1 * i;
    sheet.course.points.push_back({t_s, std::max(0.0, 8.0 * (t_s - 2.0)), t_s > 2.0, t_s > 5.0});
    plane.way.emplace_back(50.0, 10.0 * t_s / 2.0);
    sheet.course.forces.push_back({t_s, 0.5, 0.1});
  }
  sheet.course.bands.push_back({"Tip seen", {{5.0, 10.0}}});
  sheet.course.lanes.push_back({"Steps", {{4.0, 6.0, "step", "anaesthetic"}}});
  sheet.planes = {plane};
  for (int i = 0; i < 3; ++i) sheet.film.push_back({5.0 * i, "", {std::byte{9}}, true, false, false});
  sheet.moments.push_back({2.0, "", {std::byte{7}}, true, false, true});
  sheet.moments.push_back({10.0, "fired", {std::byte{8}}, true, true, true});
  return sheet;
}

TEST(BlindedReplay, ShowsPicturesWayAndDepth) {
  const std::string shown = blinded_replay(sheet_to_rate());
  EXPECT_THAT(shown, HasSubstr("What was on the screen"));
  EXPECT_THAT(shown, HasSubstr("10.0 s: fired"));
  EXPECT_THAT(shown, HasSubstr("2.0 s</p>"));
  EXPECT_THAT(shown, HasSubstr("<polyline"));
  EXPECT_THAT(shown, HasSubstr("class=\"timeline\""));
  EXPECT_THAT(shown, HasSubstr("data-film hidden")) << "until its script shows it";
  EXPECT_THAT(shown, HasSubstr("<li data-t=\"5.00\"><img"));
  EXPECT_THAT(shown, HasSubstr("max=\"2\""));
  EXPECT_THAT(shown, Not(HasSubstr("<script")));
  ReplaySheet still = sheet_to_rate();
  still.film.clear();
  EXPECT_THAT(blinded_replay(still), Not(HasSubstr("data-film")));
}

// Everything that an attempt carries of a person, a group, a day, a case, an id, or a result, changed: not a byte.
TEST(BlindedReplay, WhoseItIsAndWhatTheRecordingKnowsChangeNoByte) {
  const ReplaySheet sheet = sheet_to_rate();
  const std::string shown = blinded_replay(sheet);
  ReplaySheet other = sheet;
  casedb::AttemptRow& row = other.attempt.row;
  other.attempt.operator_label = "Zebedee Quagmire, consultant";
  other.note = "Recorded by another version of the step";
  row.attempt_id = "0190a1b2-0000-7000-8000-0000000000ff";
  row.case_id = "0190a1b2-0000-7000-8000-0000000000cc";
  row.case_title = "Group B, day 2";
  row.operator_name = "expert";
  row.person_id = "person-of-zzz";
  row.program_version = "9.9.9";
  row.step_version += 1;
  row.seed += 1;
  row.started_us += 86'400'000'000;
  row.duration_s += 1.0;
  row.away_s = 30.0;
  row.metrics.clear();
  for (CoursePoint& point : other.course.points) point.tip_seen = !point.tip_seen;
  for (SheetMoment& moment : other.film) moment.tip_seen = moment.target_seen = true;
  for (SheetMoment& moment : other.moments) moment.tip_seen = moment.target_seen = moment.live = false;
  other.course.bands.clear();
  other.course.lanes.clear();
  other.course.forces.clear();
  EXPECT_EQ(blinded_replay(other), shown);
  for (const char* word :
       {"Zebedee", "Group B", "0190a1b2", "expert", "tip seen", "Tip seen", "anaesthetic", "Distance to target"})
    EXPECT_THAT(blinded_replay(other), Not(HasSubstr(word)));
}

}  // namespace
}  // namespace seldinger::reports
