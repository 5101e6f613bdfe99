// Replays rated by the built program: a round opened, its keys, what raters said, agreement and a table for
// statistics; and who may do it.
#include "casedb/ratings/rating_rounds.h"

#include <fstream>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

class RatingCommands : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("rating_commands")};

  std::string at(const char* name) const { return (library_.folder() / name).string(); }
  std::string refusal(const std::string& words) {
    const auto ran = library_.call(words);
    EXPECT_EQ(ran.exit_code, 3) << words << ran.out;
    const std::size_t from = ran.err.find("error: ") + 7;
    return ran.err.substr(from, ran.err.find(':', from) - from);
  }
  void SetUp() override {
    library_.demo("--drills");
    for (const char* user : {"rita --role researcher", "mona --role mentor", "tina --role trainee"})
      library_.done(std::string("user add ") + user);
    fixtures::run(
        std::string(fixtures::kProgram) + " questionnaire template osats-grs --out '" + at("grs.json") + "'",
        library_.folder());
    library_.done("questionnaire add " + at("grs.json") + " --by mona");
  }
};

TEST_F(RatingCommands, GoFromReplaysToAgreementAndATable) {
  std::string named;
  std::vector<std::string> attempts;
  const auto listed = library_.ask("attempt list");
  for (const auto& one : listed["attempts"]) {
    attempts.push_back(one["attempt_id"].get<std::string>());
    named += " --attempt " + attempts.back();
  }
  ASSERT_GE(attempts.size(), 3U);
  std::ofstream(at("known.csv")) << "attempt,tissue,time\n" << attempts.back() << ",4,3\n";
  const std::string open = "rating open osats-grs --title Spring --raters 2 --known " + at("known.csv") + named;
  EXPECT_EQ(refusal(open + " --by tina"), "not_allowed");
  EXPECT_EQ(refusal("rating open osats-grs --title Spring --by mona"), "bad_design");
  const auto opened = library_.ask(open + " --by mona");
  EXPECT_EQ(opened["replays"], attempts.size() - 1);
  EXPECT_EQ(opened["calibration"], 1);
  ASSERT_EQ(opened["keys"].size(), 2U);
  const std::string code = opened["code"];

  {
    // What a page does (tests/web/rating_test.cpp): the same scores from both, one point apart in time.
    auto library = casedb::Library::open(library_.path());
    ASSERT_TRUE(library.has_value());
    for (std::size_t r = 0; r < 2; ++r) {
      const std::string secret = casedb::rater_secret(opened["keys"][r]["key"]);
      const auto bench = casedb::find_rating_bench(*library, secret);
      ASSERT_TRUE(bench.has_value());
      ASSERT_EQ(bench->tasks.size(), attempts.size());
      for (const auto& task : bench->tasks) {
        const auto page = casedb::find_rating(*library, secret, task.number);
        ASSERT_TRUE(page.has_value());
        EXPECT_NE(page->sheet.find("data:image/png;base64,"), std::string::npos) << "pictures are there";
        std::size_t frames = 0;
        for (std::size_t at = 0; (at = page->sheet.find("data-t=", at)) != std::string::npos; ++at) ++frames;
        EXPECT_EQ(frames, 121U) << "as many in each, however long it took";
        for (const std::string& id : attempts) EXPECT_EQ(page->sheet.find(id), std::string::npos);
        for (const char* word : {"expert", "Drill", "drill", "202", "simulated"})
          EXPECT_EQ(page->sheet.substr(0, page->sheet.find("base64")).find(word), std::string::npos) << word;
        std::map<std::string, std::string> typed;
        for (const char* item : {"tissue", "handling", "knowledge", "flow", "procedure"})
          typed[item] = std::to_string(2 + page->sheet.size() % 3);
        typed["time"] = r == 0 ? "4" : "3";
        ASSERT_TRUE(casedb::keep_rating(*library, secret, task.number, typed, true));
      }
    }
  }

  for (const char* other : {"tina", "rita"})
    EXPECT_EQ(refusal("rating show " + code + " --by " + other), "not_allowed");
  const auto shown = library_.ask("rating show " + code + " --by mona");
  EXPECT_EQ(shown["sent"], 2 * attempts.size());
  ASSERT_EQ(shown["scores"].size(), 7U) << "the mean and six items";
  for (const auto& score : shown["scores"])
    if (score["item"] == "time") {
      EXPECT_NEAR(score["raters"][0]["severity"]["value"].get<double>(), -0.5, 1e-12) << "R1 gives a point more";
      EXPECT_NEAR(score["raters"][0]["off_known"].get<double>(), 1.0, 1e-12);
    }
  library_.done("rating export " + code + " --out " + at("ratings.csv") + " --by mona");
  const auto table = fixtures::csv_table(fixtures::whole_file(at("ratings.csv")));
  EXPECT_EQ(table.rows.size(), 2 * (attempts.size() - 1));
  library_.done("rating export " + code + " --all --out " + at("all.csv") + " --by mona");
  EXPECT_EQ(fixtures::csv_table(fixtures::whole_file(at("all.csv"))).rows.size(), 2 * attempts.size());
  const auto icc = fixtures::run(std::string(fixtures::kProgram) + " stats icc --csv '" + at("ratings.csv") +
                                     "' --value tissue --subject replay --rater rater --json",
                                 library_.folder());
  EXPECT_EQ(icc.exit_code, 0) << icc.out << icc.err;

  EXPECT_EQ(refusal("questionnaire export " + code + " --out " + at("x.csv") + " --by mona"), "rated_round");
  const std::string other = library_.ask("questionnaire open osats-grs --title Day --by mona")["code"];
  EXPECT_EQ(refusal("rating show " + other + " --by mona"), "not_rated");
  library_.done("check");
}

