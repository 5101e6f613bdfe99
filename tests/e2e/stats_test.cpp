// `seldinger stats` as a researcher calls it: published and R's numbers from CSV files, and what it says of files
// that it cannot use. R's data sets and its numbers are those of R 4.2.2; others name their paper.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/statistics/procedures.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using fixtures::kProgram;

struct Number {
  const char* pointer;  // into the answer, "/rows/0/z"
  double value;
  double tolerance = 1e-9;  // relative, and absolute below 1
};

struct Oracle {
  const char* words;  // after "seldinger stats", without the file
  std::string csv;    // empty: none is given
  std::vector<Number> numbers;
};

// "name,value" lines, a group after the other.
std::string by_group(const std::vector<std::pair<std::string, std::vector<double>>>& groups) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "group,value\n";
  for (const auto& [name, values] : groups)
    for (const double value : values) csv << name << "," << value << "\n";
  return csv.str();
}

std::string by_column(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  std::ostringstream csv;
  csv.precision(17);
  for (const auto& column : columns) csv << (&column == &columns.front() ? "" : ",") << column.first;
  csv << "\n";
  for (std::size_t row = 0; row < columns.front().second.size(); ++row) {
    for (const auto& column : columns) csv << (&column == &columns.front() ? "" : ",") << column.second[row];
    csv << "\n";
  }
  return csv.str();
}

// Half of `n` values above a mean, half below, with that standard deviation.
std::vector<double> with_moments(double mean, double sd, int n) {
  const double off = sd * std::sqrt((n - 1.0) / n);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(i % 2 == 0 ? mean - off : mean + off);
  return values;
}

const std::vector<double> kSleep1 = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kSleep2 = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
const std::vector<double> kMpgAutomatic = {21.4, 18.7, 18.1, 14.3, 24.4, 22.8, 19.2, 17.8, 16.4, 17.3,
                                           15.2, 10.4, 10.4, 14.7, 21.5, 15.5, 15.2, 13.3, 19.2};
const std::vector<double> kMpgManual = {21, 21, 22.8, 32.4, 30.4, 33.9, 27.3, 26, 30.4, 15.8, 19.7, 15, 21.4};
const std::vector<double> kMpg = {21,   21,   22.8, 21.4, 18.7, 18.1, 14.3, 24.4, 22.8, 19.2, 17.8,
                                  16.4, 17.3, 15.2, 10.4, 10.4, 14.7, 32.4, 30.4, 33.9, 21.5, 15.5,
                                  15.2, 13.3, 19.2, 27.3, 26,   30.4, 15.8, 19.7, 15,   21.4};
const std::vector<double> kWeight = {2.62,  2.875, 2.32,  3.215, 3.44,  3.46,  3.57, 3.19,  3.15,  3.44,  3.44,
                                     4.07,  3.73,  3.78,  5.25,  5.424, 5.345, 2.2,  1.615, 1.835, 2.465, 3.52,
                                     3.435, 3.84,  3.845, 1.935, 2.14,  1.513, 3.17, 2.77,  3.57,  2.78};
const std::vector<double> kLikertA = {5, 4, 4, 3, 5}, kLikertB = {2, 3, 3, 1, 2, 4};

std::string plant_growth() {
  return by_group({{"ctrl", {4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14}},
                   {"trt1", {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69}},
                   {"trt2", {6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26}}});
}

std::string tooth_growth() {
  return by_group({{"0.5", {4.2,  11.5, 7.3,  5.8, 6.4,  10, 11.2, 11.2, 5.2,  7,
                            15.2, 21.5, 17.6, 9.7, 14.5, 10, 8.2,  9.4,  16.5, 9.7}},
                   {"1", {16.5, 16.5, 15.2, 17.3, 22.5, 17.3, 13.6, 14.5, 18.8, 15.5,
                          19.7, 23.3, 23.6, 26.4, 20,   25.2, 25.8, 21.2, 14.5, 27.3}},
                   {"2", {23.6, 18.5, 33.9, 25.5, 26.4, 32.5, 26.7, 21.5, 23.3, 29.5,
                          25.5, 26.4, 22.4, 24.5, 24.8, 30.9, 26.4, 27.3, 29.4, 23}}});
}

