// A report's data, redone by the script beside it: on random studies with ties, failures, absent people and missed
// visits, and with a number that was changed.
#include "reports/studies/report_data.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "assessment/questionnaire/shipped_forms.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/study/sample_plan.h"
#include "tests/fixtures/process.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
using ::testing::HasSubstr;
using ::testing::Not;

// One that fired, or that did neither; on a grid of half millimetres, so that there are ties.
study::StudyAttempt drawn_attempt(base::Rng& rng, double middle_mm, double day) {
  const auto now = [](const char* id, std::optional<double> value, const char* reason) {
    const assessment::MetricInfo* info = assessment::find_metric(id);
    return assessment::MetricValue{id, info->version, value, info->unit, reason};
  };
  study::StudyAttempt made;
  made.case_id = "case-1";
  made.day = day;
  made.hand = "arm";
  std::optional<double> distance;
  if (rng.uniform() < 0.9) distance = std::round(2.0 * (middle_mm + 2.0 * rng.normal())) / 2.0;
  made.metrics = {now("procedure_performed", 1.0, ""), now("skin_punctures", 1.0, ""),
                  now("tip_target_dist", distance, distance ? "" : "no_endpoint"),
                  now("nogo_length", std::exp(rng.normal()), "")};
  return made;
}

// Answers of 2007's form, one left out; ratings of three raters, two a replay, with calibration and repeats; and
// ratings beside the outcome at its case.
void add_structure(ValidityReport& report, std::uint64_t seed) {
  base::Rng rng(seed);
  casedb::Responses responses;
  casedb::StoredForm form;
  form.form = assessment::questionnaire::find_shipped_form("workshop-2007")->form;
  responses.round.title = "Day";
  responses.forms.emplace("q", form);
  for (int person = 0; person < 25; ++person) {
    casedb::ResponseSet set;
    const double own = rng.normal();
    for (char item = 'a'; item <= 'h'; ++item)
      if (person != 3 || item != 'c')
        set.answers[std::string("8") + item] = {assessment::questionnaire::AnswerState::answered,
                                                std::clamp(std::round(3.0 + own + 0.8 * rng.normal()), 1.0, 5.0),
                                                ""};
    responses.sets.emplace_back("q", set);
  }
  report.forms = reliability_of(responses);
  casedb::RatedRound round;
  round.each = 2;
  casedb::RatedPeople people{"osats-grs", "Global", 2, "case-1", 0, {}, {}, 2};
  for (const study::PersonValue& one : report.result.primary[0].people) {
    const double own = 3.0 + rng.normal();
    for (std::size_t k = 0; k < 2; ++k)
      round.scores.push_back({"rater " + std::to_string((round.scores.size() + k) % 3), "view of " + one.name,
                              assessment::rating::Part::rated, k, own + 0.5 * rng.normal()});
    people.mean[one.name] = std::round(2.0 * own) / 2.0;
  }
  round.scores.push_back({"rater 0", "known", assessment::rating::Part::calibration, 0, 5.0, 4.0});
  round.scores.push_back({"rater 1", "alone", assessment::rating::Part::rated, 0, 1.0});
  round.agreement = assessment::rating::agreement_of(round.scores, round.each);
  people.scores = round.scores;
  report.rated_rounds.push_back(std::move(round));
  report.ratings.push_back(std::move(people));
  for (const study::PersonValue& one : report.result.primary[0].people) {
    casedb::Background& background = report.backgrounds[one.name];
    background.group = one.group;
    background.answers["logbook_total"] = std::to_string(static_cast<int>(20.0 * rng.uniform()));
    background.answers["handedness"] = rng.uniform() < 0.3 ? "left" : "right";
    if (rng.uniform() < 0.8) background.sites = {rng.uniform() < 0.5 ? "=North" : "South"};
  }
}

ValidityReport random_report(std::uint64_t seed, const char* test, std::size_t most) {
  base::Rng rng(seed);
  ValidityReport report;
  report.plan.plan = study::sample_plan();
  report.plan.frozen_us = 1;
  study::Plan& plan = report.plan.plan;
  plan.primary[0].test = *base::from_name(study::kTestNames, test);
  if (plan.primary[0].test == study::Test::welch) plan.primary[0].failure_value = 20.0;
  plan.visits.push_back({"later", 20.0, 30.0});
  plan.absent = rng.uniform() < 0.5 ? study::Absent::left_out : study::Absent::failure;
  if (plan.absent == study::Absent::left_out) plan.imputations = 10;
  plan.secondary = {plan.primary[1]};
  plan.secondary[0].name = "no-go again";
  std::vector<study::StudyPerson> people;
  for (const char* group : {"few", "many"}) {
    const auto n = 5 + static_cast<std::size_t>(rng.uniform() * static_cast<double>(most - 4));
    for (std::size_t i = 0; i < n; ++i) {
      study::StudyPerson& person = people.emplace_back();
      person.name = std::string("P-") + group + std::to_string(i);
      person.group = group;
      const double middle = (person.group == "few" ? 8.0 : 5.0) + rng.normal();
      const double came = rng.uniform();
      for (int k = 0; k < 3 && came > 0.1; ++k) person.attempts.push_back(drawn_attempt(rng, middle, 0.0));
      if (came > 0.25) person.attempts.push_back(drawn_attempt(rng, middle, 25.0));
    }
  }
  report.result = study::analyse(plan, people);
  study::add_sensitivity(plan, people, report.result);
  const assessment::MetricInfo* info = assessment::find_metric("tip_target_dist");
  report.marks.rules["case-1"].criteria = {{info->id, info->version, assessment::Comparison::at_most, 6.0}};
  return report;
}

