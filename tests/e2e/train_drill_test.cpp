// The first drill, passed by somebody who knows nothing and follows only what the window says: its lamps, its hints
// and what it shows of the needle; by mouse, and by keys alone. Each within three minutes of the attempt's time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

constexpr double kMostSeconds = 180.0;
constexpr const char* kDigits = "0123456789";

// A movement of hands that can be taken back: by a size, of which a negative one goes the other way.
using Move = std::function<void(double size)>;

// What one does with probe or needle, by mouse or by keys.
struct Hands {
  std::vector<Move> slide, turn;
  Move along;                            // the needle
  std::function<void()> press_on, push;  // a little
};

class TrainDrillTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    library_.emplace(fixtures::fresh_folder("train_drill"));
    library_->done("demo --drills");
  }

  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    by_mouse_ = test == "ByMouse";
    name_ = by_mouse_ ? "mia" : "kim";
    library_->done("user add " + name_ + " --role trainee");
    folder_ = library_->folder() / test;
    std::filesystem::create_directories(folder_);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), folder_,
                                                   std::vector<std::string>{"--mute"});
  }
  void TearDown() override {
    if (!trainee_) return;
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
  }

  const fixtures::Screen& screen() const { return trainee_->screen(); }
  // The hint that the window gives now; empty: none.
  std::string hint() const {
    const Json items = trainee_->now().value("items", Json::object());
    for (const auto& item : items.items())
      if (item.key().starts_with("Hint: ")) return item.key().substr(6);
    return {};
  }
  // Once hands have come to rest and the window has told of it.
  std::string hint_then() {
    trainee_->passes(0.55);
    return hint();
  }
  static bool has(const std::string& words, const char* part) { return words.find(part) != std::string::npos; }
  // What is to become less: its number; where there are two, the first counts more, for what is lost from the
  // picture has to be looked for again.
  static double number_of(const std::string& words) {
    std::vector<double> numbers;
    for (auto at = words.find_first_of(kDigits); at != std::string::npos; at = words.find_first_of(kDigits, at)) {
      char* end = nullptr;
      numbers.push_back(std::strtod(words.c_str() + at, &end));
      at = static_cast<std::size_t>(end - words.c_str());
    }
    if (numbers.empty()) return 0.0;
    return numbers.size() == 1 ? numbers[0] : std::max(2.5 * numbers[0], numbers[1]);
  }
  void take(const std::string& tool) {
    if (by_mouse_) return trainee_->take(tool);
    if (trainee_->now().value("held", "") != tool) screen().press("Tab");
    ASSERT_TRUE(fixtures::until([&] { return trainee_->now().value("held", "") == tool; })) << trainee_->now();
  }
  double attempt_s() const { return trainee_->now().value("attempt_s", 0.0); }
  bool in_time() const { return attempt_s() < kMostSeconds && !testing::Test::HasFatalFailure(); }

  // While the hint begins so: whatever makes its number less is done again, else something else is tried, smaller
  // with each round.
  void bring_down(const char* begins, const std::vector<Move>& moves, double size) {
    std::string words = hint_then();
    for (double step = size; has(words, begins) && in_time(); step *= 0.6) {
      for (const Move& move : moves)
        for (const double way : {1.0, -1.0}) {
          bool better = true;
          while (better && has(words, begins) && in_time()) {
            const double before = number_of(words);
            move(way * step);
            const std::string then = hint_then();
            better = !has(then, "Look for") && (!has(then, begins) || number_of(then) < before - 0.05);
            if (better)
              words = then;
            else
              move(-way * step);
          }
          if (!better) words = hint_then();
        }
      if (step < 0.05 * size) step = size;
    }
  }

  // The probe, to and fro in ever wider turns, until the lamp is lit.
  void look_for_target(const Hands& hands) {
    int turns = 0;
    for (double size = 1.0; has(hint_then(), "Look for the target") && in_time(); ++turns) {
      const Move& along = hands.slide[static_cast<std::size_t>((turns + 1) % 2)];
      const double way = turns % 4 < 2 ? 1.0 : -1.0;
      const int steps = 1 + turns / 2;
      for (int i = 0; i < steps && has(hint_then(), "Look for the target"); ++i) along(way * size);
    }
  }

  void do_drill(const Hands& hands) {
    while (has(hint_then(), "Press the probe on") && in_time()) {
      ASSERT_NO_FATAL_FAILURE(take("probe"));
      hands.press_on();
    }
    std::vector<Move> all = hands.slide;
    all.insert(all.end(), hands.turn.rbegin(), hands.turn.rend());
    for (int round = 0; round < 9 && in_time() && !has(hint(), "is aimed"); ++round) {
      if (has(hint_then(), "Look for the target") || has(hint(), "The probe is") || has(hint(), "misses the ")) {
        ASSERT_NO_FATAL_FAILURE(take("probe"));
      }
      bring_down("The probe is", hands.slide, 2.0);
      look_for_target(hands);
      bring_down("misses the target’s middle", all, 0.6);
      if (!has(hint_then(), "tip is") && !has(hint(), "The needle points")) continue;
      ASSERT_NO_FATAL_FAILURE(take("needle"));
      bring_down("from the green entry", hands.slide, 1.0);
      bring_down("The needle points", hands.turn, 1.0);
    }
    trainee_->keep_picture();
    EXPECT_TRUE(has(hint(), "is aimed")) << hint() << " after " << attempt_s() << " s";
    ASSERT_NO_FATAL_FAILURE(take("needle"));
    for (std::string words = hint_then(); in_time() && !has(words, "say so (Space)"); words = hint_then()) {
      if (has(words, "draw back") || has(words, "Draw back")) {
        hands.along(-0.5);
        continue;
      }
      if (has(words, "The needle points")) bring_down("The needle points", hands.turn, 0.3);
      if (has(words, "Stop: ")) {
        ASSERT_NO_FATAL_FAILURE(take("probe"));
        bring_down("Stop: ", all, 0.4);
        ASSERT_NO_FATAL_FAILURE(take("needle"));
        continue;
      }
      hands.push();
    }
    trainee_->keep_picture();
    EXPECT_TRUE(has(hint(), "say so (Space)")) << hint() << " after " << attempt_s() << " s";
    ASSERT_NO_FATAL_FAILURE(trainee_->fire());
    const double needed_s = attempt_s();
    EXPECT_LT(needed_s, kMostSeconds);
    std::printf("[ drill      ] said to be there after %.0f s\n", needed_s);
    ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
    trainee_->keep_picture();
    EXPECT_TRUE(trainee_->shows("Next: once more (Enter)")) << "not passed: " << trainee_->now();
  }

  static inline std::optional<fixtures::CommandLibrary> library_;
  std::string name_;
  bool by_mouse_ = false;
  std::filesystem::path folder_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

