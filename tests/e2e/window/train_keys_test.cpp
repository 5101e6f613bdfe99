// The window without a mouse: log-in, list, briefing, room, debrief and case editor are worked by keys alone, and
// the text mirror tells what stands on each screen and what the keyboard is on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "casedb/export/dicom_series.h"
#include "sim/volume/phantom.h"
#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

class TrainKeysTest : public testing::Test {
 protected:
  void SetUp() override { case_id_ = fixtures::draft_of_course(library_); }
  void sit_down() {
    words_ = library_.folder() / "words.txt";
    person_ =
        std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_.path(), library_.folder(),
                                            fixtures::in_small_window({"--words", words_.string(), "--mute"}));
    ASSERT_FALSE(HasFailure());
  }
  void press(const std::string& key) const { person_->press(key); }
  std::string focus() const { return person_->now().value("focus", ""); }
  bool focuses(const std::string& name) const {
    return fixtures::until([&] { return focus() == name; });
  }
  // Tab by Tab; what it passes is told where it never comes.
  void go_to(const std::string& name, const std::string& key = "Tab") const {
    constexpr int kMostStops = 80;
    std::string passed = focus();
    for (int i = 0; i < kMostStops && focus() != name; ++i) {
      const std::string before = focus();
      press(key);
      // A slow window has not moved yet; from one item without a name to the next nothing is seen.
      if (!fixtures::until([&] { return focus() != before; }, 1.5)) {
        ASSERT_TRUE(person_->passes(0.3));
      }
      passed += ", " + focus();
    }
    ASSERT_EQ(focus(), name) << passed;
  }
  void press_at(const std::string& name) const {
    ASSERT_NO_FATAL_FAILURE(go_to(name));
    press("Return");
  }
  std::string words() const { return fixtures::whole_file(words_); }
  bool says(const std::string& line) const {
    return fixtures::until([&] { return words().find(line) != std::string::npos; });
  }

  // The password's field is left by Escape and entered again, and what is typed stays in it.
  void log_in(const std::string& name) const {
    ASSERT_TRUE(focuses("Name"));
    person_->screen().type(name);
    press("Escape");
    ASSERT_TRUE(person_->passes(1.0));
    ASSERT_EQ(focus(), "Name") << "it was not lost";
    for (int i = 0; i < 6; ++i) press("BackSpace");
    person_->screen().type(name);
    press("Tab");
    ASSERT_TRUE(focuses("Password"));
    person_->screen().type("a pass");
    press("Escape");
    ASSERT_TRUE(person_->passes(1.0));
    ASSERT_EQ(focus(), "Password");
    press("ctrl+a");
    person_->screen().type(kPassword);
    press("Return");
    ASSERT_TRUE(person_->reaches("choose")) << person_->now();
  }

  fixtures::CommandLibrary library_{fixtures::fresh_test_folder("train_keys")};
  std::string case_id_;
  std::filesystem::path words_;
  std::unique_ptr<fixtures::Trainee> person_;
};

TEST_F(TrainKeysTest, ATraineeNeedsNoMouse) {
  const fixtures::StraightWay way = fixtures::straight_way(library_, case_id_);
  library_.done("case setting " + case_id_ + " --title 'By keys' --entry-mm " + way.entry() +
                " --inr 1.1 --platelets 210 --pass 'hit >= 1'");
  library_.done("case publish " + case_id_ + " --by mona --own-cohort");
  sit_down();
  ASSERT_NO_FATAL_FAILURE(log_in("tina"));
  ASSERT_TRUE(says("| By keys |"));
  ASSERT_TRUE(focuses("Practise: By keys")) << "what is next, not what stands first: " << focus();
  press("Return");
  ASSERT_TRUE(person_->reaches("ready")) << person_->now();
  for (const char* item : {"Identity", "Consent", "Imaging seen", "Allergies", "INR and platelets"}) {
    ASSERT_NO_FATAL_FAILURE(go_to(item));
    press("space");
  }
  EXPECT_TRUE(says("[x] INR and platelets"));
  person_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(press_at("Enter the room (Enter)"));
  ASSERT_TRUE(person_->reaches("attempt")) << person_->now();
  ASSERT_TRUE(fixtures::until([&] { return person_->now().value("attempt_s", 0.0) > 0.5; }));
  press("y");
  if (person_->now().value("held", "") != "needle") press("Tab");
  ASSERT_TRUE(fixtures::until([&] { return person_->now().value("held", "") == "needle"; }))
      << "here Tab takes the other tool";
  const auto tip = [&] {
    const Json at = person_->now()["needle_lps_mm"];
    return glm::dvec3(at[0], at[1], at[2]);
  };
  const glm::dvec3 before = tip();
  person_->screen().hold("Next", 1.0);
  EXPECT_TRUE(fixtures::until([&] { return glm::length(tip() - before) > 3.0; })) << "Page Down pushes it on";
  press("F9");
  ASSERT_TRUE(person_->reaches("debrief")) << person_->now();
  EXPECT_TRUE(says("## debrief"));
  ASSERT_NO_FATAL_FAILURE(press_at("Cases"));
  ASSERT_TRUE(person_->reaches("choose")) << person_->now();
  ASSERT_NO_FATAL_FAILURE(press_at("Log out"));
  ASSERT_TRUE(person_->reaches("log_in")) << person_->now();
  for (const char* screen : {"log in", "the list of cases", "the briefing", "the room", "debrief"})
    EXPECT_NE(words().find("## " + std::string(screen) + "\n"), std::string::npos) << screen;
  for (const char* secret : {kPassword, "a pass"}) EXPECT_EQ(words().find(secret), std::string::npos) << "in clear";
}

