// The guidance's console in the trainer's window, by keys: what is turned changes the picture and stands in the
// stored attempt; a new attempt's knobs stand where its console does; the pedal makes pulses that cost dose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/people/people.h"
#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

class TrainConsoleTest : public testing::Test {
 protected:
  // The demo's case by this guidance, and a mentor who may try it as it is.
  void begin(const std::string& modality) {
    library_ = fixtures::library_to_try("train_console_" + modality, modality);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), library_->folder(),
                                                   fixtures::in_small_window());
    ASSERT_NO_FATAL_FAILURE(trainee_->log_in("mona", kPassword));
    ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
    ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
  }
  Json now() const { return trainee_->now(); }
  void press(const std::string& key, int times = 1) {
    for (int i = 0; i < times; ++i) trainee_->press(key);
  }
  // By key: the guidance's picture alone.
  fixtures::RgbPicture guidance() {
    const auto file = library_->folder() / ("guidance-" + std::to_string(++guidances_) + ".png");
    press("t");
    EXPECT_TRUE(
        fixtures::until([&] { return std::filesystem::exists(file) && std::filesystem::file_size(file) > 1000; }));
    return fixtures::read_png(file);
  }
  // What the only person's newest attempt recorded, once it is stored.
  void stored(Json& shown, cases::Recording& recording) {
    const std::string id = library_->persons_attempt();
    ASSERT_FALSE(id.empty());
    shown = library_->ask("attempt show " + id);
    EXPECT_EQ(library_->ask("replay " + id + " --verify")["verified"], true);
    auto library = casedb::Library::open(library_->path());
    ASSERT_TRUE(library.has_value());
    auto loaded = casedb::load_recording(*library, id);
    ASSERT_TRUE(loaded.has_value());
    recording = std::move(*loaded);
  }

  std::optional<fixtures::CommandLibrary> library_;
  std::unique_ptr<fixtures::Trainee> trainee_;
  int guidances_ = 0;
};

// Share of a part of the window that looks another way.
double changed(const fixtures::RgbPicture& one, const fixtures::RgbPicture& other, const fixtures::Place& part) {
  const auto [left, top] = part.at(0.0, 0.0);
  const auto [right, bottom] = part.at(1.0, 1.0);
  int count = 0;
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column)
      if (std::abs(one.at(column, row)[0] - other.at(column, row)[0]) > 12) ++count;
  return count / static_cast<double>((right - left) * (bottom - top));
}

double mean(const fixtures::RgbPicture& picture) {
  return std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0.0) / static_cast<double>(picture.rgb.size());
}

TEST_F(TrainConsoleTest, DepthAndFrequencyAreTheTraineesAndStandInTheAttempt) {
  ASSERT_NO_FATAL_FAILURE(begin("ultrasound"));
  trainee_->prepare();
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  const double own_mm = now().value("depth_mm", 0.0);
  ASSERT_GT(own_mm, 10.0);
  const auto before = guidance();
  press("Down", 4);
  ASSERT_TRUE(fixtures::until([&] { return now().value("depth_mm", 0.0) > own_mm + 15.0; })) << now();
  const auto deep = guidance();
  EXPECT_NE(deep.rgb, before.rgb);
  press("bracketright");
  press("comma", 2);
  ASSERT_TRUE(fixtures::until(  // 3.57, to 3.5, to 3
      [&] { return now().value("focus_mm", 0.0) > 0.0 && now().value("frequency_mhz", 9.0) == 3.0; }))
      << now();
  const auto grey = guidance();
  press("v");
  ASSERT_TRUE(fixtures::until([&] { return now().value("colour_mm_s", 0.0) == 200.0; })) << now();
  const auto is_coloured = [](const fixtures::RgbPicture& picture) {  // the bar's end that comes towards the probe
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3)
      if (picture.rgb[i] > 240 && picture.rgb[i + 1] > 200 && picture.rgb[i + 2] < 20) return true;
    return false;
  };
  EXPECT_FALSE(is_coloured(grey));
  EXPECT_TRUE(is_coloured(guidance()));
  // Dragged over the picture colour's box goes along, to the side and down.
  const auto picture = trainee_->place_of("depth below the face");
  const auto drag_to = [&](double across, double down) {
    const auto [from_x, from_y] = picture.at(0.5, 0.5);
    const auto [x, y] = picture.at(across, down);
    trainee_->screen().drag(from_x, from_y, x, y, 1, 0.3);
  };
  drag_to(0.45, 0.3);
  drag_to(0.6, 0.7);
  press("z");
  ASSERT_TRUE(fixtures::until([&] { return now().value("compound_deg", 0.0) == 12.0; })) << now();
  const Json last = now();
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  Json shown;
  cases::Recording recording;
  ASSERT_NO_FATAL_FAILURE(stored(shown, recording));
  EXPECT_EQ(recording.inputs.front().console, cases::ConsoleSetting{}) << "as the case has it";
  const cases::ConsoleSetting& end = recording.inputs.back().console;
  EXPECT_DOUBLE_EQ(end.depth_mm, last["depth_mm"].get<double>());
  EXPECT_GT(end.depth_mm, own_mm + 15.0);
  EXPECT_DOUBLE_EQ(end.focus_mm, last["focus_mm"].get<double>());
  EXPECT_DOUBLE_EQ(end.frequency_mhz, last["frequency_mhz"].get<double>());
  EXPECT_EQ(end.colour_mm_s, 200.0);
  EXPECT_EQ(end.compound_deg, 12.0);
  EXPECT_DOUBLE_EQ(end.box_across, last["box_across"].get<double>());
  EXPECT_DOUBLE_EQ(end.box_down, last["box_down"].get<double>());
  double upper = 1.0, left = 1.0;  // nearly all of the picture before it is dragged
  for (const cases::Inputs& inputs : recording.inputs)
    if (inputs.console.box_down > 0.0) {
      upper = std::min(upper, inputs.console.box_down);
      left = std::min(left, inputs.console.box_across);
    }
  EXPECT_GT(end.box_down, upper + 0.2);
  EXPECT_GT(end.box_across, left + 0.05);
}

