// Tests of the table of statistical procedures: all that were promised are there, each says what it is, and none of
// them, given whatever a CSV file can hold, answers a number that is none, nothing, or twice the same name.
#include "app/statistics/procedures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/statistics/answer_json.h"
#include "app/statistics/answer_text.h"
#include "app/statistics/procedure_arguments.h"
#include "app/statistics/table_csv.h"
#include "assessment/statistics/reasons.h"
#include "sim/base/rng.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/places.h"

namespace seldinger::app {

Command stats_command();

namespace {

using assessment::statistics::Answer;
using assessment::statistics::Procedure;
using assessment::statistics::ProcedureOptions;

// Those that scripts may rely on (docs/statistics.md).
constexpr std::array kPromised = {"describe",
                                  "shapiro",
                                  "welch",
                                  "student",
                                  "paired",
                                  "mann_whitney",
                                  "brunner_munzel",
                                  "wilcoxon",
                                  "kruskal",
                                  "dunn",
                                  "welch_anova",
                                  "jonckheere",
                                  "effect_size",
                                  "auc",
                                  "delong",
                                  "icc",
                                  "alpha",
                                  "omega",
                                  "kappa",
                                  "bland_altman",
                                  "spearman",
                                  "holm",
                                  "bh",
                                  "max_t",
                                  "wilson",
                                  "poisson",
                                  "tost",
                                  "kaplan_meier",
                                  "log_rank",
                                  "contrasting_groups",
                                  "borderline",
                                  "angoff",
                                  "mixed_model",
                                  "learning_curve",
                                  "lc_cusum",
                                  "g_theory",
                                  "rasch",
                                  "grim",
                                  "power"};

TEST(Procedures, AllThatWerePromisedAreThereOnce) {
  std::set<std::string> names;
  for (const Procedure& one : procedures())
    EXPECT_TRUE(names.insert(one.name).second) << one.name << " is there twice";
  for (const char* name : kPromised) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_EQ(find_procedure(name), names.contains(name) ? find_procedure(name) : nullptr);
  }
  EXPECT_EQ(find_procedure("t_test"), nullptr);
}

TEST(Procedures, SayWhatTheyAreAndWhoPublishedThem) {
  for (const Procedure& one : procedures()) {
    SCOPED_TRACE(one.name);
    for (const char* text : {one.summary, one.columns, one.source, one.oracle}) {
      ASSERT_NE(text, nullptr);
      EXPECT_GT(std::string(text).size(), 3U) << text;
      EXPECT_EQ(std::string(text).find("TODO"), std::string::npos);
    }
    EXPECT_TRUE(std::string(one.summary).ends_with(".")) << one.summary;
    EXPECT_LE(one.needs.least_values, one.needs.most_values);
    std::set<std::string> options;
    for (const auto& option : one.options) {
      const std::string name = option.name;
      EXPECT_TRUE(options.insert(name).second) << name << " is there twice";
      EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << name;
      EXPECT_GT(std::string(option.value).size(), 3U) << name;
      EXPECT_GT(std::string(option.words).size(), 5U) << name;
    }
  }
}

TEST(Procedures, EachHasAnExample) {
  std::set<std::string> names;
  for (const ProcedureExample& one : procedure_examples()) {
    names.insert(one.procedure);
    EXPECT_NE(find_procedure(one.procedure), nullptr) << one.procedure;
  }
  for (const Procedure& one : procedures()) EXPECT_TRUE(names.contains(one.name)) << one.name;
}

// What stands in the table that a command would read.
struct Asked {
  std::string csv;
  TableColumns columns;
  std::map<std::string, std::string> options;

  std::string as_typed() const {
    std::string text = csv;
    for (const auto& [name, value] : options) text += name + "=" + value + " ";
    return text;
  }
};

class Degenerate {
 public:
  explicit Degenerate(std::uint64_t seed) : random_(seed) {}

