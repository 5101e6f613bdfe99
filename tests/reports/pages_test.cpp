// The pages: what they lead with, that nothing of the data becomes markup, that every one says what it is not for.
#include <gmock/gmock.h>

#include <limits>

#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "reports/pages/attempt_page.h"
#include "reports/pages/attempts_page.h"
#include "reports/pages/login_page.h"
#include "reports/pages/metrics_page.h"
#include "reports/pages/page.h"
#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Visitor kMentor{"Ann", "mentor", "token-1"};

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t count = 0;
  for (std::size_t at = text.find(piece); at != text.npos; at = text.find(piece, at + 1)) ++count;
  return count;
}

// Every element that opens closes in order; void elements aside.
std::string first_unbalanced_tag(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == html.npos) return "unfinished";
    const bool closes = html[at + 1] == '/';
    const std::size_t from = at + (closes ? 2 : 1);
    const std::string name = html.substr(from, html.find_first_of(" >/\n", from) - from);
    if (name == "!doctype" || name == "meta" || name == "link" || name == "input" || name == "img") continue;
    if (html[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return name;
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

std::vector<std::string> all_pages() {
  const AttemptView view = sample_attempt();
  const cases::Recording recording = sample_recording(view.row.lesion, 8.0);
  const ListPart part{2, 3, 120, false};
  return {login_page("t", ""),
          login_page("t", "Wrong name or password."),
          message_page("Not found", "There is nothing here.", kMentor),
          attempts_page(kMentor, std::vector{view, view}, part),
          attempts_page(kMentor, {}, {}),
          no_attempts_page(kMentor),
          metrics_page(kMentor),
          attempt_page(kMentor, view, &recording),
          attempt_page(kMentor, view, nullptr)};
}

TEST(EveryPage, SaysTrainingOnlyAndIsWellFormed) {
  for (const std::string& html : all_pages()) {
    EXPECT_THAT(html, HasSubstr("Training only, not for planning a patient&#39;s procedure."));
    EXPECT_EQ(first_unbalanced_tag(html), "");
    EXPECT_THAT(html, HasSubstr("<html lang=\"en\">"));
    EXPECT_THAT(html, HasSubstr("<a class=\"skip\" href=\"#content\">"));
    EXPECT_EQ(count_of(html, "<h1>"), 1U);
    EXPECT_EQ(count_of(html, "<main id=\"content\""), 1U);
  }
}

// The replay's script is named by an attempt's page, which has the same course as a chart; that of lists by lists.
TEST(EveryPage, NeedsNoInlineScriptOrStyleSoThatThePolicyHolds) {
  for (std::string html : all_pages()) {
    const std::string replay = "<script src=\"/replay.js\" defer></script>";
    if (const std::size_t at = html.find(replay); at != html.npos) {
      EXPECT_THAT(html, HasSubstr("<svg role=\"img\""));
      html.erase(at, replay.size());
    }
    const std::string tables = "<script src=\"/tables.js\" defer></script>";
    if (const std::size_t at = html.find(tables); at != html.npos) {
      EXPECT_THAT(html, HasSubstr("<table class=\"list"));
      html.erase(at, tables.size());
    }
    for (const char* forbidden :
         {"<script", "<style", " style=", "javascript:", " onclick", "http://", "https://", "data:"}) {
      EXPECT_THAT(html, Not(HasSubstr(forbidden)));
    }
  }
}

TEST(EveryPage, GivesItsTablesACaptionAndItsHeadersAScope) {
  for (const std::string& html : all_pages()) {
    EXPECT_EQ(count_of(html, "<table"), count_of(html, "<caption>"));
    EXPECT_EQ(count_of(html, "<th "), count_of(html, "<th scope=\""));
    EXPECT_EQ(count_of(html, "<th>"), 0U);
    EXPECT_EQ(count_of(html, "<img "), count_of(html, " alt=\""));
  }
}

// A value is never far from what it measures: its name opens the definition, and a link in every page's head leads
// to all of them.
TEST(AttemptPage, EveryValueOpensItsDefinition) {
  AttemptView view = sample_attempt();
  view.row.picture = {cases::Modality::ultrasound, 85.0, 0.0, 60.0, "C5-2v"};
  view.row.metrics.clear();
  for (const assessment::MetricInfo& info : assessment::registry())
    view.row.metrics.push_back({info.id, info.version, std::nullopt, info.unit, "no_endpoint"});
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html, HasSubstr("<dt><details class=\"metric\"><summary>Target hit</summary>")) << "what leads, too";
  const std::size_t from = html.find("id=\"metrics\"");
  std::size_t rows = 0;
  const std::string row = "<th scope=\"row\">", opens = "<details class=\"metric\"><summary>";
  for (std::size_t at = html.find(row, from); at != html.npos; at = html.find(row, at + 1), ++rows)
    EXPECT_EQ(html.compare(at + row.size(), opens.size(), opens), 0) << html.substr(at, 120);
  EXPECT_GT(rows, 30U);
  EXPECT_THAT(html, HasSubstr("<dt>Better</dt><dd>lower</dd>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"/metrics\">Metrics</a>"));
}

TEST(AttemptPage, AValueOfAnOlderDefinitionSaysSo) {
  AttemptView view = sample_attempt();
  view.row.metrics = {{"path_tip", 1, 80.0, "mm", ""}};
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), HasSubstr("this value was measured by version 1"));
  view.row.metrics[0].version = assessment::find_metric("path_tip")->version;
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), Not(HasSubstr("this value was measured by version")));
}