// Hollander and Wolfe 1973: rounding first base.
std::string rounding_times() {
  return by_column({{"round_out", {5.40, 5.85, 5.20, 5.55, 5.90, 5.45, 5.40, 5.45, 5.25, 5.85, 5.25,
                                   5.65, 5.60, 5.05, 5.50, 5.45, 5.55, 5.45, 5.50, 5.65, 5.70, 6.30}},
                    {"narrow", {5.50, 5.70, 5.60, 5.50, 5.85, 5.55, 5.40, 5.50, 5.15, 5.80, 5.20,
                                5.55, 5.35, 5.00, 5.50, 5.55, 5.55, 5.50, 5.45, 5.60, 5.65, 6.30}},
                    {"wide", {5.55, 5.75, 5.50, 5.40, 5.70, 5.60, 5.35, 5.35, 5.00, 5.70, 5.10,
                              5.45, 5.45, 4.95, 5.40, 5.50, 5.35, 5.55, 5.25, 5.40, 5.55, 6.25}}});
}

// Shrout and Fleiss 1979, table 2.
std::string four_judges() {
  return by_column({{"j1", {9, 6, 8, 7, 10, 6}},
                    {"j2", {2, 1, 4, 1, 5, 2}},
                    {"j3", {5, 3, 6, 2, 6, 4}},
                    {"j4", {8, 2, 8, 6, 9, 7}}});
}

// Agreement in categories, 200 of them.
std::string two_raters() {
  const int counts[3][3] = {{88, 14, 18}, {10, 40, 10}, {2, 6, 12}};
  std::string csv = "a,b\n";
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < counts[a][b]; ++i) csv += std::to_string(a + 1) + "," + std::to_string(b + 1) + "\n";
  return csv;
}

// Bland and Altman 1986: peak flow by two meters.
std::string peak_flow() {
  return by_column(
      {{"wright", {494, 395, 516, 434, 476, 557, 413, 442, 650, 433, 417, 656, 267, 478, 178, 423, 427}},
       {"mini", {512, 430, 520, 428, 500, 600, 364, 380, 658, 445, 432, 626, 260, 477, 259, 350, 451}}});
}

// What is so of a group, and whether groups differ.
std::vector<Oracle> oracles_of_groups() {
  const std::string sleep = by_group({{"1", kSleep1}, {"2", kSleep2}});
  const std::string sleep_pairs = by_column({{"one", kSleep1}, {"two", kSleep2}});
  const std::string likert = by_group({{"A", kLikertA}, {"B", kLikertB}});
  return {
      {"describe --value value",
       by_group({{"x", {2, 4, 4, 5, 7, 9}}}),
       {{"/n", 6}, {"/sd", 2.48327740429}, {"/q1", 4}, {"/median", 4.5}, {"/q3", 6.5}, {"/mad", 2.2239}}},
      {"shapiro --value mpg",
       by_column({{"mpg", kMpg}}),
       {{"/statistic", .947564726479, 1e-6}, {"/p_value", .122881358539, 1e-6}}},
      {"welch --value value --group group",
       sleep,
       {{"/statistic", -1.8608134674869},
        {"/df", 17.7764735161785},
        {"/p_value", .0793941401874},
        {"/ci95/0", -3.3654832307},
        {"/ci95/1", .2054832307},
        {"/estimate", -1.58},
        {"/groups/0/n", 10}}},
      {"student --value value --group group", sleep, {{"/p_value", .0791867142159}, {"/df", 18}}},
      {"paired --value one,two", sleep_pairs, {{"/statistic", -4.06212768338}, {"/p_value", .00283289019738}}},
      {"mann_whitney --value value --group group",
       likert,
       {{"/p_value", 13.0 / 462.0}, {"/statistic", 27}, {"/estimate", 2}}},
      {"mann_whitney --value value --group group", sleep, {{"/p_value", .0658165364048}, {"/statistic", 25.5}}},
      {"brunner_munzel --value value --group group", sleep, {{"/statistic", -2.1446717367}}},
      {"wilcoxon --value x,y",
       by_column({{"x", {1.83, .50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30}},
                  {"y", {.878, .647, .598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29}}}),
       {{"/statistic", 40}, {"/p_value", .0390625}}},
      {"kruskal --value value --group group",
       by_group({{"normal", {2.9, 3.0, 2.5, 2.6, 3.2}},
                 {"airway", {3.8, 2.7, 4.0, 2.4}},
                 {"asbestosis", {2.8, 3.4, 3.7, 2.2, 2.0}}}),
       {{"/statistic", .771428571429}, {"/p_value", .679964773579}, {"/df", 2}}},
      {"dunn --value value --group group",
       tooth_growth(),
       {{"/rows/0/z", 3.55491115081},
        {"/rows/0/p_holm", 7.56213672e-04},
        {"/rows/1/z", 6.36261167756},
        {"/rows/2/z", 2.80770052675},
        {"/rows/2/p_holm", .00498966040}}},
      {"welch_anova --value value --group group",
       plant_growth(),
       {{"/statistic", 5.1809724081132}, {"/df/0", 2}, {"/df/1", 17.1284186166}, {"/p_value", .0173928214902}}},
      {"brown_forsythe --value value --group group",
       plant_growth(),
       {{"/statistic", 1.11919, 1e-5}, {"/p_value", .34123, 1e-5}}},
      {"jonckheere --value value --group group --options order=novice:inter:expert",
       by_group({{"inter", {38, 40, 47, 44, 40, 42}},
                 {"expert", {48, 40, 45, 43, 46, 44}},
                 {"novice", {40, 35, 38, 43, 44, 41}}}),
       {{"/statistic", 79},
        {"/expected", 54},
        {"/variance", 150.286764705882},
        {"/z", 2.039293058845},
        {"/p_value", .020710393993}}},
  };
}

