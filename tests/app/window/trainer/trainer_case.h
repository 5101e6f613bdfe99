// A workstation without its window and a case to practise on it, with hands that are told what to want.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "app/window/trainer/trainer.h"
#include "casedb/cases/versions.h"
#include "session/case/case_check.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {

using fixtures::until;
using Phase = PersonAttempt::Phase;
constexpr const char* kPassword = "a long password";

class TrainerTest : public testing::Test {
 protected:
  // A ball of soft tissue, practised by slices; its target 25 mm below the skin.
  static constexpr double kDepthMm = 25.0;
  std::filesystem::path folder_ = fixtures::fresh_test_folder("app") / "library";
  std::string case_id_;

  void SetUp() override {
    casedb::Library library = std::move(casedb::Library::open_or_create(folder_).value());
    case_id_ = casedb::add_case(library, fixtures::new_ball());
    ASSERT_TRUE(casedb::add_lesion(library, case_id_, fixtures::ball_target(kDepthMm)));
    ASSERT_TRUE(casedb::add_user(library, "mona", casedb::Role::mentor, kPassword));
    ASSERT_TRUE(casedb::add_user(library, "tina", casedb::Role::trainee, kPassword));
    fixtures::make_cohort(library, "mona", {"tina"});
  }
  void publish() {
    casedb::Library library = open();
    ASSERT_TRUE(
        casedb::publish_case(library, case_id_, session::check_case(library, case_id_).value(), "mona", true));
  }
  casedb::Library open() { return std::move(casedb::Library::open(folder_).value()); }
  bool looks_until(Trainer& trainer, TrainerScreen screen) {
    return until([&] {
      trainer.look();
      return trainer.screen() == screen;
    });
  }
  bool ready(Trainer& trainer) {
    return until([&] {
      trainer.look();
      return trainer.attempt() != nullptr && trainer.attempt()->phase() == Phase::ready;
    });
  }
  // Logged in, the case chosen, and begun as soon as it is prepared.
  void begin(Trainer& trainer, const char* name, bool left_handed) {
    trainer.log_in(name, kPassword);
    trainer.choose(case_id_);
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
    ASSERT_TRUE(trainer.begin(left_handed));
  }
  static constexpr double kTellingS = 0.02;  // from one telling of the hands to the next, as a window's frames
  // Tells the hands of one wish, and waits until they have done it.
  void advance(PersonAttempt& attempt, HandsTold& told, double to_mm) {
    Seen seen;
    const auto there = [&] {
      if (const auto newest = attempt.seen()) seen = *newest;
      const double left_mm = to_mm - seen.inserted_mm;
      if (std::abs(left_mm) < 1.0) return true;
      told.sum.advance_mm += seen.inserted ? 0.1 * left_mm : 0.5;
      told.between_s = kTellingS;
      attempt.tell(told);
      return false;
    };
    EXPECT_TRUE(until(there, fixtures::kPatienceS, kTellingS)) << seen.inserted_mm;
  }
  void fire_at_the_target(PersonAttempt& attempt) {
    HandsTold told;
    advance(attempt, told, kDepthMm);
    told.sum.fire = true;
    attempt.tell(told);
    ASSERT_TRUE(until([&] {
      const auto seen = attempt.seen();
      return seen && seen->moment.state.fire.fired;
    }));
  }
};

}  // namespace seldinger::app
