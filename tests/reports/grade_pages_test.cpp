// What a page says of a grade: sentences first, each criterion, whose band it is, that nothing of the data becomes
// markup.
#include <gmock/gmock.h>

#include "assessment/registry.h"
#include "reports/pages/attempt_page.h"
#include "reports/pages/attempts_page.h"
#include "reports/pages/compare_page.h"
#include "reports/pages/curricula_page.h"
#include "reports/words/grade_words.h"
#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Visitor kTrainee{"Tom", "trainee", "token-1"};

assessment::CriterionResult result(const char* text, bool critical, std::optional<double> value, const char* unit,
                                   assessment::Outcome outcome, const char* reason = "") {
  assessment::CriterionResult made;
  made.criterion = *assessment::criterion_from(text);
  made.criterion.critical = critical;
  made.value = value;
  made.unit = unit;
  made.outcome = outcome;
  made.reason = reason;
  return made;
}

casedb::AttemptGrade failed_grade() {
  using enum assessment::Outcome;
  casedb::AttemptGrade grade;
  grade.grade.verdict = assessment::Verdict::failed;
  grade.grade.criteria = {result("nogo_length_critical <= 0", true, 3.25, "mm", missed),
                          result("core_in_target >= 8", false, std::nullopt, "mm", not_measured, "no_endpoint"),
                          result("hit >= 1", false, 1.0, "bool", met)};
  grade.debrief = {
      {assessment::SentenceKind::critical_error, "Went 3.2 mm through something.", "nogo_length_critical"},
      {assessment::SentenceKind::well, "Hit the target.", "hit"}};
  return grade;
}

void give_standard(casedb::AttemptGrade& grade, std::size_t people) {
  grade.experts.standard_id = "s";
  grade.experts.id = "C-0123";
  grade.experts.set_us = 1772373909000000;
  grade.experts.people = people;
  grade.experts.attempts = 3 * people;
  grade.experts.bands = {
      {"skin_punctures", "count", 1, people, 1.0, 2.0, 1.2, 0.3, assessment::Interval{0.3, 2.1}}};
  grade.provisional = false;
}

TEST(RuleLines, TwoBoundsOfOneValueAreOneLine) {
  assessment::PassRule rule;
  for (const char* one : {"hit >= 1", "tip_target_axial >= -3", "skin_punctures <= 1", "tip_target_axial <= 3"})
    rule.criteria.push_back(*assessment::criterion_from(one));
  auto lines = rule_lines(rule);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].bound, "yes");
  EXPECT_EQ(lines[1].metric + ": " + lines[1].bound, "Depth error: within ±3 mm");
  EXPECT_EQ(lines[2].bound, "at most 1");
  rule.criteria[1].value = -2.0;
  EXPECT_EQ(rule_lines(rule)[1].bound, "from −2 mm to 3 mm");
  rule.criteria[1].critical = true;
  lines = rule_lines(rule);
  ASSERT_EQ(lines.size(), 4U) << "only one of them is critical";
  EXPECT_TRUE(lines[1].critical);
}

TEST(GradeOnPage, SentencesComeBeforeEverythingElse) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  const std::string html = attempt_page(kTrainee, view, nullptr);
  const std::size_t first = html.find("Went 3.2 mm through something."), second = html.find("Hit the target.");
  ASSERT_NE(first, html.npos);
  EXPECT_LT(first, second);
  EXPECT_LT(second, html.find("Not passed: 2 of 3 criteria not met, 1 critical error"));
  EXPECT_LT(html.find("Not passed"), html.find("<table"));
  EXPECT_LT(second, html.find("class=\"outcome\""));
  EXPECT_THAT(html, HasSubstr("provisional"));
}