TEST(AttemptPage, TellsForHowLongItLayInterrupted) {
  AttemptView view = sample_attempt();
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), Not(HasSubstr("Interrupted")));
  view.row.away_s = 754.0;
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), HasSubstr("Interrupted, and resumed after 13 min."));
}

// Before, the page did not tell of the steps at all.
TEST(AttemptPage, EveryStepOpensWhatItIsAndEveryMarkHasItsLegend) {
  using assessment::StepHow;
  using assessment::StepState;
  AttemptView view = sample_attempt();
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), HasSubstr("No steps are stored with this attempt."));
  const int now = assessment::kStepsVersion;
  view.steps = {{"sign_in", now, StepState::done, 1.3, "", StepHow::said},
                {"check_probe", now, StepState::skipped, std::nullopt, "", StepHow::said},
                {"place_probe", now, StepState::done, 2.0, "", StepHow::shown},
                {"find_target", now, StepState::skipped, 40.0, "", std::nullopt},
                {"insert", now - 1, StepState::violated, 30.0, "", std::nullopt},
                {"jiggle", now, StepState::skipped, std::nullopt, "", std::nullopt},
                {"nick", now, StepState::not_asked, std::nullopt, "not_a_core_needle", std::nullopt},
                {"of_tomorrow", now, StepState::done, 31.0, "", StepHow::shown}};
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_EQ(first_unbalanced_tag(html), "");
  const std::size_t from = html.find("<section class=\"steps\"");
  ASSERT_NE(from, html.npos);
  const std::string section = html.substr(from, html.find("</section>", from) - from);
  for (const assessment::StepResult& step : view.steps) {
    const assessment::StepInfo* info = assessment::find_step(step.id);
    if (info == nullptr) continue;
    EXPECT_EQ(count_of(section, "<details class=\"metric\"><summary>" + escaped(info->words) + "</summary>"), 1U);
    EXPECT_THAT(section, HasSubstr("(" + step.id + ")")) << "the card";
  }
  EXPECT_THAT(section, HasSubstr("<th scope=\"row\">of tomorrow</th>"));
  EXPECT_THAT(
      section,
      HasSubstr(
          "<td class=\"number\"><span data-at-s=\"1.3\">1.3 s</span></td><td><span class=\"yes\">✓ said</span>"));
  for (const char* mark : {"✓ shown", "✓ said", "– left out", "– said, not shown", "– too late", "✗ wrong"}) {
    EXPECT_GE(count_of(section, ">" + std::string(mark) + "</span>"), 1U) << mark;
    EXPECT_EQ(count_of(section, "<dt>" + std::string(mark) + "</dt>"), 1U) << mark;
  }
  EXPECT_THAT(section, HasSubstr("this result was judged by version " + std::to_string(now - 1)));
  EXPECT_THAT(section, HasSubstr("<dd>the needle is not a core needle</dd>"));
}

