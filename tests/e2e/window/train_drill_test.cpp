// The first drill is passed by somebody who knows nothing and does what the window says: its hints, lamps and
// words, by mouse and by keys alone, in a new trainee's first attempt.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

constexpr double kMostS = 180.0;
// Of a hand, which learns how far a drag goes: a turning drag, a notch, a held key.
constexpr double kPxPerMmAtFirst = 0.35, kPxPerDegree = 4.0, kNotchesPerMm = 2.0;
constexpr double kSPerMm = 1.0 / 40.0, kSPerDegree = 1.0 / 30.0, kSPerMmOn = 1.0 / 15.0;

class TrainDrillTest : public testing::Test {
 protected:
  void sit_down(const std::string& name) {
    library_.demo("--drills");
    library_.done("user add " + name + " --role trainee");
    trainee_ = std::make_unique<fixtures::Trainee>(
        fixtures::kProgram, library_.path(), library_.folder(),
        std::vector<std::string>{"--width", "800", "--height", "600", "--mute"});
    ASSERT_FALSE(HasFailure());
  }
  void TearDown() override {
    if (!trainee_) return;
    if (HasFailure()) trainee_->keep_picture();
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
  }
  Json now() const { return trainee_->now(); }
  std::string hint() const {
    const Json items = now().value("items", Json::object());
    for (const auto& item : items.items())
      if (item.key().starts_with("Hint: ")) return item.key();
    return {};
  }
  static bool has(const std::string& words, const std::string& part) {
    return words.find(part) != std::string::npos;
  }
  // "by 12.0 mm": of the hand.
  static double amount_in(const std::string& words, const char* unit) {
    const auto end = words.find(unit, words.rfind("by "));
    return end == std::string::npos ? 0.0 : std::strtod(words.c_str() + words.rfind("by ", end) + 3, nullptr);
  }