TEST(GradeOnPage, EachCriterionSaysWhatWasAskedAndWhatCame) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  const std::string html = attempt_page(kTrainee, view, nullptr);
  const std::size_t at = html.find("<table class=\"list criteria\">");
  const std::string table = html.substr(at, html.find("</table>", at) - at);
  EXPECT_THAT(table, HasSubstr("<summary>Path through critical structures</summary>"));
  EXPECT_THAT(table, HasSubstr("</details> <span class=\"mark critical\">critical</span>"));
  EXPECT_THAT(table, HasSubstr(">3.2 mm<"));
  EXPECT_THAT(table, HasSubstr(">none<"));
  EXPECT_THAT(table, HasSubstr("<span class=\"no\">Missed</span>"));
  EXPECT_THAT(table,
              HasSubstr("— <span class=\"why\">the needle was neither fired nor declared to be on target</span>"));
  EXPECT_THAT(table, HasSubstr("<span class=\"no\">Not met</span>"));
  EXPECT_THAT(table, HasSubstr(">Yes<"));
  EXPECT_THAT(table, HasSubstr("<span class=\"yes\">Met</span>"));
  EXPECT_THAT(table, Not(HasSubstr("Experts"))) << "there are none";
}

TEST(GradeOnPage, EachSentenceAndCriterionOpensWhatItMeasures) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  view.grade.grade.criteria[2].criterion.version = 7;  // of a definition that this program does not have
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, HasSubstr("Hit the target. <details class=\"metric\"><summary>Target hit</summary>"));
  const std::size_t at = html.find("<table class=\"list criteria\">");
  const std::string table = html.substr(at, html.find("</table>", at) - at);
  for (const char* label : {"Path through critical structures", "Core in target", "Target hit"})
    EXPECT_THAT(table, HasSubstr("<th scope=\"row\"><details class=\"metric\"><summary>" + std::string(label)));
  EXPECT_THAT(table, HasSubstr("(hit); this value was measured by version 7"));
}

TEST(GradeOnPage, ABandHasItsNumberOfPeopleAndItsToleranceInterval) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  give_standard(view.grade, 8);
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, HasSubstr("<span class=\"band\">consultants 1–2 (n = 8, tolerance 0–2)</span>"));
  EXPECT_THAT(html,
              HasSubstr("Standard of 8 consultants, the last 3 attempts of each, set on 2026-03-01, C-0123."));
  EXPECT_THAT(html, HasSubstr("90 % of all consultants with 95 % confidence"));
  EXPECT_THAT(html, Not(HasSubstr("rovisional")));
}

TEST(GradeOnPage, WithoutAStandardThereIsNoNumber) {
  // Before: "simulated expert 1–2" beside the value, and a column "Simulated expert".
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  give_standard(view.grade, 8);
  view.grade.experts.standard_id.clear();
  view.grade.provisional = true;
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, Not(HasSubstr("class=\"band\"")));
  EXPECT_THAT(html, Not(HasSubstr("data-label=\"Consultants\"")));
  EXPECT_THAT(html,
              HasSubstr("Provisional: 8 consultants have made enough attempts; a director can set the standard."));
}

TEST(GradeOnPage, AnotherVersionThanTheStandardsIsNotComparable) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  give_standard(view.grade, 8);
  view.grade.experts.bands[0].version = 99;
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, HasSubstr("not comparable: the standard is for another version of this metric"));
  EXPECT_THAT(html, Not(HasSubstr("consultants 1–2")));
}

TEST(GradeOnPage, AScoreSaysWhatItIsMadeOf) {
  AttemptView view = sample_attempt();
  view.grade = failed_grade();
  give_standard(view.grade, 8);
  view.grade.score.value = 62.6;
  view.grade.score.parts = {{"blind_advance", "mm", 1, 20.0, -0.75, "", 10.0, 13.3, 2.0},
                            {"withdrawals_partial", "count", 1, 0.0, 0.0, "", 0.0, 0.0, 1.0}};
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, HasSubstr("Score: 63 of 100"));
  EXPECT_THAT(html, HasSubstr("does not change it"));
  EXPECT_THAT(html, HasSubstr("SD at least"));
  EXPECT_THAT(html, HasSubstr("every metric weighs the same"));
}