TEST(MetricsPage, HoldsEveryMetricUnderItsAnchor) {
  const std::string html = metrics_page(kMentor);
  for (const assessment::MetricInfo& info : assessment::registry()) {
    EXPECT_EQ(count_of(html, " id=\"metric-" + std::string(info.id) + "\""), 1U) << info.id;
    EXPECT_THAT(html, HasSubstr(escaped(info.source)));
  }
}

TEST(AttemptPage, LeadsWithHitAndDistance) {
  const std::string html = attempt_page(kMentor, sample_attempt(), nullptr);
  const std::size_t hit = html.find("<dd>Yes</dd>"), distance = html.find("<dd>2.3 mm</dd>");
  ASSERT_NE(hit, html.npos);
  ASSERT_NE(distance, html.npos);
  EXPECT_LT(hit, distance);
  EXPECT_LT(distance, html.find("<table>"));
  EXPECT_THAT(html, HasSubstr("LPS (12.0, −34.5, 100.0) mm, diameter 16.0 mm"));
  EXPECT_THAT(html, HasSubstr("2026-03-01 14:05 UTC"));
  EXPECT_THAT(html, HasSubstr("/attempts/0190a1b2-0000-7000-8000-0000000000a1/picture.png"));
  EXPECT_THAT(html, HasSubstr("time_total v2"));
}

TEST(AttemptPage, SaysUnderWhichConditionsItWasMade) {
  AttemptView view = sample_attempt();
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), HasSubstr("Its conditions were not recorded."));
  view.row.conditions = casedb::simulated_conditions();
  view.row.conditions.paused_s = 41.25;
  view.row.conditions.pauses = 2;
  view.row.conditions.picture_method = "<scatterers>";
  view.row.away_s = 90.0;
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html,
              HasSubstr("Conditions: simulated hands; no needle guide; 2 pauses, 41 s; interrupted for 90 s."));
  EXPECT_THAT(html, HasSubstr("34.6 s, without 41.2 s of pauses"));
  EXPECT_THAT(html, HasSubstr("Interrupted, and resumed after 90 s."));
  EXPECT_THAT(html, HasSubstr("<dt>Needle guide used</dt><dd>no"));
  EXPECT_THAT(html, HasSubstr("&lt;scatterers&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("Window&#39;s width"))) << "what is not known is not listed";
  EXPECT_EQ(first_unbalanced_tag(html), "");
}

TEST(AttemptPage, ShowsNullMetricsAsADashWithTheReason) {
  AttemptView view = sample_attempt();
  for (casedb::MetricValue& metric : view.row.metrics) metric.value = std::nullopt, metric.reason = "no_endpoint";
  const std::string html = attempt_page(kMentor, view, nullptr);
  // Hit, distance and time lead; the tables hold six: a core's length means nothing for an access needle.
  EXPECT_EQ(
      count_of(html, "— <span class=\"why\">the needle was neither fired nor declared to be on target</span>"),
      3U + 6U);
  for (const char* zero : {">0<", ">0.0", "No</dd>", "Yes</dd>", "the target was"})
    EXPECT_THAT(html, Not(HasSubstr(zero)));
}

TEST(AttemptPage, OfFluoroscopySpeaksOfItAndShowsWhatItCost) {
  AttemptView view = sample_attempt();
  view.row.picture.modality = cases::Modality::xray;
  view.row.metrics.push_back({"fluoroscopy_time", 1, 12.25, "s", ""});
  view.row.metrics.push_back({"dap", 1, 0.0421, "Gy·cm²", ""});
  view.row.metrics.push_back({"view_angle_max", 1, std::nullopt, "deg", "fewer_than_two_views"});
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html, HasSubstr("<caption>Dose</caption>"));
  EXPECT_THAT(html, HasSubstr("0.042 Gy·cm²"));
  EXPECT_THAT(html, HasSubstr("the target was not looked at from two directions"));
  EXPECT_THAT(html, HasSubstr("The last image before the moment of firing."));
  EXPECT_THAT(html, HasSubstr("<bdi>Fluoroscopy</bdi>"));
  EXPECT_THAT(html, Not(HasSubstr("MPR")));
  EXPECT_THAT(html, Not(HasSubstr("In plane"))) << "a projection has no plane to be in";
}