TEST_F(TrainDrillTest, ByMouse) {
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in(name_, kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  trainee_->click("Enter the room (Enter)");
  ASSERT_TRUE(trainee_->reaches("attempt"));
  ASSERT_TRUE(fixtures::until([&] { return attempt_s() > 0.5; }));
  const auto drag = [this](int button, double right_px, double down_px) {
    const auto [x, y] = trainee_->place_of("room").at(0.5, 0.5);
    screen().drag(x, y, x + static_cast<int>(std::lround(right_px)), y + static_cast<int>(std::lround(down_px)),
                  button, 0.1);
  };
  Hands hands;
  hands.slide = {[&](double size) { drag(1, 6.0 * size, 0.0); }, [&](double size) { drag(1, 0.0, 6.0 * size); }};
  hands.turn = {[&](double size) { drag(2, 0.0, 30.0 * size); }, [&](double size) { drag(2, 30.0 * size, 0.0); },
                [&](double size) { drag(3, 24.0 * size, 0.0); }};
  hands.along = [&](double size) {
    const int notches = static_cast<int>(std::lround(6.0 * size));
    if (notches != 0) screen().wheel(notches, 40);
  };
  hands.press_on = [&] { screen().wheel(3, 40); };
  hands.push = [&] { screen().wheel(4, 60); };
  do_drill(hands);
}

TEST_F(TrainDrillTest, ByKeysAlone) {
  screen().type(name_);
  screen().press("Tab");
  screen().type(kPassword);
  screen().press("Return");
  ASSERT_TRUE(trainee_->reaches("choose")) << trainee_->now();
  screen().press("Return");
  ASSERT_TRUE(trainee_->reaches("ready", 2.0 * fixtures::kPatienceS)) << trainee_->now();
  screen().press("Return");
  ASSERT_TRUE(trainee_->reaches("attempt"));
  ASSERT_TRUE(fixtures::until([&] { return attempt_s() > 0.5; }));
  const auto keys = [this](const char* more, const char* less) {
    return [this, more, less](double size) { screen().hold(size > 0.0 ? more : less, 0.25 * std::abs(size)); };
  };
  Hands hands;
  hands.slide = {keys("d", "a"), keys("w", "s"), keys("e", "q")};
  hands.turn = {keys("i", "k"), keys("l", "j"), keys("o", "u")};
  hands.along = keys("Next", "Prior");
  hands.press_on = [&] { screen().hold("Next", 0.3); };
  hands.push = [&] { screen().hold("Next", 0.3); };
  do_drill(hands);
}

}  // namespace
}  // namespace seldinger
