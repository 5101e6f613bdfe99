// The replay sheet from plain rows: what it holds, that it needs nothing beside it, and that words stay words.
#include "reports/sheets/replay_sheet.h"

#include <gtest/gtest.h>

#include "reports/charts/timeline.h"
#include "reports/markup/base64.h"
#include "reports/sheets/moments_sheet.h"
#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

// In over 10 s; seen in the second half.
ReplaySheet sample_sheet() {
  ReplaySheet sheet;
  sheet.attempt = sample_attempt();
  Course& course = sheet.course;
  course.t1_s = 10.0;
  SheetPlane plane;
  plane.name = "Axial";
  plane.left = "R";
  plane.side_mm = 100.0;
  plane.png = {std::byte{1}, std::byte{2}};
  plane.target_mm = glm::dvec2(50.0, 60.0);
  plane.target_radius_mm = 6.0;
  plane.structures.push_back({"<b>vein</b>", "critical", {{{1.0, 2.0}, {3.0, 4.0}}}});
  for (int i = 0; i <= 1000; ++i) {
    const double t_s = 0.01 * i;
    course.points.push_back({t_s, std::max(0.0, 8.0 * (t_s - 2.0)), t_s > 2.0, t_s > 5.0});
    plane.way.emplace_back(50.0, 10.0 * t_s / 2.0);
    course.forces.push_back({t_s, t_s == 4.0 ? 3.5 : 0.5, 0.1});
  }
  course.targets.push_back({{2.0, 10.0}, 60.0, 6.0});
  course.bands.push_back({"Tip seen", {{5.0, 10.0}}});
  course.lanes.push_back({"Events", {{3.0, 3.0, "patient", "<i>pain</i>"}, {4.0, 6.0, "step", "anaesthetic"}}});
  course.fired_s = 10.0;
  sheet.planes = {plane};
  sheet.moments.push_back({2.0, "Through the skin", {std::byte{7}}, true, false, true});
  sheet.moments.push_back({10.0, "Fired", {std::byte{8}}, false, true, true});
  sheet.moments.push_back({10.0, "Nothing", {}, true, false, false});
  return sheet;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(ReplaySheet, ANameOpensWhatItMeasures) {
  ReplaySheet sheet = sample_sheet();
  EXPECT_EQ(replay_sheet(sheet).find("Interrupted"), std::string::npos);
  sheet.attempt.row.away_s = 30.0;
  const std::string page = replay_sheet(sheet);
  EXPECT_NE(page.find("Interrupted, and resumed after 30 s."), std::string::npos);
  const std::string measured = page.substr(page.find("What was measured"));
  EXPECT_GT(count(measured, "<th scope=\"row\">"), 4U);
  EXPECT_EQ(count(measured, "<th scope=\"row\">"),
            count(measured, "<th scope=\"row\"><details class=\"metric\"><summary>"));
}

TEST(ReplaySheet, HoldsStripWayTimelineAndMetrics) {
  const std::string page = replay_sheet(sample_sheet());
  EXPECT_NE(page.find("Through the skin"), std::string::npos);
  EXPECT_NE(page.find("target seen, tip not"), std::string::npos);
  EXPECT_NE(page.find("frozen"), std::string::npos);
  EXPECT_NE(page.find("nothing on the screen yet"), std::string::npos);
  EXPECT_EQ(count(page, "<img "), 2U);
  EXPECT_EQ(count(page, "<image "), 1U);
  EXPECT_NE(page.find("Distance to target centre"), std::string::npos);
  EXPECT_NE(page.find("2.3 mm"), std::string::npos);
  EXPECT_NE(page.find("Training only"), std::string::npos);
  // The way has three pieces: before the skin, unseen, seen; in the plane and over time.
  for (const char* kind : {"\"outside\"", "\"unseen-way\"", "\"seen-way\""})
    EXPECT_EQ(count(page, std::string("class=") + kind + " points"), 2U) << kind;
  EXPECT_EQ(page.find("step by another"), std::string::npos);
}

TEST(ReplaySheet, NeedsNothingBesideItAndRunsNothing) {
  const std::string page = replay_sheet(sample_sheet());
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("url("), std::string::npos);
  const std::string picture = "data:image/png;base64,";
  int sources = 0;
  for (const std::string name : {"src=\"", "href=\""})
    for (std::size_t at = page.find(name); at != page.npos; at = page.find(name, at + 1), ++sources)
      EXPECT_EQ(page.substr(at + name.size(), picture.size()), picture);
  EXPECT_GT(sources, 0);
}