TEST(AttemptPage, OfASliceLeavesOutWhatAFluoroscopeSpends) {
  AttemptView view = sample_attempt();
  view.row.metrics.push_back({"dap", 1, std::nullopt, "Gy·cm²", "not_xray"});
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html, Not(HasSubstr("<caption>Dose")));
  EXPECT_THAT(html, Not(HasSubstr("not xray")));
  EXPECT_THAT(html, HasSubstr("In plane"));
}

TEST(AttemptPage, NamesApartWhatTheCaseDoesNotHave) {
  AttemptView view = sample_attempt();
  view.row.metrics.push_back({"force_peak_axial", 1, std::nullopt, "N", "no_device"});
  view.row.metrics.push_back({"entry_angle_error", 1, std::nullopt, "deg", "no_plan"});
  view.row.metrics.push_back({"path_inefficiency", 1, std::nullopt, "%", "not_in_tissue_at_the_end"});
  const std::string html = attempt_page(kMentor, view, nullptr);
  const std::size_t apart = html.find("What this case does not measure");
  ASSERT_NE(apart, html.npos);
  EXPECT_GT(html.find("Peak axial force"), apart);
  EXPECT_GT(html.find("Angle to planned entry"), apart);
  EXPECT_LT(html.find("the tip was not in tissue at the end"), apart) << "what the trainee did stands in the table";
  EXPECT_THAT(attempt_page(kMentor, sample_attempt(), nullptr), Not(HasSubstr("What this case does not measure")));
}

TEST(AttemptPage, OfAllMetricsShowsAFewOfEachGroupAndFoldsTheRest) {
  AttemptView view = sample_attempt();
  view.row.picture = {cases::Modality::ultrasound, 85.0, 0.0, 60.0, "C5-2v"};
  view.row.metrics.clear();
  for (const assessment::MetricInfo& info : assessment::registry())
    view.row.metrics.push_back({info.id, info.version, 1.0, info.unit, ""});
  const std::string html = attempt_page(kMentor, view, nullptr);
  std::size_t at = 0;
  for (const char* group : {"Target", "Safety", "Picture", "Path", "Time", "Recording"}) {
    const std::size_t found = html.find("<caption>" + std::string(group) + "</caption>", at);
    ASSERT_NE(found, html.npos) << group;
    EXPECT_LE(count_of(html.substr(found, html.find("</table>", found) - found), "<th scope=\"row\">"), 5U)
        << group;
    at = found;
  }
  EXPECT_THAT(html, HasSubstr("<summary>Safety: "));
  EXPECT_THAT(html, Not(HasSubstr("<caption>Dose</caption>")));
  EXPECT_EQ(first_unbalanced_tag(html), "");
  EXPECT_EQ(count_of(html, "<table"), count_of(html, "<caption>"));
}

TEST(AttemptPage, OfUltrasoundNamesItsProbe) {
  AttemptView view = sample_attempt();
  view.row.picture = {cases::Modality::ultrasound, 85.0, 0.0, 60.0, "C5-2v"};
  view.row.metrics.push_back({"vis_joint_2_mm", 1, 0.5, "share", ""});
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html, HasSubstr("Ultrasound, probe C5-2v, 85 mm deep, 60 pictures a second"));
  EXPECT_THAT(html, HasSubstr("Ultrasound at the moment of firing: probe C5-2v"));
  EXPECT_THAT(html, HasSubstr("Both within 2 mm"));
  EXPECT_THAT(html, HasSubstr("In plane"));
  EXPECT_THAT(html, Not(HasSubstr("MPR")));
}

TEST(AttemptPage, OfASliceLeavesOutTheRulesOfUltrasound) {
  AttemptView view = sample_attempt();
  view.row.metrics.push_back({"vis_joint_2_mm", 1, std::nullopt, "share", "not_ultrasound"});
  EXPECT_THAT(attempt_page(kMentor, view, nullptr), Not(HasSubstr("Both within 2 mm")));
}