TEST_F(TrainKeysTest, AMentorNeedsNoMouse) {
  const Json lesion = library_.ask("case show " + case_id_)["lesions"][0];
  library_.done("case lesion " + case_id_ + " --remove " + lesion["lesion_id"].get<std::string>());
  library_.done("case setting " + case_id_ + " --title 'By keys' --pass 'hit >= 1' --pass 'skin_punctures <= 1'");
  const auto shown = [&] { return library_.ask("case show " + case_id_); };
  sit_down();
  ASSERT_NO_FATAL_FAILURE(log_in("mona"));
  ASSERT_NO_FATAL_FAILURE(press_at("Open draft: By keys"));
  ASSERT_TRUE(person_->reaches("editor")) << person_->now();
  const auto editor = [&] { return person_->now().value("editor", Json::object()); };
  const auto checked = [&] { return fixtures::until([&] { return !editor().value("checking", true); }, 60.0); };
  ASSERT_TRUE(checked());

  // The cursor to where the lesion was, and the lesion there.
  ASSERT_NO_FATAL_FAILURE(go_to("Axial"));
  const Json& to = lesion["center_mm"];
  const auto lead = [&](int axis, const char* forth, const char* back) {
    for (int i = 0; i < 60; ++i) {
      const double left_mm = to[axis].get<double>() - editor()["cursor_lps_mm"][axis].get<double>();
      if (std::abs(left_mm) < 3.0) return;
      const std::string shift = std::abs(left_mm) > 25.0 && axis < 2 ? "shift+" : "";
      press(shift + (left_mm > 0.0 ? forth : back));
      ASSERT_TRUE(person_->passes(0.3));
    }
    FAIL() << axis << " " << editor();
  };
  ASSERT_NO_FATAL_FAILURE(lead(0, "Right", "Left"));
  ASSERT_NO_FATAL_FAILURE(lead(1, "Down", "Up"));
  press("l");
  press("space");
  ASSERT_TRUE(fixtures::until([&] { return editor().value("lesions", 0) == 1; })) << person_->now();
  press("e");
  press("space");
  ASSERT_TRUE(fixtures::until([&] { return editor().value("entry", false); })) << person_->now();
  ASSERT_TRUE(checked());
  ASSERT_TRUE(editor()["failing"].empty()) << editor();
  person_->keep_picture();

  // Letters that are tools elsewhere are letters in a field.
  press("r");
  ASSERT_NO_FATAL_FAILURE(go_to("title"));
  press("ctrl+a");
  person_->screen().type("velvet");
  press("Return");
  ASSERT_TRUE(fixtures::until([&] { return shown()["title"] == "velvet"; })) << shown()["title"];
  EXPECT_EQ(editor()["lesions"], 1) << "no letter was taken for a tool";
  person_->keep_picture();

  ASSERT_NO_FATAL_FAILURE(press_at("Can it be passed?"));
  ASSERT_TRUE(fixtures::until([&] { return editor().value("rehearsed", 0) == 24; }, 240.0)) << person_->now();
  EXPECT_GT(editor()["met"], 0);
  EXPECT_LT(editor()["met"], 24) << "novices do not all hit";
  EXPECT_TRUE(says("they prove nothing about trainees"));
  EXPECT_TRUE(says("expert: "));
  person_->keep_picture();
  EXPECT_TRUE(library_.ask("attempt list")["attempts"].size() > 0) << "the demo's own";
  for (const Json& attempt : library_.ask("attempt list")["attempts"])
    EXPECT_NE(attempt["case_id"], case_id_) << "none is kept";
  ASSERT_NO_FATAL_FAILURE(press_at("Can it be passed?"));
  ASSERT_TRUE(focuses("Stop")) << "the keyboard stayed: " << person_->now();
  press("Return");
  ASSERT_TRUE(fixtures::until([&] { return editor().value("rehearsed", 24) < 24; }, 60.0)) << person_->now();

  // A question stands on what takes nothing back.
  ASSERT_NO_FATAL_FAILURE(go_to("Publish to my cohort", "shift+Tab"));
  press("Return");
  ASSERT_TRUE(focuses("Not yet (Esc)")) << person_->now();
  press("Return");
  ASSERT_TRUE(person_->passes(1.0));
  EXPECT_EQ(shown()["state"], "draft");
  ASSERT_NO_FATAL_FAILURE(go_to("Publish to my cohort", "shift+Tab"));
  press("Return");
  ASSERT_TRUE(focuses("Not yet (Esc)")) << person_->now();
  ASSERT_NO_FATAL_FAILURE(go_to("Publish it", "shift+Tab"));
  press("Return");
  ASSERT_TRUE(fixtures::until([&] { return editor().value("state", "") == "published"; })) << person_->now();
  ASSERT_NO_FATAL_FAILURE(press_at("Cases"));
  ASSERT_TRUE(person_->reaches("choose")) << person_->now();
  EXPECT_EQ(words().find(kPassword), std::string::npos);
}