fixtures::Ran redone(const std::vector<DataFile>& files, const std::string& name) {
  const auto folder = fixtures::fresh_folder("redo_" + name);
  for (const DataFile& one : files) std::ofstream(folder / one.name) << one.content;
  return fixtures::run("Rscript --vanilla '" + (folder / "redo.R").string() + "' '" + folder.string() + "'",
                       folder / "said");
}

TEST(ReportData, IsRedoneByRWithAnyTest) {
  SELDINGER_NEEDS_R();
  for (std::size_t set = 0; set < std::max<std::size_t>(1, fixtures::r_sets() / 20); ++set)
    for (const char* test : {"welch", "brunner_munzel", "mann_whitney"})
      for (const std::size_t most : {7U, 40U}) {
        const std::string name = std::string(test) + "_" + std::to_string(most);
        SCOPED_TRACE(name + " " + std::to_string(set));
        ValidityReport report = random_report(fixtures::r_seed() + set, test, most);
        // A bootstrap of factors takes R seconds: once.
        if (most == 40U && std::string_view(test) == "welch") add_structure(report, set);
        const auto ran = redone(report_data(report), name);
        EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
        EXPECT_THAT(ran.out, HasSubstr(" numbers redone, 0 differ"));
      }
}

// What is in its tables is in its numbers: of items, raters, ratings and what was drawn.
TEST(ReportData, HoldsStructureAndWhatWasDrawn) {
  std::string numbers;
  for (std::uint64_t seed = 1; seed <= 8 && numbers.find(",imputed,") == std::string::npos; ++seed) {
    ValidityReport report = random_report(seed, "welch", 40);
    add_structure(report, seed);
    numbers = report_data(report).at(8).content;
  }
  for (const char* one : {"scale 1,answers,alpha,", "scale 1,answers,omega_low,", "round 1,ratings,icc_mean_high,",
                          "outcome 1 other 1,related,rho_high,", "outcome 1 other 1,related,corrected_high,",
                          "outcome 1 other 2,related,rho,", "outcome 1 by 1 subgroup 2,subgroups,difference_low,",
                          "group 2 logbook_total,baseline,high_quartile,", "1,imputed,estimate,"})
    EXPECT_THAT(numbers, HasSubstr(one));
}

// The script can fail: it finds one number in a hundred that is off by a thousandth.
TEST(ReportData, ANumberThatIsOffIsTold) {
  SELDINGER_NEEDS_R();
  auto files = report_data(random_report(1, "welch", 20));
  std::string& numbers = files[8].content;
  const std::size_t at = numbers.find("1,plan,estimate,") + 16;
  const std::size_t end = numbers.find('\n', at);
  numbers.replace(at, end - at, std::to_string(std::stod(numbers.substr(at, end - at)) + 0.001));
  const auto ran = redone(files, "off");
  EXPECT_EQ(ran.exit_code, 1) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("differs: outcome 1 plan estimate"));
  EXPECT_THAT(ran.out, HasSubstr(" 1 differ"));
}

// The page with every panel: kept in the test's folder, to be looked at.
TEST(ReportData, ThePageOfAllPanelsTellsNumbersOrWhyNot) {
  ValidityReport report = random_report(3, "welch", 40);
  add_structure(report, 3);
  const std::string page = validity_page(report);
  std::ofstream(fixtures::fresh_folder("validity_page") / "validity.html") << page;
  for (const char* panel : {"Mean rating: Global, version 2", "Writing hand: left", "Site: ", "median (quartiles)"})
    EXPECT_THAT(page, HasSubstr(panel));
  for (const char* none : {">nan", " nan", "NaN", ">inf", " inf ", "-inf"}) EXPECT_THAT(page, Not(HasSubstr(none)));
}

TEST(ReportData, NamesNobody) {
  for (const DataFile& one : report_data(random_report(2, "brunner_munzel", 10)))
    EXPECT_THAT(one.content, Not(HasSubstr("P-"))) << one.name;
}

}  // namespace
}  // namespace seldinger::reports
