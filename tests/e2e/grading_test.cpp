// Grades at the command line: simulated experts and novices side by side on a real CT, with the sentences that they
// were told; curricula from a mentor's draft to a trainee's state.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;

class GradingCommands : public testing::Test {
 protected:
  const fixtures::CommandLibrary library_{fixtures::fresh_folder(
      std::string("grading_") + testing::UnitTest::GetInstance()->current_test_info()->name())};

  fixtures::Ran call(const std::string& words) const { return library_.call(words); }
  void done(const std::string& words) const { library_.done(words); }
  Json answer(const std::string& words) const { return library_.ask(words); }
  std::string code_of(const std::string& words) {
    const auto ran = call(words);
    return ran.exit_code == 3 ? ran.err.substr(7, ran.err.find(':', 7) - 7) : std::to_string(ran.exit_code);
  }
  // A case from a real abdomen under MPR, with a rule; published.
  std::string real_case() {
    done("user add mentor --role mentor --new-library");
    const Json made = answer("import '" + fixtures::shared_data_dir().string() +
                             "/ct-abdomen-contrast-dicom' --title Liver --no-burned-in-text --by mentor");
    const std::string id = made.at("case_id");
    done("case lesion " + id + " --center-mm -115,-5,-98 --radius-mm 7.5 --hu 12");
    done("case setting " + id +
         " --instrument access --pass 'hit >= 1' --pass 'advance_visible_share >= 0.8' --pass 'skin_punctures <= 1'"
         " --time-limit-s 300");
    done("cohort add Autumn --programme Radiology");
    done("cohort enrol Autumn --user mentor --mentor");
    done("case publish " + id + " --by mentor --own-cohort");
    return id;
  }
};

TEST_F(GradingCommands, ExpertsAndNovicesSideBySideOnARealCt) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::string id = real_case();
  const Json experts = answer("simulate --case " + id + " --operator expert --count 5");
  const Json novices = answer("simulate --case " + id + " --operator novice --count 5 --seed 21");
  ASSERT_EQ(experts.at("attempts").size(), 5U);
  for (const Json* all : {&experts, &novices}) {
    const Json& attempts = all->at("attempts");
    for (const Json& one : attempts) {
      for (const char* field : {"attempt_id", "operator", "seed", "metrics", "grade", "score", "debrief"})
        EXPECT_TRUE(one.contains(field)) << field;
      const Json& grade = one.at("grade");
      EXPECT_EQ(grade.at("criteria").size(), 4U) << "three and the time limit";
      EXPECT_EQ(grade.at("provisional"), true);
      const Json& criteria = grade.at("criteria");
      const bool all_met = std::all_of(criteria.begin(), criteria.end(),
                                       [](const Json& criterion) { return criterion.at("outcome") == "met"; });
      EXPECT_EQ(grade.at("verdict"), all_met ? "passed" : "failed");
      EXPECT_TRUE(one.at("score").at("value").is_null()) << "simulated operators set no standard";
      EXPECT_EQ(one.at("score").at("reason"), "no_expert_set");
      EXPECT_EQ(one.at("debrief").size(), 3U);
    }
  }

  const Json side =
      answer("attempt compare --case " + id + " --out '" + (library_.folder() / "side.html").string() + "'");
  const Json& groups = side.at("groups");
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].at("operator"), "expert");
  EXPECT_EQ(groups[1].at("operator"), "novice");
  EXPECT_TRUE(side.at("experts").is_null()) << "no number of a simulated operator's";
  for (const Json& group : groups) {
    EXPECT_EQ(group.at("simulated"), true);
    EXPECT_EQ(group.at("attempts"), 5);
    EXPECT_EQ(group.at("graded").size(), 5U);
  }
  EXPECT_GT(groups[0].at("passed").get<int>(), groups[1].at("passed").get<int>())
      << "the simulated expert is built to do better";
  const std::string page = fixtures::whole_file(library_.folder() / "side.html");
  for (const char* text :
       {"Simulated expert", "Simulated novice", "Feedback on each attempt",
        "Training only, not for planning a patient&#39;s procedure.", "No expert has set a standard yet"})
    EXPECT_NE(page.find(text), page.npos) << text;

  // The same grade wherever it is asked.
  const std::string attempt_id = novices.at("attempts")[0].at("attempt_id");
  const Json shown = answer("attempt show " + attempt_id), scored = answer("score " + attempt_id);
  EXPECT_EQ(shown.at("grade"), scored.at("grade"));
  EXPECT_EQ(shown.at("debrief"), scored.at("debrief"));
  EXPECT_EQ(shown.at("grade"), novices.at("attempts")[0].at("grade"));
  const Json listed = answer("attempt list");
  EXPECT_EQ(listed.at("attempts")[0].at("verdict"), novices.at("attempts")[4].at("grade").at("verdict"));
  EXPECT_EQ(page.find("Consultants"), page.npos);
  done("user add director --role director");
  EXPECT_EQ(code_of("standard set " + id + " --by director"), "too_few_consultants");
  EXPECT_EQ(code_of("standard set " + id + " --by mentor"), "not_allowed");
  EXPECT_TRUE(answer("standard show " + id).at("standards").empty());
  EXPECT_EQ(code_of("attempt compare --case " + id + " --modality xray"), "no_attempt");
  EXPECT_EQ(code_of("attempt compare --case 00000000-0000-7000-8000-000000000000"), "no_case");
}