  Asked ask(const Procedure& procedure) {
    Asked asked;
    const std::size_t most = std::min<std::size_t>(procedure.needs.most_values, procedure.needs.least_values + 3);
    const std::size_t columns =
        procedure.needs.least_values + random_.bits() % (most - procedure.needs.least_values + 1);
    // Names that an answer has of its own.
    const std::array<const char*, 6> names = {"value", "n", "p_value", "name", "estimate", "low"};
    for (std::size_t i = 0; i < columns; ++i)
      asked.columns.values.push_back(i < names.size() ? names[i] : "q" + std::to_string(i));
    const auto maybe = [&](bool needed, const char* name) { return needed || random_.bits() % 3 == 0 ? name : ""; };
    asked.columns.group = maybe(procedure.needs.group, "group");
    asked.columns.subject = maybe(procedure.needs.subject, "subject");
    asked.columns.rater = maybe(procedure.needs.rater, "rater");
    asked.columns.x = maybe(procedure.needs.x, "x");
    write_csv(asked);
    for (const auto& option : procedure.options)
      if (random_.bits() % 3 == 0) asked.options[option.name] = option_value(option.value);
    return asked;
  }

  // An example of the docs with odd cells, rows that are gone, and now and then another option.
  std::pair<Asked, assessment::statistics::DataTable> worn(const Procedure& procedure,
                                                           const ProcedureExample& example) {
    std::vector<std::string> words = {procedure.name};
    std::istringstream typed(example.words);
    for (std::string word; typed >> word;) words.push_back(word);
    Asked asked;
    const auto csv = std::find(words.begin(), words.end(), "--csv");
    if (csv != words.end()) {
      asked.csv = worn_csv(fixtures::source_dir() / *(csv + 1));
      *(csv + 1) = (fixtures::fresh_test_folder("statistics") / "worn.csv").string();
      std::ofstream(*(csv + 1)) << asked.csv;
    }
    const Arguments arguments(stats_command(), words);
    asked.columns = columns_for(procedure, arguments);
    asked.options = options_for(procedure, arguments.text("--options")).all();
    for (const auto& option : procedure.options)
      if (random_.bits() % 12 == 0) asked.options[option.name] = option_value(option.value);
    auto read = read_for(procedure, asked.columns, arguments);
    EXPECT_TRUE(read) << (read ? "" : read.error().text);
    return {std::move(asked), read ? std::move(read->table) : assessment::statistics::DataTable()};
  }

 private:
  std::string worn_csv(const std::filesystem::path& file) {
    std::ifstream lines(file);
    std::string text, line;
    std::getline(lines, text);
    text += "\n";
    const auto kind = static_cast<unsigned>(random_.bits() % 8);
    // Some have their rows, so that those that must be whole are.
    const auto kept = random_.bits() % 3 == 0 ? random_.bits() % 12 : 1000;
    const bool gaps = random_.bits() % 2 == 0;
    const auto seldom = std::uint64_t{60} << random_.bits() % 6;
    for (std::uint64_t row = 0; std::getline(lines, line) && row < kept; ++row) {
      if (gaps && random_.bits() % 20 == 0) continue;
      std::string made, cell;
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        made += (random_.bits() % seldom == 0 ? number(kind) : cell) + ",";
      made.back() = '\n';
      text += made;
    }
    return text;
  }

  template <std::size_t N>
  const char* one_of_these(const std::array<const char*, N>& words) {
    return words[random_.bits() % N];
  }

  std::string number(unsigned kind) {
    if (random_.bits() % 12 == 0)
      return one_of_these(std::array{"", "NA", "1e300", "-1e300", "1e-320", "0", "-1", "0.5"});
    switch (kind) {
      case 0:
        return "3";  // all the same
      case 1:
        return std::to_string(random_.bits() % 2);  // yes and no
      case 2:
        return std::to_string(1 + random_.bits() % 5);  // a scale with ties
      case 3:
        return std::to_string(random_.uniform());  // shares
      case 4:
        return std::to_string(50.0 + 12.0 * random_.normal());
      case 5:
        return one_of_these(std::array{"1e300", "-1e300", "1e-320", "5"});
      case 6:
        return std::to_string(random_.bits() % 1000);
      default:
        return std::to_string(1e9 + random_.uniform());  // large, and nearly the same
    }
  }