// Rounds of the same, how large an effect is, and how far raters agree.
std::vector<Oracle> oracles_of_effects() {
  const std::string cars = by_group({{"automatic", kMpgAutomatic}, {"manual", kMpgManual}});
  const std::string likert = by_group({{"A", kLikertA}, {"B", kLikertB}});
  return {
      {"friedman --value round_out,narrow,wide",
       rounding_times(),
       {{"/statistic", 11.1428571428571}, {"/p_value", .00380504077551}}},
      {"effect_size --value value --group group",
       cars,
       {{"/estimate", -1.4779470958},
        {"/ci95/0", -2.26597309872, 1e-6},
        {"/ci95/1", -.6705686047, 1e-6},
        {"/rows/1/value", -1.4406354024},
        {"/rows/2/value", -1.17488604487},
        {"/rows/4/value", -.65991902834}}},
      {"auc --value value --group group --options positive=A",
       likert,
       {{"/estimate", .9}, {"/ci95/0", .569555504, 2e-5}, {"/ci95/1", .983927007, 2e-5}}},
      {"icc --value j1,j2,j3,j4",
       four_judges(),
       {{"/estimate", .289763779528},
        {"/ci95/0", .0187865133747},
        {"/ci95/1", .761084369649},
        {"/rows/2/icc", .714840714841},
        {"/rows/5/icc", .909315542377},
        {"/ms_subjects", 11.2416667, 1e-7}}},
      {"kappa --value a,b",
       two_raters(),
       {{"/estimate", .491525423729}, {"/ci95/0", .391563702}, {"/ci95/1", .591487145}}},
      {"kappa --value a,b --options weights=quadratic", two_raters(), {{"/estimate", .454545454545}}},
      {"alpha --value q1,q2,q3,q4",
       by_column({{"q1", {4, 5, 3, 4, 5, 2, 4, 5}},
                  {"q2", {4, 4, 3, 5, 5, 2, 3, 5}},
                  {"q3", {5, 5, 3, 4, 4, 2, 4, 4}},
                  {"q4", {3, 5, 2, 4, 5, 3, 4, 5}}}),
       {{"/estimate", .906339468303}, {"/ci95/0", .72195650441}, {"/ci95/1", .978962345187}}},
      {"bland_altman --value wright,mini",
       peak_flow(),
       {{"/estimate", -2.11764705882},
        {"/sd", 38.76512987361},
        {"/ci95/0", -22.0488376966},
        {"/ci95/1", 17.8135435790},
        {"/se_limit", 16.284611795}}},
  };
}