TEST(AttemptPage, WithoutMetricsOrPictureSaysSo) {
  AttemptView view = sample_attempt();
  view.row.metrics.clear();
  view.row.picture_sha256.clear();
  const std::string html = attempt_page(kMentor, view, nullptr);
  EXPECT_THAT(html, HasSubstr("No metrics are stored"));
  EXPECT_THAT(html, HasSubstr("No picture is stored"));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_EQ(count_of(html, "— <span class=\"why\">it was not measured</span>"), 2U);
}

TEST(AttemptPage, NothingOfTheDataBecomesMarkup) {
  const std::string bad = "\"'><img src=x onerror=alert(1)>\u202E</title></bdi>";
  AttemptView view = sample_attempt();
  view.row.case_title = view.operator_label = view.row.program_version = view.row.attempt_id = bad;
  for (casedb::MetricValue& metric : view.row.metrics) {
    metric.unit = bad;
    metric.id += bad;
    metric.reason = bad;
  }
  const Visitor visitor{bad, bad, bad};
  const std::string page_html = attempt_page(visitor, view, nullptr);
  const std::string list_html = attempts_page(visitor, std::vector{view}, {1, 1, 1, false});
  for (const std::string& html : {page_html, list_html, message_page(bad, bad, visitor), login_page(bad, bad)}) {
    EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(html, Not(HasSubstr("\u202E")));
    EXPECT_EQ(first_unbalanced_tag(html), "");
    EXPECT_EQ(count_of(html, "</title>"), 1U);
  }
}

TEST(AttemptsPage, ShowsTheRowsInTheOrderGivenWithLinks) {
  AttemptView first = sample_attempt(), second = sample_attempt();
  second.row.attempt_id = "0190a1b2-0000-7000-8000-0000000000a2";
  second.row.metrics = {{"hit", 1, 0.0, "bool", ""}, {"tip_target_dist", 1, std::nullopt, "mm", "no_target"}};
  const std::string html = attempts_page(kMentor, std::vector{first, second}, {1, 1, 2, false});
  EXPECT_LT(html.find("/attempts/" + first.row.attempt_id), html.find("/attempts/" + second.row.attempt_id));
  EXPECT_THAT(html, HasSubstr("<span class=\"yes\">Yes</span>"));
  EXPECT_THAT(html, HasSubstr("<span class=\"no\">No</span>"));
  EXPECT_THAT(html, HasSubstr("— <span class=\"why\">the case has no target</span>"));
  EXPECT_THAT(html, HasSubstr("— <span class=\"why\">it was not measured</span>"));
  EXPECT_THAT(html, Not(HasSubstr("Pages of the list")));
}

TEST(AttemptsPage, WhenEmptySaysWhatToDo) {
  EXPECT_THAT(attempts_page(kMentor, {}, {}), HasSubstr("seldinger simulate"));
  EXPECT_THAT(attempts_page(kMentor, {}, {1, 1, 0, true}), HasSubstr("seldinger train"));
}

TEST(AttemptsPage, ALongListLinksItsNeighbours) {
  const std::string html = attempts_page(kMentor, std::vector{sample_attempt()}, {2, 3, 101, false});
  EXPECT_THAT(html, HasSubstr("?page=1\">Newer"));
  EXPECT_THAT(html, HasSubstr("?page=3\">Older"));
  EXPECT_THAT(html, HasSubstr("Page 2 of 3"));
}

TEST(LogInPage, PostsNamePasswordAndTokenAndTellsTheProblemAloud) {
  const std::string html = login_page("tok", "Wrong name or password.");
  for (const char* piece : {"method=\"post\" action=\"/login\"", "name=\"token\" value=\"tok\"",
                            "type=\"password\"", "autocomplete=\"current-password\"", "role=\"alert\""}) {
    EXPECT_THAT(html, HasSubstr(piece));
  }
  EXPECT_THAT(login_page("tok", ""), Not(HasSubstr("role=\"alert\"")));
}

}  // namespace
}  // namespace seldinger::reports