  void write_csv(Asked& asked) {
    std::string& csv = asked.csv;
    for (const std::string& name : asked.columns.values) csv += name + ",";
    csv += "group,subject,rater,x\n";
    const auto rows = random_.bits() % 3 == 0 ? random_.bits() % 40 : random_.bits() % 9;
    const auto groups = 1 + random_.bits() % 4, people = 1 + random_.bits() % 9, raters = 1 + random_.bits() % 4;
    const bool own_people = random_.bits() % 2 == 0;
    const auto kind = static_cast<unsigned>(random_.bits() % 8),
               kind_of_x = static_cast<unsigned>(random_.bits() % 8);
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < asked.columns.values.size(); ++i) csv += number(kind) + ",";
      csv +=
          random_.bits() % 20 == 0 ? "," : std::string(1, static_cast<char>('a' + random_.bits() % groups)) + ",";
      csv += "p" + std::to_string(own_people ? row : row / raters % people) + ",";
      csv += "r" + std::to_string(row % raters) + "," + number(kind_of_x) + "\n";
    }
  }

  // Of what the option's words name, or something that fits nothing.
  std::string option_value(const std::string& takes) {
    if (random_.bits() % 3 != 0) {
      std::vector<std::string> words;
      std::string word;
      for (const char c : takes + " ") {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.') {
          word += c;
        } else if (!word.empty()) {
          words.push_back(word);
          word.clear();
        }
      }
      if (!words.empty() && random_.bits() % 2 == 0) return words[random_.bits() % words.size()];
    }
    return one_of_these(std::array{"",        "0",      "1",      "2",   "-1",    "0.5", "0.05", "0.8", "10",
                                   "1e300",   "-1e300", "1e-320", "nan", "inf",   "a",   "a:b",  "b:a", "a:b:c",
                                   "greater", "less",   "no",     "yes", "10:20", "x=y", "value"});
  }

  base::Rng random_;
};

bool all_finite(const std::vector<assessment::statistics::Named>& values) {
  return std::all_of(values.begin(), values.end(), [](const auto& one) { return std::isfinite(one.value); });
}

// What a shelf's function must have settled before anybody sees it.
void expect_settled(const Answer& answer, const Procedure& procedure) {
  EXPECT_EQ(answer.test, procedure.name);
  for (const auto& number : {answer.statistic, answer.p_value, answer.estimate})
    EXPECT_TRUE(!number || std::isfinite(*number));
  EXPECT_TRUE(!answer.p_value || (*answer.p_value >= 0.0 && *answer.p_value <= 1.0));
  EXPECT_TRUE(!answer.ci95 || (std::isfinite(answer.ci95->low) && answer.ci95->low <= answer.ci95->high));
  EXPECT_TRUE(std::all_of(answer.df.begin(), answer.df.end(), [](double one) { return std::isfinite(one); }));
  EXPECT_TRUE(all_finite(answer.more));
  for (const auto& row : answer.rows) EXPECT_TRUE(all_finite(row.values)) << row.name;
  if (answer.estimable()) {
    EXPECT_FALSE(answer.method.empty());
    EXPECT_TRUE(answer.statistic || answer.p_value || answer.estimate || !answer.more.empty() ||
                !answer.rows.empty());
  } else {
    EXPECT_NE(assessment::statistics::find_reason(answer.reason.c_str()), nullptr) << answer.reason;
    EXPECT_FALSE(answer.statistic || answer.p_value || answer.estimate || answer.ci95) << "numbers beside a reason";
  }
}

