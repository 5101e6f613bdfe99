// A person's attempts without a window, with every thread that takes part: servo, pictures' truth, monitor, writer,
// devices, and the window's own, which tells, says, turns knobs and looks. Built by the preset `thread`, where a
// race fails it; `./run test --long` runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <thread>

#include "app/device_simulation/haply_simulation.h"
#include "app/window/sound/speaker.h"
#include "app/window/trainer/trainer.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/until.h"
#include "tests/race/ball_library.h"

namespace seldinger::app {
namespace {

using Phase = PersonAttempt::Phase;
constexpr double kFrameS = 0.02;
constexpr double kAttemptS = 6.0;

// Asked as often as a window draws.
bool until(const std::function<bool()>& holds) {
  return fixtures::until(holds, 120.0, kFrameS);
}

class PersonAttemptRace : public testing::Test {
 protected:
  std::filesystem::path folder_ = fixtures::fresh_test_folder("race") / "library";

  bool looks_until(Trainer& trainer, const std::function<bool()>& holds) {
    return until([&] {
      trainer.look();
      return holds();
    });
  }
  bool ready(Trainer& trainer) {
    return looks_until(trainer,
                       [&] { return trainer.attempt() != nullptr && trainer.attempt()->phase() == Phase::ready; });
  }

  // Frame after frame, all that a window does with an attempt.
  void frames(Trainer& trainer, Speaker& speaker, double attempt_s, bool fires) {
    PersonAttempt& attempt = *trainer.attempt();
    HandsTold told;
    Seen seen;
    session::ShownPicture shown;
    int frame = 0;
    EXPECT_TRUE(looks_until(trainer, [&] {
      ++frame;
      if (const auto newest = attempt.seen()) {
        speaker.play(sounds_of(seen, *newest, cases::InstrumentKind::core));
        seen = *newest;
      }
      attempt.monitor().take(shown);
      if (frame % 10 == 0)
        attempt.monitor().set_console([](imaging::Console& console) { console.set_gain_db(3.0); });
      if (frame == 3) attempt.say(cases::EventKind::proceed);
      if (frame == 5) attempt.say(cases::EventKind::anaesthetic);
      if (frame == 30) attempt.say(cases::EventKind::cough);
      if (frame == 20) attempt.pause(true);
      if (frame == 25) attempt.pause(false);
      told.sum.advance_mm += 0.4;
      told.sum.swaps = static_cast<std::uint32_t>(frame / 40);
      told.fluoroscope.pedal = frame % 50 < 25;
      told.fluoroscope.lao_speed = frame % 60 < 30 ? 1.0 : -1.0;
      told.sum.freezes = static_cast<std::uint32_t>(frame / 50);
      if (fires && seen.moment.state.t_s > 0.6 * attempt_s) told.sum.fire = true;
      told.between_s = 0.02;
      told.told_s = session::clock_s();
      attempt.tell(told);
      return seen.moment.state.t_s >= attempt_s || attempt.phase() != Phase::running;
    }));
  }

  // Begun, begun again, finished, graded, watched.
  void whole_round(cases::Modality modality, std::optional<Arms> arms = std::nullopt) {
    const std::string case_id = fixtures::make_ball_library(folder_, {modality}).front();
    Speaker::Settings settings;
    settings.muted = true;
    Speaker speaker(settings);
    Trainer trainer(std::move(casedb::Library::open(folder_).value()), std::move(arms));
    trainer.log_in("mona", fixtures::kBallPassword);
    trainer.choose(case_id);
    ASSERT_EQ(trainer.screen(), TrainerScreen::briefing) << trainer.refusal();
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
    ASSERT_TRUE(trainer.begin(false));
    frames(trainer, speaker, 1.0, false);
    trainer.again();
    ASSERT_TRUE(ready(trainer)) << trainer.refusal();
    ASSERT_TRUE(trainer.begin(false));
    frames(trainer, speaker, kAttemptS, true);
    trainer.attempt()->end();
    ASSERT_TRUE(looks_until(trainer, [&] { return trainer.screen() == TrainerScreen::debrief; }))
        << trainer.refusal();
    trainer.watch(trainer.debrief()->attempt.attempt_id);
    session::WatchedAttempt& watched = *trainer.watched();
    watched.set_speed(4.0);
    session::ShownPicture shown;
    EXPECT_TRUE(until([&] {
      if (watched.phase() == session::WatchedAttempt::Phase::preparing) return false;
      static_cast<void>(watched.moment());
      watched.monitor().take(shown);
      return watched.phase() == session::WatchedAttempt::Phase::over;
    }));
    trainer.stop_watching();
    trainer.look();
    trainer.back();
  }
};

TEST_F(PersonAttemptRace, ByUltrasound) {
  whole_round(cases::Modality::ultrasound);
}

TEST_F(PersonAttemptRace, ByFluoroscopy) {
  whole_round(cases::Modality::xray);
}

TEST_F(PersonAttemptRace, WithTwoArmsThatAreLostAndComeBack) {
  auto service = HaplySimulation::start({.port = 0}, circling_arms());
  ASSERT_TRUE(service) << service.error().text;
  Arms arms;
  arms.place.port = (*service)->port();
  std::thread trouble([&] {
    for (int i = 0; i < 8; ++i) {
      fixtures::let_pass(0.7);  // troubles come apart in time, at whatever the threads are doing
      (*service)->set({.silent = i % 2 == 0, .delay_s = i % 3 == 0 ? 0.004 : 0.0});
      if (i == 5) (*service)->hang_up();
    }
    (*service)->set({});
  });
  whole_round(cases::Modality::mpr, arms);
  trouble.join();
}

}  // namespace
}  // namespace seldinger::app