  // One thing that a hand does.
  struct Act {
    std::string key;
    double held_s = 0.0;
    int button = 0, right_px = 0, down_px = 0;
    int notches = 0;
    bool fine = false;  // with Shift, ten times finer
    Act back() const {
      return {opposite(key), 0.5 * held_s, button, -right_px / 2, -down_px / 2, -notches / 2, fine};
    }
    static std::string opposite(const std::string& key) {
      static const std::map<std::string, std::string> other = {
          {"d", "a"}, {"a", "d"}, {"w", "s"}, {"s", "w"}, {"i", "k"},        {"k", "i"},
          {"j", "l"}, {"l", "j"}, {"o", "u"}, {"u", "o"}, {"Next", "Prior"}, {"Prior", "Next"}};
      const auto found = other.find(key);
      return found == other.end() ? key : found->second;
    }
  };
  void do_it(const Act& act) {
    const auto& [x, y] = middle_;
    const auto drag = [&] { trainee_->screen().drag(x, y, x + act.right_px, y + act.down_px, act.button, 0.1); };
    if (act.button > 0) {
      act.fine ? trainee_->screen().with_key("shift", drag) : drag();
    } else if (act.notches != 0) {
      trainee_->screen().point(x, y);
      trainee_->screen().wheel(act.notches, 300);  // those of one frame together count as a fast wheel
    } else if (act.fine) {
      trainee_->screen().with_key("shift", [&] { trainee_->screen().hold(act.key, act.held_s); });
    } else if (act.held_s > 0.0) {
      trainee_->screen().hold(act.key, act.held_s);
    } else {
      trainee_->press(act.key);
    }
    ASSERT_TRUE(trainee_->passes(0.35));
  }
  // The way that is told, to the right or down > 0; and whether it is down or up.
  static double way_in(const std::string& words) {
    const double mm = amount_in(words, " mm");
    return has(words, "to the left") || has(words, "up by") ? -mm : mm;
  }
  static bool is_upright(const std::string& words) { return has(words, "down by") || has(words, "up by"); }
  // What is left after a drag tells how far it went.
  void learn(const std::string& before, const Act& act, const std::string& after) {
    const bool drag = has(before, "(drag") && has(after, "(drag") && act.button == 1;
    if (!drag || act.fine || is_upright(before) != is_upright(after)) return;
    const double gone_mm = std::abs(way_in(before) - way_in(after)), px = std::abs(act.right_px + act.down_px);
    if (gone_mm > 2.0) px_per_mm_ = std::clamp(px / gone_mm, 0.1, 10.0);
  }
  Act drag_of(const std::string& words) const {
    Act act;
    const bool turns = has(words, "right drag") || has(words, "middle drag");
    act.button = has(words, "middle drag") ? 2 : has(words, "right drag") ? 3 : 1;
    const double px =
        std::min(150.0, turns ? kPxPerDegree * amount_in(words, "°") : px_per_mm_ * amount_in(words, " mm"));
    act.fine = has(words, "with Shift");
    const int by_px = std::max(1, static_cast<int>(std::lround(act.fine ? 10.0 * px : px)));
    if (has(words, "to the right")) act.right_px = by_px;
    if (has(words, "to the left")) act.right_px = -by_px;
    if (has(words, "down by")) act.down_px = by_px;
    if (has(words, "up by")) act.down_px = -by_px;
    return act;
  }
  static Act key_of(const std::string& words) {
    static const std::map<std::string, std::string> keys = {{"Page Down", "Next"}, {"Page Up", "Prior"}};
    const auto from = words.rfind("or ") + 3;
    std::string told = words.substr(from, words.find_first_of(").:", from) - from);
    if (told.starts_with("by ")) told.erase(0, 3);
    Act act;
    const auto named = keys.find(told);
    act.key = named != keys.end() ? named->second : std::string(1, static_cast<char>(std::tolower(told[0])));
    const double mm = amount_in(words, " mm"), degrees = amount_in(words, "°");
    act.held_s = named != keys.end() ? kSPerMmOn * (mm > 0.0 ? 0.6 * mm : 3.0)
                 : degrees > 0.0     ? kSPerDegree * degrees
                                     : kSPerMm * mm;
    constexpr double kFineS = 0.15;  // a shorter press is told by luck
    act.fine = act.held_s < kFineS;
    if (act.fine) act.held_s *= 10.0;
    act.held_s = std::clamp(act.held_s, 0.03, 1.5);
    return act;
  }
  // What the needle or the probe is pushed by, where no way is told.
  static Act push_of(const std::string& words, bool mouse) {
    const bool out = has(words, "Page Up");
    const auto colon = words.find(": ", 6);
    const double told_mm = has(words, "Advance: ")
                               ? std::strtod(words.c_str() + words.find("Advance: ") + 9, nullptr)
                           : has(words, "mm too deep") ? std::strtod(words.c_str() + colon + 2, nullptr)
                                                       : 4.0;
    const double mm = std::clamp(told_mm, 1.0, 6.0);
    Act act;
    if (mouse)
      act.notches = static_cast<int>(std::lround(kNotchesPerMm * mm)) * (out ? -1 : 1);
    else
      act = {out ? "Prior" : "Next", kSPerMmOn * mm};
    return act;
  }
  // To and fro in all four ways, farther each time round.
  Act search(int step, bool mouse) const {
    struct Leg {
      int across, down, steps;
    };
    static constexpr std::array<Leg, 6> kLegs = {
        {{0, -1, 4}, {0, 1, 8}, {0, -1, 4}, {1, 0, 4}, {-1, 0, 8}, {1, 0, 4}}};
    double step_mm = 7.0;
    for (std::size_t i = 0;; i = (i + 1) % kLegs.size()) {
      const Leg& leg = kLegs[i];
      if (step >= leg.steps) {
        step -= leg.steps;
        if (i + 1 == kLegs.size()) step_mm *= 1.5;
        continue;
      }
      const int px = std::max(1, static_cast<int>(std::lround(step_mm * px_per_mm_)));
      if (mouse) return {"", 0.0, 1, leg.across * px, leg.down * px};
      return {leg.across > 0 ? "d" : leg.across < 0 ? "a" : leg.down > 0 ? "s" : "w", kSPerMm * step_mm};
    }
  }