// No word of a number that is none, wherever it stands, unless somebody typed it.
void expect_no_broken_number(const std::string& said, const Asked& asked) {
  std::string word;
  for (const char c : said + " ") {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    const bool typed = std::any_of(asked.options.begin(), asked.options.end(),
                                   [&](const auto& option) { return option.second == word; });
    EXPECT_TRUE(typed || (word != "nan" && word != "inf" && word != "infinity")) << said;
    word.clear();
  }
}

class EveryProcedure : public testing::TestWithParam<const char*> {};

// Whether something was estimated.
bool answers_or_says_why(const Procedure& procedure, const Asked& asked,
                         const assessment::statistics::DataTable& table) {
  SCOPED_TRACE(asked.as_typed());
  const Answer answer = procedure.run(table, ProcedureOptions(asked.options));
  expect_settled(answer, procedure);
  const nlohmann::json json = nlohmann::json::parse(json_of_answer(answer), nullptr, false);
  EXPECT_FALSE(json.is_discarded());
  EXPECT_EQ(json.value("status", ""), answer.estimable() ? "ok" : "not_estimable");
  expect_no_broken_number(text_of_answer(answer), asked);
  return answer.estimable();
}

TEST_P(EveryProcedure, AnswersOrSaysWhyWhateverTheFileHolds) {
  ASSERT_NE(find_procedure(GetParam()), nullptr);
  const Procedure& procedure = *find_procedure(GetParam());
  Degenerate degenerate(1);
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    const Asked asked = degenerate.ask(procedure);
    const auto read = table_in_csv(asked.csv, asked.columns);
    ASSERT_TRUE(read) << read.error().text;
    answers_or_says_why(procedure, asked, read->table);
  }
}

// Chance alone seldom deals a table and options that fit together; an example of the docs that is worn does, and
// its odd cells reach what a table of odd cells alone is refused before.
TEST_P(EveryProcedure, AnswersOrSaysWhyOfAWornExample) {
  ASSERT_NE(find_procedure(GetParam()), nullptr);
  const Procedure& procedure = *find_procedure(GetParam());
  Degenerate degenerate(2);
  constexpr int kWorn = 60;
  int estimated = 0, asked_for = 0;
  for (const ProcedureExample& example : procedure_examples())
    for (int i = 0; example.procedure == std::string_view(procedure.name) && i < kWorn && !HasFailure(); ++i) {
      const auto [asked, table] = degenerate.worn(procedure, example);
      estimated += answers_or_says_why(procedure, asked, table) ? 1 : 0;
      ++asked_for;
    }
  EXPECT_EQ(asked_for, kWorn);
  EXPECT_GE(estimated, 5) << "the sweep does not reach it";
}

TEST_P(EveryProcedure, HasNothingToSayOfAHeaderAlone) {
  ASSERT_NE(find_procedure(GetParam()), nullptr);
  const Procedure& procedure = *find_procedure(GetParam());
  if (procedure.needs.least_values == 0) return;
  TableColumns columns;
  std::string header;
  for (std::size_t i = 0; i < procedure.needs.least_values; ++i) {
    columns.values.push_back("v" + std::to_string(i));
    header += columns.values.back() + ",";
  }
  if (procedure.needs.group) columns.group = "group";
  if (procedure.needs.subject) columns.subject = "subject";
  if (procedure.needs.rater) columns.rater = "rater";
  if (procedure.needs.x) columns.x = "x";
  for (const std::string& text : {header + "group,subject,rater,x\n", std::string()}) {
    const auto read = table_in_csv(text, columns);
    ASSERT_TRUE(read);
    const Answer answer = procedure.run(read->table, ProcedureOptions());
    EXPECT_FALSE(answer.estimable());
    EXPECT_EQ(answer.n, 0U);
  }
}

std::vector<const char*> names_of_procedures() {
  std::vector<const char*> names;
  for (const Procedure& one : procedures()) names.push_back(one.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Procedures, EveryProcedure, testing::ValuesIn(names_of_procedures()),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace seldinger::app
