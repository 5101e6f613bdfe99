// A questionnaire from its file to R by the built program: stored, opened, typed twice from paper, exported,
// closed; and the page of the three workshops.
#include <fstream>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

class QuestionnaireCommands : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("questionnaire_commands")};
  std::string code_;

  void SetUp() override {
    library_.done("user add adam --role admin --new-library");
    for (const char* user :
         {"rita --role researcher", "mona --role mentor", "max --role mentor", "tina --role trainee"})
      library_.done(std::string("user add ") + user);
    fixtures::run(
        std::string(fixtures::kProgram) + " questionnaire template workshop-2006 --out '" + at("form.json") + "'",
        library_.folder());
    library_.done("questionnaire add " + at("form.json") + " --by mona");
    code_ = library_.ask(
        "questionnaire open workshop-2006 --title Day --group trainee --group expert --by mona")["code"];
  }
  std::string at(const char* name) const { return (library_.folder() / name).string(); }
  std::string refusal(const std::string& words) {
    const auto ran = library_.call(words);
    EXPECT_EQ(ran.exit_code, 3) << words << ran.out;
    const std::size_t from = ran.err.find("error: ") + 7;
    return ran.err.substr(from, ran.err.find(':', from) - from);
  }
  void write(const char* name, const std::string& rows) {
    std::ofstream(at(name)) << "respondent,version,group,1,2,3,4,5,6a,6b,7,8a,8b,8c,8d,8e,8f,8g,8h,9\n" << rows;
  }
};

TEST_F(QuestionnaireCommands, GoFromPaperTypedTwiceToATable) {
  write("first.csv",
        "A1,1,trainee,SpR,female,31,2,4,12,3,2,4,3,2,3,3,n/a,4,,good\n"
        "A2,1,expert,consultant,male,52,20.5,10,n/a,n/a,3,4,3,2,3,3,3,4,2,\n");
  write("second.csv",
        "A2,1,expert,consultant,male,52,20.5,10,n/a,n/a,3,4,3,2,3,3,3,4,2,\n"
        "A1,1,trainee,SpR,female,31,2,4,12,3,2,4,2,2,3,3,n/a,4,,good\n");
  const auto differing = library_.call("questionnaire import " + code_ + " " + at("first.csv") + " " +
                                       at("second.csv") + " --by mona --json");
  EXPECT_EQ(differing.exit_code, 1);
  const auto told = nlohmann::json::parse(differing.out, nullptr, false);
  ASSERT_EQ(told["differences"].size(), 1U);
  EXPECT_EQ(told["differences"][0]["column"], "8b");
  EXPECT_EQ(told["stored"], 0);
  const std::string import = "questionnaire import " + code_ + " " + at("first.csv") + " " + at("first.csv");
  EXPECT_EQ(refusal(import + " --by tina"), "not_allowed");
  EXPECT_EQ(library_.ask(import + " --by mona")["stored"], 2);
  EXPECT_EQ(refusal(import + " --by mona"), "bad_answers") << "typed in again";

  const std::string exported = "questionnaire export " + code_ + " --out " + at("answers.csv");
  for (const char* other : {"max", "tina", "rita", "adam"})
    EXPECT_EQ(refusal(exported + " --by " + other), "not_allowed") << other;
  library_.done(exported + " --by mona");
  const auto table = fixtures::csv_table(fixtures::whole_file(at("answers.csv")));
  ASSERT_EQ(table.rows.size(), 2U * 17U);
  std::map<std::string, std::string> said;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    said[table.cell(row, "respondent") + " " + table.cell(row, "item")] =
        table.cell(row, "state") + " " + table.cell(row, "value") + table.cell(row, "comment");
  EXPECT_EQ(said["A1 8f"], "not_applicable ");
  EXPECT_EQ(said["A1 8h"], "missing ");
  EXPECT_EQ(said["A1 9"], "answered good");
  EXPECT_EQ(said["A2 4"], "answered 20.5");
  EXPECT_EQ(said["A2 1"], "answered 3");

  // From answers to a statistic without another program: two people, so nothing is estimated, and it says so.
  library_.done("questionnaire export " + code_ + " --scores --out " + at("scores.csv") + " --by mona");
  const auto alpha = fixtures::run(
      std::string(fixtures::kProgram) + " stats alpha --csv '" + at("scores.csv") + "' --value 8a,8b,8c,8d --json",
      library_.folder());
  EXPECT_NE(alpha.out.find("\"reason\": \"too_few\""), std::string::npos) << alpha.out << alpha.err;

  library_.done("questionnaire close " + code_ + " --by mona");
  EXPECT_EQ(refusal(import + " --by mona"), "round_closed");
  library_.done("check");
}

TEST_F(QuestionnaireCommands, OfAStudyAreItsResearchersToReadOnceThePlanIsFrozen) {
  library_.done("study new Needles");
  library_.done("study researcher Needles --user rita");
  const std::string code =
      library_.ask("questionnaire open workshop-2006 --title Visit --study Needles --by mona")["code"];
  library_.done("questionnaire export " + code + " --out " + at("study.csv") + " --by rita");
  EXPECT_EQ(refusal("questionnaire export " + code_ + " --out " + at("other.csv") + " --by rita"), "not_allowed");
  EXPECT_EQ(refusal("questionnaire export XXXXXX --out " + at("other.csv") + " --by rita"), "not_allowed");
}

TEST_F(QuestionnaireCommands, DrawTheThesisThreeWorkshops) {
  const auto ran =
      fixtures::run(std::string(fixtures::kProgram) + " report workshops --out '" + at("workshops.html") + "'",
                    library_.folder());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(fixtures::whole_file(at("workshops.html")).find("Figure 6.18"), std::string::npos);
}

}  // namespace
}  // namespace seldinger