TEST(GradeOnPage, OfNoRuleOrWhatIsNotGradedSaysSo) {
  AttemptView view = sample_attempt();
  EXPECT_THAT(attempt_page(kTrainee, view, nullptr), HasSubstr("No pass rule"));
  view.grade.grade.verdict = assessment::Verdict::not_gradable;
  view.grade.debrief = {{assessment::SentenceKind::not_gradable, "This attempt is not graded: x.", ""}};
  const std::string html = attempt_page(kTrainee, view, nullptr);
  EXPECT_THAT(html, HasSubstr("Not graded"));
  EXPECT_THAT(html, Not(HasSubstr("provisional")));
}

TEST(GradeOnList, EachAttemptSaysHowItWent) {
  AttemptView view = sample_attempt();
  for (const auto& [verdict, word] :
       {std::pair{assessment::Verdict::passed, "<span class=\"yes\">Passed</span>"},
        std::pair{assessment::Verdict::failed, "<span class=\"no\">Not passed</span>"},
        std::pair{assessment::Verdict::not_gradable, "<span class=\"note\">Not graded</span>"},
        std::pair{assessment::Verdict::no_rule, "<span class=\"note\">No pass rule</span>"}}) {
    view.grade.grade.verdict = verdict;
    EXPECT_THAT(attempts_page(kTrainee, std::vector{view}, {}), HasSubstr(word));
  }
  view.grade = failed_grade();
  EXPECT_THAT(attempts_page(kTrainee, std::vector{view}, {}), HasSubstr("critical error"));
}

// How far they are stands with their progress alone.
TEST(CurriculaPage, TellsATraineeTheWayAndWhereTheyStandElsewhere) {
  CurriculumView view;
  view.curriculum.title = "First <year>";
  view.curriculum.state = casedb::CurriculumState::published;
  view.curriculum.items = {{"f1", {}, {}}, {"f2", 5, {{0, assessment::Proficiency::proficient}}}};
  view.items.resize(2);
  view.items[0].title = "Case A";
  view.items[0].case_id = view.items[1].case_id = "c";
  view.items[0].attempts = 3;
  view.items[0].passes = 1;
  view.items[0].progress = {assessment::Proficiency::passed, true, true, {}};
  view.items[1].title = "Case B";
  view.items[1].progress = {assessment::Proficiency::not_started, false, false, 5};
  const auto nobody = assessment::statistics::not_estimable("g_theory", "no_data", 0);
  const std::string html = curricula_page(kTrainee, std::vector{view}, nobody);
  EXPECT_THAT(html, HasSubstr("First &lt;year&gt;"));
  EXPECT_THAT(html, HasSubstr("after 1 is proficient"));
  EXPECT_THAT(html, HasSubstr("href=\"/progress\""));
  for (const char* state :
       {"Passed, not yet", "mark due", "not open", "1 of 3", "Attempts allowed", "Attempts left"})
    EXPECT_THAT(html, Not(HasSubstr(state)));
  const std::string mentors = curricula_page({"Mia", "mentor", "token-2"}, std::vector{view}, nobody);
  EXPECT_THAT(mentors, HasSubstr("data-label=\"Attempts allowed\">no limit"));
  EXPECT_THAT(mentors, HasSubstr("data-label=\"Attempts allowed\">5"));
  EXPECT_THAT(curricula_page(kTrainee, {}, nobody), HasSubstr("no curriculum here yet"));
  EXPECT_THAT(html, HasSubstr("What passing one case shows: Φ is not estimated"));
}