// A CT is imported in the window; of one that is there already the mentor is told, and not kept from it. A trainee
// is not asked.
TEST_F(TrainKeysTest, AMentorImportsACtWithoutAMouse) {
  const std::filesystem::path ct = library_.folder() / "ct";
  std::filesystem::create_directories(ct);
  volume::PhantomOptions coarse;  // read at once
  coarse.spacing_mm = {3.0, 3.0, 6.0};
  ASSERT_TRUE(casedb::write_dicom_series(volume::make_phantom(coarse).volume, {"a torso"}, ct));
  sit_down();
  ASSERT_NO_FATAL_FAILURE(log_in("mona"));
  const auto import = [&](const std::string& source, const std::string& title) {
    ASSERT_NO_FATAL_FAILURE(press_at("Import a CT"));
    ASSERT_TRUE(focuses("Folder or file")) << person_->now();
    person_->screen().type(source);
    press("Tab");
    ASSERT_TRUE(focuses("Title")) << person_->now();
    person_->screen().type(title);
    ASSERT_NO_FATAL_FAILURE(go_to("Import it"));
    person_->keep_picture();
    press("Return");
  };
  const auto cases = [&] { return library_.ask("case list")["cases"].size(); };
  const std::size_t before = cases();
  ASSERT_NO_FATAL_FAILURE(import(ct.string(), "Torso of my own"));
  ASSERT_TRUE(fixtures::until([&] { return person_->shows("imported"); }, 120.0)) << person_->now();
  EXPECT_EQ(cases(), before + 1);
  EXPECT_TRUE(says("| Torso of my own |"));
  EXPECT_EQ(words().find("already has this CT"), std::string::npos);
  ASSERT_NO_FATAL_FAILURE(import(ct.string(), "Once more"));
  EXPECT_TRUE(fixtures::until([&] { return says("already has this CT, in “Torso of my own”, version 1"); }, 120.0))
      << words();
  EXPECT_EQ(cases(), before + 2) << "told, and not refused";
  ASSERT_NO_FATAL_FAILURE(import((library_.folder() / "nowhere").string(), "Nothing"));
  ASSERT_TRUE(fixtures::until([&] { return person_->shows("refused"); }, 60.0)) << person_->now();
  EXPECT_EQ(cases(), before + 2);
  person_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(press_at("Duplicate: Torso of my own"));
  EXPECT_TRUE(says("“Torso of my own” now has a duplicate")) << words();
  EXPECT_TRUE(says("| Copy of Torso of my own |"));
  EXPECT_EQ(cases(), before + 3);
  EXPECT_TRUE(fixtures::until([&] { return person_->shows("thumbnail#3"); })) << "each with its picture";
  person_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(press_at("Log out"));
  ASSERT_TRUE(person_->reaches("log_in"));
  ASSERT_NO_FATAL_FAILURE(log_in("tina"));
  EXPECT_TRUE(person_->passes(0.6));
  EXPECT_FALSE(person_->shows("Import a CT"));
}

}  // namespace
}  // namespace seldinger