  // Tab by Tab to what is named so, and Enter.
  void press_at(const std::string& name) {
    const auto there = [&] { return now().value("focus", "").starts_with(name); };
    for (int i = 0; i < 30 && !there(); ++i) {
      const std::string before = now().value("focus", "");
      trainee_->press("Tab");
      fixtures::until([&] { return now().value("focus", "") != before; }, 1.5);
    }
    ASSERT_TRUE(there()) << now();
    trainee_->press("Return");
  }
  void follow(bool mouse) {
    int searched = 0;
    std::optional<Act> last;  // by which the target may have been lost
    std::string before;
    Act done;
    while (now().value("screen", "") == "attempt") {
      const std::string words = hint();
      const double at_s = now().value("attempt_s", 0.0);
      ASSERT_LT(at_s, kMostS) << words;
      std::printf("[ %6.1f s  ] %s\n", at_s, words.c_str());
      learn(before, done, words);
      Act act;
      if (has(words, "(Tab)")) {
        act.key = "Tab";
      } else if (has(words, "(Space)")) {
        act.key = "space";
      } else if (has(words, "(F9)")) {
        trainee_->press("F9");
        ASSERT_TRUE(trainee_->reaches("debrief")) << now();
        break;
      } else if (has(words, "Look for the target")) {
        act = last ? last->back() : search(searched++, mouse);
      } else if (has(words, "(wheel, or Page") && amount_in(words, " mm") > 0.0 && mouse) {
        act.notches = std::clamp(static_cast<int>(amount_in(words, " mm") / 3.0), 1, 3);
      } else if (has(words, "from above (4)") && (mouse || !has(words, "or by"))) {
        act.key = "4";
      } else if (has(words, "drag") || has(words, "move it") || has(words, "or by")) {
        act = mouse ? drag_of(words) : key_of(words);
      } else if (has(words, "heel")) {
        act = push_of(words, mouse);
      } else {
        ASSERT_TRUE(trainee_->passes(0.3));
        continue;
      }
      last = has(words, "The target is") || has(words, "plane misses") ? std::optional(act) : std::nullopt;
      ASSERT_NO_FATAL_FAILURE(do_it(act));
      before = words;
      done = act;
    }
  }
  void expect_passed() {
    EXPECT_TRUE(trainee_->shows("What is missing")) << now();
    const Json shown = library_.ask("attempt show " + library_.persons_attempt());
    EXPECT_EQ(shown["grade"]["verdict"], "passed") << shown["grade"];
    EXPECT_EQ(shown["conditions"]["help_level"], 2) << "the hints are noted";
    std::printf("[ drill      ] passed after %.0f s\n", shown["duration_s"].get<double>());
  }

  fixtures::CommandLibrary library_{fixtures::fresh_test_folder("train_drill")};
  std::unique_ptr<fixtures::Trainee> trainee_;
  std::pair<int, int> middle_;
  double px_per_mm_ = kPxPerMmAtFirst;
};

TEST_F(TrainDrillTest, IsPassedByAMouseThatDoesWhatTheWindowSays) {
  ASSERT_NO_FATAL_FAILURE(sit_down("tom"));
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tom", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  trainee_->click("Enter the room (Enter)");
  ASSERT_TRUE(trainee_->reaches("attempt")) << now();
  middle_ = trainee_->place_of("room").at(0.5, 0.5);
  trainee_->point_at_room();
  ASSERT_NO_FATAL_FAILURE(follow(true));
  expect_passed();
}

TEST_F(TrainDrillTest, IsPassedByKeysAlone) {
  ASSERT_NO_FATAL_FAILURE(sit_down("tess"));
  ASSERT_TRUE(fixtures::until([&] { return now().value("focus", "") == "Name"; }));
  trainee_->screen().type("tess");
  trainee_->press("Tab");
  trainee_->screen().type(kPassword);
  trainee_->press("Return");
  ASSERT_TRUE(trainee_->reaches("choose")) << now();
  ASSERT_NO_FATAL_FAILURE(press_at("Practise: Drill 1"));
  ASSERT_TRUE(trainee_->reaches("ready", 2.0 * fixtures::kPatienceS)) << now();
  ASSERT_NO_FATAL_FAILURE(press_at("Enter the room (Enter)"));
  ASSERT_TRUE(trainee_->reaches("attempt")) << now();
  ASSERT_NO_FATAL_FAILURE(follow(false));
  expect_passed();
}

}  // namespace
}  // namespace seldinger
