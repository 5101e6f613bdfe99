// A questionnaire at the workstation: due after an attempt, half answered by keys when the program is killed, gone
// on with by mouse, sent once, and exported as it was typed.
#include <gtest/gtest.h>
#include <signal.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

class TrainAnswerTest : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_test_folder("train_answer")};
  std::unique_ptr<fixtures::Trainee> person_;

  void sit_down() {
    person_.reset();
    person_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_.path(), library_.folder(),
                                                  fixtures::in_small_window({"--mute"}));
    ASSERT_FALSE(HasFailure());
  }
  std::string focus() const { return person_->now().value("focus", ""); }
  void go_to(const std::string& name, const std::string& key = "Tab") const {
    std::string passed = focus();
    for (int i = 0; i < 60 && focus() != name; ++i) {
      const std::string before = focus();
      person_->press(key);
      if (!fixtures::until([&] { return focus() != before; }, 1.5)) {
        ASSERT_TRUE(person_->passes(0.3));
      }
      passed += ", " + focus();
    }
    ASSERT_EQ(focus(), name) << passed;
  }
  void tick(const std::string& name) const {
    ASSERT_NO_FATAL_FAILURE(go_to(name));
    person_->press("space");
  }
};

// By keys 1 and 3, by mouse the others, and nothing of who it was.
void expect_answers(const std::string& csv) {
  EXPECT_NE(csv.find(",window,1,choice,answered,2,,fellow,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",window,3,number,answered,31,31,,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",window,7,scale,answered,3,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",window,8a,scale,not_applicable,,"), csv.npos) << csv;
  EXPECT_NE(csv.find(",window,8b,scale,missing,,"), csv.npos) << csv;
  EXPECT_NE(csv.find("\"Well done, and soft\""), csv.npos) << csv;
  EXPECT_EQ(csv.find("tina"), csv.npos);
}

TEST_F(TrainAnswerTest, AnswersBegunByKeysOutliveTheProgramAndAreSentOnce) {
  const std::string case_id = fixtures::draft_of_course(library_);
  const fixtures::StraightWay way = fixtures::straight_way(library_, case_id);
  library_.done("case setting " + case_id + " --title 'To be asked about' --entry-mm " + way.entry() +
                " --inr 1.1 --platelets 210 --pass 'hit >= 1'");
  library_.done("case publish " + case_id + " --by mona --own-cohort");
  const std::string form = (library_.folder() / "form.json").string();
  ASSERT_EQ(
      fixtures::run(std::string(fixtures::kProgram) + " questionnaire template workshop-2007 --out '" + form + "'",
                    library_.folder())
          .exit_code,
      0);
  library_.done("questionnaire add '" + form + "'");
  const std::string code = library_.ask("questionnaire open workshop-2007 --title 'The day' --at-desk")["code"];

  sit_down();
  ASSERT_NO_FATAL_FAILURE(person_->log_in("tina", kPassword));
  EXPECT_FALSE(person_->shows("Questionnaire: The day")) << "not before an attempt";
  ASSERT_NO_FATAL_FAILURE(person_->open_first_case());
  ASSERT_NO_FATAL_FAILURE(person_->enter_room());
  person_->press("F9");
  ASSERT_TRUE(person_->reaches("debrief")) << person_->now();
  person_->keep_picture();
  person_->press("q");
  ASSERT_TRUE(person_->reaches("answer")) << person_->now();

  // By keys: one of the choices; a number that does not fit is told and mended.
  ASSERT_NO_FATAL_FAILURE(tick("1: fellow"));
  ASSERT_NO_FATAL_FAILURE(go_to("3"));
  person_->screen().type("200");
  ASSERT_NO_FATAL_FAILURE(go_to("Next"));
  person_->press("Return");
  ASSERT_TRUE(fixtures::until([&] { return person_->shows("3: problem"); })) << person_->now();
  person_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(go_to("3", "shift+Tab"));
  person_->press("ctrl+a");
  person_->screen().type("31");
  ASSERT_TRUE(fixtures::until([&] { return !person_->shows("3: problem"); })) << person_->now();
  ASSERT_TRUE(person_->passes(1.5));
  person_->program().signal(SIGKILL);
  ASSERT_TRUE(fixtures::until([&] { return person_->program().ended(); }));

  // By mouse, from the list of cases: what was typed is there.
  sit_down();
  ASSERT_NO_FATAL_FAILURE(person_->log_in("tina", kPassword));
  person_->click("Questionnaire: The day");
  ASSERT_TRUE(person_->reaches("answer")) << person_->now();
  person_->keep_picture();
  for (int i = 0; i < 12 && !person_->shows("Send"); ++i) {
    if (person_->shows("7: 3")) {
      person_->click("7: 3");
      person_->keep_picture();
    }
    if (person_->shows("8a: n/a")) person_->click("8a: n/a");
    if (person_->shows("9")) {
      ASSERT_NO_FATAL_FAILURE(go_to("9"));
      person_->screen().type("Well done, and soft");
      ASSERT_TRUE(person_->passes(0.5));
      person_->keep_picture();
    }
    person_->click("Next");
    ASSERT_TRUE(person_->passes(0.5));
  }
  ASSERT_TRUE(person_->shows("Send")) << person_->now();
  person_->keep_picture();
  person_->click("Send");
  ASSERT_TRUE(person_->reaches("choose")) << person_->now();
  ASSERT_TRUE(person_->passes(0.5));
  EXPECT_FALSE(person_->shows("Questionnaire: The day")) << "once";

  const std::string out = (library_.folder() / "answers.csv").string();
  library_.done("questionnaire export " + code + " --out '" + out + "'");
  expect_answers(fixtures::whole_file(out));
}

}  // namespace
}  // namespace seldinger