// The knobs of the attempt before say nothing of this one's picture.
TEST_F(TrainConsoleTest, ANewAttemptsKnobsStandWhereItsConsoleDoes) {
  ASSERT_NO_FATAL_FAILURE(begin("ultrasound"));
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  const double own_mm = now().value("depth_mm", 0.0);
  const double plain = mean(guidance());
  press("0", 8);
  press("Up");
  ASSERT_TRUE(fixtures::until([&] { return now().value("gain_db", 0.0) > 15.0; })) << now();
  const double bright = mean(guidance());
  EXPECT_GT(bright, 1.3 * plain);
  ASSERT_NO_FATAL_FAILURE(trainee_->begin_again());
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  EXPECT_EQ(now().value("gain_db", -1.0), 0.0);
  EXPECT_EQ(now().value("depth_mm", -1.0), own_mm);
  EXPECT_NEAR(mean(guidance()), plain, 0.5 * (bright - plain)) << "the picture is the knobs'";
  press("0");  // one step from where it stands, not from where it stood before
  ASSERT_TRUE(fixtures::until([&] { return now().value("gain_db", 0.0) == 2.0; })) << now();
}

TEST_F(TrainConsoleTest, ThePedalMakesPulsesAndDoseInTheStoredAttempt) {
  ASSERT_NO_FATAL_FAILURE(begin("xray"));
  trainee_->prepare();
  press("g");
  EXPECT_TRUE(fixtures::until([&] {
    return trainee_->shows("No needle guide here: it is mounted on an ultrasound probe.");
  })) << now();
  const auto step_on_pedal = [&] {  // by the attempt's clock: a busy machine's lags behind
    trainee_->screen().with_key("p", [&] {
      const double from_s = now().value("attempt_s", 0.0);
      EXPECT_TRUE(fixtures::until([&] { return now().value("attempt_s", 0.0) > from_s + 1.0; })) << now();
    });
  };
  step_on_pedal();
  press("bracketleft", 4);  // both pairs of blades to 0.8
  press("h");
  step_on_pedal();
  const auto image = guidance();
  EXPECT_GT(mean(image), 5.0) << "the last image stays";
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  Json shown;
  cases::Recording recording;
  ASSERT_NO_FATAL_FAILURE(stored(shown, recording));
  std::size_t pulses = 0, open = 0, collimated = 0;
  double air_kerma_mgy = 0.0;
  for (const cases::FrameTruth& frame : recording.frames) {
    if (!frame.beam) continue;
    ++pulses;
    air_kerma_mgy += frame.beam->air_kerma_mgy;
    open += frame.beam->collimated_share == 0.0 ? 1 : 0;
    collimated += std::abs(frame.beam->collimated_share - (1.0 - 0.8 * 0.8)) < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(open, 4U) << "7.5 a second";
  EXPECT_GE(collimated, 4U);
  EXPECT_EQ(pulses, open + collimated);

  // Looking back a mentor sees inside the patient.
  press("w");
  ASSERT_TRUE(trainee_->reaches("watch")) << now();
  const auto room = trainee_->place_of("room");  // it is made, and there is a moment to draw
  press("space");
  const auto look = [&] { return fixtures::read_png(trainee_->keep_picture()); };
  auto before = look();
  for (const char* inside : {"cut away", "looked through", "whole"}) {
    press("i");
    fixtures::RgbPicture now;
    EXPECT_TRUE(fixtures::until([&] {
      now = look();
      return changed(now, before, room) > 0.05;
    })) << inside;
    before = std::move(now);
  }
  EXPECT_LE(pulses, 60U) << "and none while the pedal is up";
  EXPECT_GT(air_kerma_mgy, 0.0);
  EXPECT_NEAR(*fixtures::metric(shown, "air_kerma"), air_kerma_mgy, 1e-6 * air_kerma_mgy);
  EXPECT_NEAR(*fixtures::metric(shown, "fluoroscopy_time"), static_cast<double>(pulses) / 7.5, 0.01);
  EXPECT_TRUE(std::any_of(recording.inputs.begin(), recording.inputs.end(),
                          [](const cases::Inputs& inputs) { return inputs.fluoroscope.hand_away; }));
}

}  // namespace
}  // namespace seldinger