// Nobody who works on a study gets what was said by person before its plan is frozen; how far raters agree they may
// know.
TEST_F(RatingCommands, OfAStudyWhosePlanIsADraftNothingIsExportedToItsResearchers) {
  library_.done("study new Needles");
  library_.done("study researcher Needles --user rita");
  const std::string case_id = library_.ask("case list")["cases"][0]["case_id"];
  fixtures::run(std::string(fixtures::kProgram) + " study template --library '" + library_.path() + "' --case " +
                    case_id + " --out '" + at("plan.json") + "'",
                library_.folder());
  std::ofstream(at("answered.json")) << fixtures::answered(fixtures::whole_file(at("plan.json")));
  library_.done("study plan Needles " + at("answered.json") + " --by rita");
  const std::string attempt = library_.ask("attempt list")["attempts"][0]["attempt_id"];
  const std::string code = library_.ask("rating open osats-grs --title Spring --study Needles --attempt " +
                                        attempt + " --by rita")["code"];
  library_.done("rating show " + code + " --by rita");
  EXPECT_EQ(refusal("rating export " + code + " --out " + at("x.csv") + " --by rita"), "blinded");
  EXPECT_FALSE(std::filesystem::exists(at("x.csv")));
  const std::string round =
      library_.ask("questionnaire open osats-grs --title Visit --study Needles --by rita")["code"];
  EXPECT_EQ(refusal("questionnaire export " + round + " --out " + at("y.csv") + " --by rita"), "blinded");
  library_.done("study freeze Needles --by rita");
  library_.done("rating export " + code + " --out " + at("x.csv") + " --by rita");
  library_.done("questionnaire export " + round + " --out " + at("y.csv") + " --by rita");
}

// Simulated people's replays by simulated raters, and their own answers: in agreement, tables and the report, and
// each says that it is simulated.
TEST_F(RatingCommands, SimulatedAnswersSayThatTheyAre) {
  const std::string attempt = library_.ask(
      "simulate --case 'Drill 1' --operator expert --people 2 --seed 1 --no-pictures")["attempts"][0]["attempt_id"];
  library_.done("study new Simulated");
  fixtures::run(std::string(fixtures::kProgram) + " study template --library '" + library_.path() +
                    "' --case 'Drill 1' --out '" + at("plan.json") + "'",
                library_.folder());
  std::string plan = fixtures::answered(fixtures::whole_file(at("plan.json")));
  const std::string people = "\"people\": \"real\"";
  ASSERT_NE(plan.find(people), plan.npos);
  std::ofstream(at("simulated.json")) << plan.replace(plan.find(people), people.size(),
                                                      "\"people\": \"simulated\"");
  library_.done("study plan Simulated " + at("simulated.json"));
  library_.done("study freeze Simulated");
  library_.done("study enrol Simulated --all");
  const std::string rated =
      library_.ask("rating open osats-grs --title Spring --study Simulated --attempt " + attempt)["code"];
  const std::string asked = library_.ask("questionnaire open osats-grs --title Day --study Simulated")["code"];
  EXPECT_EQ(library_.ask("simulate answers " + rated)["sent"], 2U);
  EXPECT_EQ(library_.ask("simulate answers " + asked)["sent"], 2U);
  EXPECT_EQ(library_.ask("simulate answers " + asked)["there"], 2U);
  EXPECT_EQ(library_.ask("rating show " + rated)["simulated"], 2U);
  library_.done("rating export " + rated + " --out " + at("ratings.csv"));
  library_.done("questionnaire export " + asked + " --out " + at("answers.csv"));
  const auto ratings = fixtures::csv_table(fixtures::whole_file(at("ratings.csv")));
  ASSERT_EQ(ratings.rows.size(), 2U);
  for (std::size_t row = 0; row < 2; ++row) EXPECT_EQ(ratings.cell(row, "simulated"), "1");
  const auto answers = fixtures::csv_table(fixtures::whole_file(at("answers.csv")));
  ASSERT_EQ(answers.rows.size(), 2U * 7U);
  for (std::size_t row = 0; row < answers.rows.size(); ++row) {
    EXPECT_EQ(answers.cell(row, "source"), "simulated");
    EXPECT_EQ(answers.cell(row, "respondent").substr(0, 2), "S-");
  }
  library_.done("report validity --study Simulated --out " + at("report.html"));
  const std::string report = fixtures::whole_file(at("report.html"));
  EXPECT_NE(report.find("SIMULATED"), report.npos);
  EXPECT_NE(report.find("Global rating of a needle puncture"), report.npos);
  library_.done("check");
}

}  // namespace
}  // namespace seldinger
