// A mentor at one workstation looks in on a trainee at another, and lets the patient cough there.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using fixtures::kPassword;

TEST(TrainLookInTest, WhatAMentorLetsHappenHappensInTheTraineesRoom) {
  const fixtures::CommandLibrary library{fixtures::fresh_test_folder("train_look_in")};
  const std::string case_id = fixtures::draft_of_course(library);
  const fixtures::StraightWay way = fixtures::straight_way(library, case_id);
  library.done("case setting " + case_id + " --title 'Looked at' --entry-mm " + way.entry() +
               " --inr 1.1 --platelets 210 --pass 'hit >= 1'");
  library.done("case publish " + case_id + " --by mona --own-cohort");
  const auto sits_down = [&](const std::string& name) {
    const auto folder = library.folder() / name;
    std::filesystem::create_directories(folder);
    return std::make_unique<fixtures::Trainee>(fixtures::kProgram, library.path(), folder,
                                               fixtures::in_small_window({"--mute"}));
  };
  const auto tina = sits_down("tina");
  ASSERT_NO_FATAL_FAILURE(tina->log_in("tina", kPassword));
  const auto mona = sits_down("mona");
  ASSERT_NO_FATAL_FAILURE(mona->log_in("mona", kPassword));
  const std::string look_in = "Look in: tina, Looked at";
  EXPECT_FALSE(mona->shows(look_in)) << "nobody is in the room yet";

  ASSERT_NO_FATAL_FAILURE(tina->open_first_case());
  ASSERT_NO_FATAL_FAILURE(tina->enter_room());
  tina->prepare();
  mona->click(look_in);
  ASSERT_TRUE(mona->reaches("watch")) << mona->now();
  const std::string cough = "the patient coughs";
  EXPECT_FALSE(tina->shows(cough));
  mona->click(cough);
  EXPECT_TRUE(fixtures::until([&] { return tina->shows(cough); })) << tina->now();
  tina->keep_picture();
  mona->keep_picture();

  tina->press("F9");
  ASSERT_TRUE(tina->reaches("debrief")) << tina->now();
  EXPECT_TRUE(fixtures::until([&] { return !mona->shows(cough); })) << "the attempt is over";
}

}  // namespace
}  // namespace seldinger