TEST_F(GradingCommands, ACurriculumFromDraftToDue) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::string id = real_case();
  done("user add director --role director");
  done("user add trainee --role trainee --level trainee");
  done("user add reader --role mentor");
  done("user level reader --level consultant");
  const Json users = answer("user list").at("users");
  std::map<std::string, Json> levels;
  for (const Json& one : users) levels[one.at("name")] = one.at("level");
  EXPECT_EQ(levels.at("trainee"), "trainee");
  EXPECT_EQ(levels.at("reader"), "consultant");
  EXPECT_TRUE(levels.at("mentor").is_null());
  EXPECT_EQ(call("user level reader --level professor").exit_code, 2);
  EXPECT_EQ(code_of("user level nobody --level consultant"), "no_user");

  const std::string curriculum = answer("curriculum add 'First year' --by mentor").at("curriculum_id");
  EXPECT_EQ(code_of("curriculum add X --by trainee"), "not_allowed");
  EXPECT_EQ(answer("curriculum item " + curriculum + " --case " + id + " --attempt-limit 7 --by mentor").at("item"),
            1);
  EXPECT_EQ(code_of("curriculum item " + curriculum + " --case " + id + " --by mentor"), "case_taken");
  EXPECT_EQ(call("curriculum item " + curriculum + " --case " + id + " --after 1:started --by mentor").exit_code,
            2);
  EXPECT_EQ(code_of("curriculum publish " + curriculum + " --by mentor"), "not_allowed");
  done("curriculum publish " + curriculum + " --by director");
  EXPECT_EQ(answer("curriculum list").at("curricula")[0].at("state"), "published");
  // What a simulated operator does is nobody's progress.
  done("simulate --case " + id + " --operator expert");
  const std::string of_trainee = "curriculum show " + curriculum + " --user trainee";
  EXPECT_EQ(answer(of_trainee).at("items")[0].at("case_id"), nullptr)
      << "before: due, and nobody let them practise it";
  done("cohort enrol Autumn --user trainee");
  const Json item = answer(of_trainee).at("items")[0];
  EXPECT_EQ(item.at("case_id"), id);
  EXPECT_EQ(item.at("state"), "not_started");
  EXPECT_EQ(item.at("due"), true);
  EXPECT_EQ(item.at("attempts_left"), 7);
  EXPECT_FALSE(answer("curriculum show " + curriculum).at("items")[0].contains("state"));
  EXPECT_EQ(code_of("curriculum remove " + curriculum + " --by mentor"), "not_allowed");
  done("curriculum remove " + curriculum + " --by director");
  EXPECT_EQ(answer("curriculum show " + curriculum).at("state"), "retired");
}

}  // namespace
}  // namespace seldinger