TEST(ComparePage, PutsGroupsInColumnsWithTheirDebriefsBeneath) {
  casedb::Comparison comparison;
  comparison.row.title = "Case </title><script>";
  comparison.criteria = {failed_grade().grade.criteria[0], failed_grade().grade.criteria[2]};
  for (const bool person : {true, false}) {
    casedb::ComparedGroup& group = comparison.groups.emplace_back();
    if (person) group.person_id = "0190a1b2-0000-7000-8000-0000003f20ab";
    group.operator_name = "novice";
    group.gradable = 3;
    group.passed = person ? 1 : 0;
    group.met = {3, 1};
    group.not_performed = 7;
    group.of_criteria = {{3, 0.0, 0.0, 0.0, 0.0}, {3, 0.0, 1.0 / 3.0, 0.0, 1.0}};
    group.attempts.push_back({sample_attempt().row, failed_grade()});
  }
  EXPECT_THAT(compare_page(comparison, ""), Not(HasSubstr("What passing")));
  comparison.dependability = assessment::statistics::not_estimable("g_theory", "too_few", 1);
  const std::string html = compare_page(comparison, ".x > .y { color: red }");
  EXPECT_THAT(html, HasSubstr("What passing one case shows: Φ is not estimated"));
  EXPECT_THAT(html, HasSubstr(".x > .y { color: red }"));
  EXPECT_THAT(html, HasSubstr("Person 3f20ab"));
  EXPECT_THAT(html, HasSubstr("Simulated novice"));
  EXPECT_LT(html.find("Person 3f20ab"), html.find("Simulated novice"));
  EXPECT_THAT(html, HasSubstr("1 of 3"));
  EXPECT_THAT(html, HasSubstr("Left out: procedure not performed</th><td class=\"number\">7</td>"));
  EXPECT_THAT(html, HasSubstr("Went 3.2 mm through something."));
  EXPECT_THAT(html, HasSubstr("Training only, not for planning a patient&#39;s procedure."));
  EXPECT_THAT(html, HasSubstr("Simulated operators test the software."));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_EQ(html.find("http"), html.npos);
}

TEST(GradeWords, ScoresAndSetsReadAsSentences) {
  assessment::Score score;
  score.reason = "no_expert_set";
  EXPECT_EQ(score_text(score), "none: consultants have set no standard");
  score.value = 0.0;
  score.reason = "critical_error";
  EXPECT_EQ(score_text(score), "0 of 100, for a critical error");
  assessment::ExpertSet set;
  EXPECT_EQ(experts_text(set),
            "No expert has set a standard yet; that takes 8 consultants with 5 completed attempts each.");
  EXPECT_EQ(compared_text({0, 0, 0, 0, 0}, "mm"), "—");
  EXPECT_EQ(compared_text({5, 12.0, 12.0, 9.0, 14.0}, "mm"), "12 mm (9–14 mm)");
  EXPECT_EQ(compared_text({5, 1.0, 0.6, 0.0, 1.0}, "bool"), "3 of 5");
  const assessment::MetricInfo &dist = *assessment::find_metric("tip_target_dist"),
                               &hit = *assessment::find_metric("hit"),
                               &time = *assessment::find_metric("time_total");
  EXPECT_EQ(estimate_text({}, dist), "—");
  EXPECT_EQ(estimate_text({2, 11.5, 11.5, 9.0, 14.0, {2, 1, 0, 14.0, false}}, dist),
            "14 mm (9–14 mm), 1 without success");
  EXPECT_EQ(estimate_text({1, 9.0, 9.0, 9.0, 9.0, {1, 2, 0, std::nullopt, true}}, dist),
            "worse than any value, 2 without success");
  EXPECT_EQ(estimate_text({2, 1.0, 1.0, 1.0, 1.0, {2, 2, 0, 0.5, false}}, hit), "2 of 4, 2 without success");
  EXPECT_EQ(estimate_text({3, 20.0, 20.0, 20.0, 20.0, {2, 0, 1, 20.0, false}}, time), "20 s, 1 not ended");
}

}  // namespace
}  // namespace seldinger::reports
