// Makes docs/gallery: pictures of the workstation as a trainee sees it, by somebody at its mouse and keys. Run by
// hand (`gallery` is a target of the build, no test): gallery PROGRAM FOLDER [OPTION …], these for the window, as
// --width 800 --height 600.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/fixtures/process.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

std::string program, folder;
std::vector<std::string> options;  // of the window
constexpr const char* kPassword = "a password";

class Gallery : public testing::Test {
 protected:
  // A library with the demo's case by this guidance, and a mentor who may try it as it is.
  std::string library(const std::string& modality) {
    const fs::path scratch = fixtures::fresh_folder("gallery_" + modality);
    scratch_ = scratch;
    std::string made = (scratch / "library").string();
    EXPECT_EQ(fixtures::run(program + " demo --no-serve --modality " + modality + " --library " + made, scratch)
                  .exit_code,
              0);
    EXPECT_EQ(fixtures::run(std::string("printf '") + kPassword + "\\n' | " + program +
                                " user add mona --role mentor --library " + made,
                            scratch)
                  .exit_code,
              0);
    return made;
  }
  std::vector<std::string> with(std::vector<std::string> own) const {
    own.insert(own.end(), options.begin(), options.end());
    return own;
  }
  static void keep(fixtures::Trainee& trainee, const std::string& name) {
    fs::copy_file(trainee.keep_picture(), fs::path(folder) / (name + ".png"), fs::copy_options::overwrite_existing);
  }
  fs::path scratch_;
};

TEST_F(Gallery, Ultrasound) {
  const std::string made = library("ultrasound");
  fixtures::Trainee trainee(program, made, scratch_, with({"--mute"}));
  keep(trainee, "log-in");
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_TRUE(fixtures::until([&] { return trainee.shows("Axial"); })) << "the planning CT is prepared";
  keep(trainee, "briefing");
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  trainee.prepare();
  ASSERT_NO_FATAL_FAILURE(trainee.press_probe_on());
  ASSERT_NO_FATAL_FAILURE(trainee.take("needle"));
  trainee.press("g");  // into its guide: in the picture's plane
  ASSERT_NO_FATAL_FAILURE(trainee.push_needle_to(55.0));
  keep(trainee, "ultrasound");
  trainee.press("Return");
  keep(trainee, "room");
  trainee.press("Return");
  trainee.press("F11");
  keep(trainee, "stereo");
  trainee.press("F11");
  ASSERT_NO_FATAL_FAILURE(trainee.fire());
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
  keep(trainee, "debrief");
}

TEST_F(Gallery, Devices) {
  const std::string made = library("mpr");
  fixtures::Trainee trainee(program, made, scratch_, with({"--device", "virtual"}));
  trainee.press("F10");
  ASSERT_TRUE(trainee.reaches("devices", 10.0));
  trainee.press("t");
  const auto asks = [&](const char* words) {
    return trainee.now().value("asks", std::string()).find(words) != std::string::npos;
  };
  ASSERT_TRUE(fixtures::until([&] { return asks("as far as it goes"); }, 20.0));
  for (int more = 0; more < 8 && asks("as far as it goes"); ++more)
    for (const char* key : {"Right", "Down", "Prior"}) trainee.screen().hold(key, 0.7);
  ASSERT_TRUE(fixtures::until([&] { return asks("push 5 of 6"); }, 30.0)) << trainee.now();
  keep(trainee, "devices");
}

TEST_F(Gallery, Fluoroscopy) {
  const std::string made = library("xray");
  fixtures::Trainee trainee(program, made, scratch_, with({}));
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  trainee.prepare();
  ASSERT_NO_FATAL_FAILURE(trainee.push_needle_to(25.0));
  trainee.screen().hold("p", 2.0);
  keep(trainee, "fluoroscopy");
}

// What a mentor has placed on a draft that can still be changed.
TEST_F(Gallery, CaseEditor) {
  const std::string made = library("ultrasound");
  const auto ask = [&](const std::string& words) {
    const auto ran = fixtures::run(program + " " + words + " --library " + made, scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return ran.out;
  };
  const std::string demo = Json::parse(ask("case list --json"))["cases"][0]["case_id"];
  const std::string draft = Json::parse(ask("case version " + demo + " --by mona --json"))["case_id"];
  ask("case structure " + draft +
      " --name vein --rule critical --tissue vessel --tube -70,-10,-30 --tube -80,0,0 --tube -75,10,30 --radius-mm "
      "4");
  ask("case setting " + draft + " --title 'Liver, intercostal' --entry-mm -167.4,8.9,-15 --pass 'hit >= 1'");
  fixtures::Trainee trainee(program, made, scratch_, with({}));
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  trainee.click("Open draft#2");  // the first is the demo's own, which attempts have frozen
  ASSERT_TRUE(trainee.reaches("editor", 20.0));
  ASSERT_TRUE(fixtures::until(
      [&] {
        const Json editor = trainee.now().value("editor", Json::object());
        return editor.contains("checking") && !editor["checking"].get<bool>() && !editor["holding"].empty();
      },
      60.0));
  trainee.press("e");
  trainee.place_of("room");  // it is made
  keep(trainee, "case-editor");
  trainee.press("p");
  trainee.place_of("what it costs");
  trainee.place_of("room#2");
  keep(trainee, "preparation");
}

}  // namespace
}  // namespace seldinger

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  if (count < 3) {
    std::fputs("usage: gallery PROGRAM FOLDER [OPTION …]\n", stderr);
    return 2;
  }
  seldinger::program = words[1];
  seldinger::folder = words[2];
  seldinger::options.assign(words + 3, words + count);
  std::filesystem::create_directories(seldinger::folder);
  return RUN_ALL_TESTS();
}