// Before, the dashboard's page held its pictures: 2.5 MB before anything was to be seen.
TEST(MomentsSheet, NamesThePicturesThatLieBesideIt) {
  ReplaySheet sheet = sample_sheet();
  for (SheetMoment& moment : sheet.moments)
    if (!moment.png.empty()) moment.small = {{std::byte{9}, moment.png.front()}, 160, 120};
  const DrawnPictures drawn = moments_sheet(sheet);
  const std::vector<std::vector<std::byte>> pngs = {{std::byte{7}},
                                                    {std::byte{9}, std::byte{7}},
                                                    {std::byte{8}},
                                                    {std::byte{9}, std::byte{8}},
                                                    sheet.planes[0].png};
  EXPECT_EQ(drawn.pngs, pngs);
  EXPECT_EQ(drawn.markup.find("data:"), std::string::npos);
  EXPECT_EQ(count(drawn.markup, "pictures.png?n="), pngs.size());
  for (const char* part : {"<a href=\"pictures.png?n=1\"><img loading=\"lazy\" width=\"160\" height=\"120\"",
                           "src=\"pictures.png?n=2\"></a>", "href=\"pictures.png?n=5\"/>"})
    EXPECT_EQ(count(drawn.markup, part), 1U) << part;
}

// Before, the names of steps opened nothing, and the dots of their lane had no legend.
TEST(ReplaySheet, EveryStepOpensWhatItIs) {
  ReplaySheet sheet = sample_sheet();
  EXPECT_EQ(replay_sheet(sheet).find("class=\"dot violated\""), std::string::npos);
  sheet.course.lanes.push_back({"Steps",
                                {{3.0, 3.0, "violated", "Insert (wrong)", "insert"}},
                                {{0.0, 0.0, "skipped", "Jiggle (left out)", "jiggle"}}});
  const std::string page = replay_sheet(sheet);
  EXPECT_EQ(count(page, "<li><details class=\"metric\"><summary>3.0 s: Insert (wrong)</summary>"), 1U);
  EXPECT_EQ(count(page, "<li><details class=\"metric\"><summary>Jiggle (left out)</summary>"), 1U);
  EXPECT_EQ(count(page, "class=\"dot violated\""), 1U);
}

TEST(ReplaySheet, WordsStayWords) {
  ReplaySheet sheet = sample_sheet();
  sheet.attempt.row.case_title = "<img src=x onerror=alert(1)>";
  sheet.note = "<u>";
  const std::string page = replay_sheet(sheet);
  for (const char* markup : {"<img src=x", "<b>vein", "<i>pain", "<u>"})
    EXPECT_EQ(page.find(markup), std::string::npos) << markup;
  EXPECT_NE(page.find("&lt;b&gt;vein"), std::string::npos);
  EXPECT_NE(page.find("&lt;i&gt;pain"), std::string::npos);
}

TEST(ReplaySheet, AnEmptyCourseDoesNotBreakIt) {
  ReplaySheet sheet;
  sheet.attempt = sample_attempt();
  const std::string page = replay_sheet(sheet);
  EXPECT_NE(page.find("What was measured"), std::string::npos);
  EXPECT_EQ(page.find("Over time"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST(Timeline, KeepsPeaksAndNumbersAndNoNan) {
  const ReplaySheet sheet = sample_sheet();
  const std::vector<double> moments = {2.0, 10.0};
  const std::string svg = timeline(sheet.course, moments).str();
  EXPECT_NE(svg.find("3.5 N"), std::string::npos) << "the single sample's peak scales the axis";
  EXPECT_EQ(count(svg, "class=\"moment-number\""), 2U);
  EXPECT_EQ(count(svg, "class=\"lasting\""), 1U);
  EXPECT_EQ(count(svg, "<circle"), 1U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("\xE2\x88\x92"), std::string::npos) << "SVG wants an ASCII minus";
  EXPECT_TRUE(timeline(Course{}, moments).empty());
}

TEST(Base64, IsThatOfTheRfc) {
  const auto of = [](const std::string& text) {
    std::vector<std::byte> bytes;
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    return base64(bytes);
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace seldinger::reports