// Relations, many tests at once, cuts, curves and sizes.
std::vector<Oracle> oracles_of_relations() {
  const std::string learners =
      by_column({{"y", {120, 95, 83, 76, 70, 66, 63, 60.5, 58, 56.5}}, {"t", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}});
  const std::string p_values = by_column(
      {{"p",
        {.0001, .0004, .0019, .0095, .0201, .0278, .0298, .0344, .0459, .3240, .4262, .5719, .6528, .7590, 1}}});
  return {
      {"spearman --value mpg --x wt", by_column({{"mpg", kMpg}, {"wt", kWeight}}), {{"/estimate", -.88642203327}}},
      {"pearson --value mpg --x wt",
       by_column({{"mpg", kMpg}, {"wt", kWeight}}),
       {{"/estimate", -.867659376517}, {"/ci95/0", -.933826413}, {"/ci95/1", -.744087196}}},
      {"holm --value p",
       p_values,
       {{"/rows/2/p_adjusted", .0247}, {"/rows/5/p_adjusted", .278}, {"/rows/9/p_adjusted", 1}}},
      {"bh --value p",
       p_values,
       {{"/rows/3/p_adjusted", .035625},
        {"/rows/6/p_adjusted", .0638571428571},
        {"/rows/13/p_adjusted", .813214285714}}},
      {"wilson --value hit",
       by_column({{"hit", {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0}}}),
       {{"/estimate", .875},
        {"/ci95/0", .639771727342},
        {"/ci95/1", .965022512257},
        {"/clopper_pearson_low", .616523763151},
        {"/clopper_pearson_high", .984486396185}}},
      {"contrasting_groups --value value --group group",
       by_group({{"not yet", with_moments(60, 10, 20)}, {"competent", with_moments(80, 6, 20)}}),
       {{"/estimate", 71.0255004345306},
        {"/false_pass_theoretical", .135111307449},
        {"/false_fail_theoretical", .067359417118}}},
      {"learning_curve --value y --x t", learners, {{"/estimate", .360845261837, 1e-6}}},
      {"lc_cusum --value failed",
       by_column({{"failed", {1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}),
       {{"/weight_success", .251314428281},
        {"/weight_failure", -1.098612288668},
        {"/estimate", 3.5184, 1e-4},
        {"/true_declaration", .94628, 1e-5}}},
      {"power --options n=20,d=1", "", {{"/estimate", .868952801692, 1e-6}}},
      {"power --options d=0.8,power=0.8", "", {{"/estimate", 25.5245816, 1e-6}}},
  };
}

std::vector<Oracle> oracles() {
  std::vector<Oracle> all = oracles_of_groups();
  for (const auto& more : {oracles_of_effects(), oracles_of_relations()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

class Stats : public testing::Test {
 protected:
  const fs::path folder_ = fixtures::fresh_folder("stats");

  fixtures::Ran type(const std::string& words) {
    return fixtures::run("cd '" + folder_.string() + "' && '" + kProgram + "' stats " + words, folder_ / "said");
  }
  Json answer(const std::string& words) {
    const auto ran = type(words + " --json");
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  void write(const std::string& csv) { std::ofstream(folder_ / "data.csv", std::ios::binary) << csv; }
};

TEST_F(Stats, AnswersWhatRAndThePapersDo) {
  std::set<std::string> procedures;
  for (const Oracle& one : oracles()) {
    SCOPED_TRACE(one.words);
    const std::string words = one.words;
    procedures.insert(words.substr(0, words.find(' ')));
    write(one.csv);
    const Json json = answer(words + (one.csv.empty() ? "" : " --csv data.csv"));
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("status"), "ok") << json;
    for (const Number& number : one.numbers) {
      const Json::json_pointer at(number.pointer);
      if (!json.contains(at) || !json.at(at).is_number()) {
        ADD_FAILURE() << number.pointer << " is no number of " << json.dump(1);
        continue;
      }
      const double value = json.at(at).get<double>();
      EXPECT_TRUE(std::abs(value - number.value) <= number.tolerance * std::max(1.0, std::abs(number.value)))
          << number.pointer << " is " << value << ", not " << number.value;
    }
  }
  EXPECT_GE(procedures.size(), 25U);
}

TEST_F(Stats, EveryProcedureStandsOnThePageOfWhatHoldsIt) {
  const std::string page = fixtures::whole_file(fixtures::source_dir() / "docs" / "statistics-held.md");
  for (const app::ProcedureExample& one : app::procedure_examples())
    EXPECT_NE(page.find("| [`" + std::string(one.procedure) + "`]"), std::string::npos) << one.procedure;
}

// As they stand in docs/statistics.md, from the repository's folder.
TEST_F(Stats, EveryExampleOfThePageIsEstimated) {
  fs::create_directories(folder_ / "docs");
  fs::copy(fixtures::source_dir() / "docs" / "statistics", folder_ / "docs" / "statistics",
           fs::copy_options::recursive);
  for (const app::ProcedureExample& one : app::procedure_examples()) {
    const std::string words = std::string(one.procedure) + " " + one.words;
    SCOPED_TRACE(words);
    const Json json = answer(words);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.value("status", ""), "ok") << json;
    const auto ran = type(words);
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out.rfind(one.procedure + std::string(": "), 0), 0U) << ran.out;
  }
}

TEST_F(Stats, TooLittleIsNotEstimableAndNoError) {
  for (const char* csv :
       {"", "group,value\n", "group,value\na,1\n", "group,value\na,1\nb,2\n", "group,value\na,NA\nb,\n"}) {
    write(csv);
    const Json json = answer("welch --csv data.csv --value value --group group");
    EXPECT_EQ(json.at("status"), "not_estimable") << csv;
    EXPECT_TRUE(json.at("reason").is_string() && json.at("reason_words").is_string());
    for (const char* key : {"statistic", "df", "p_value", "estimate", "ci95"})
      EXPECT_TRUE(json.at(key).is_null()) << key;
  }
  write("group,value\na,1\na,1\na,1\nb,2\nb,2\nb,2\n");
  const auto ran = type("welch --csv data.csv --value value --group group");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.out.find("no estimate "), std::string::npos) << ran.out;
}

TEST_F(Stats, ThePersonIsTheUnit) {
  write("who,group,value\nann,a,1\nann,a,2\nbob,a,3\ncid,b,4\ndee,b,6\n");
  EXPECT_EQ(answer("welch --csv data.csv --value value --group group --subject who").at("reason"),
            "repeated_subject");
  write("who,group,value\nann,a,1\nann,b,2\nbob,a,3\ncid,b,4\n");
  EXPECT_EQ(answer("welch --csv data.csv --value value --group group --subject who").at("reason"),
            "subject_in_two_groups");
}

TEST_F(Stats, AFileThatCannotBeUsedIsRefusedWithoutItsContent) {
  const std::string words = " --csv data.csv --value value --group group";
  EXPECT_EQ(type("welch" + words).err, "error: not_found: --csv \"data.csv\": there is no such file\n");
  for (const char* csv : {"value,group\n1,a\nSecret,b\n", "value,other\n1,Secret\n", "value,group\n1,a,Secret\n",
                          "value,group\n1,\"Secret\n", "value,group,value\n1,a,2\n"}) {
    write(csv);
    for (const char* json : {"", " --json"}) {
      const auto ran = type("welch" + words + json);
      EXPECT_EQ(ran.exit_code, 3) << csv;
      EXPECT_EQ(ran.err.rfind("error: bad_csv: --csv \"data.csv\": ", 0), 0U) << ran.err;
      EXPECT_EQ((ran.out + ran.err).find("Secret"), std::string::npos) << ran.err;
      EXPECT_EQ(ran.out.empty(), *json == '\0');
    }
  }
}

TEST_F(Stats, ReadsTwentyThousandRows) {
  std::string csv = "person,group,value\n";
  for (int i = 0; i < 20000; ++i)
    csv += "p" + std::to_string(i) + (i % 2 == 0 ? ",a," : ",b,") + std::to_string((i * 7919) % 10007) + "\n";
  write(csv);
  const Json json = answer("welch --csv data.csv --value value --group group --subject person");
  EXPECT_EQ(json.at("n"), 20000);
}

}  // namespace
}  // namespace seldinger
