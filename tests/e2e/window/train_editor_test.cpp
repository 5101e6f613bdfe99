// The case editor as a mentor uses it, in a real window: a draft is opened, lesion and entry are clicked, its
// checks go red and green, it is tried, published, and a trainee finds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

// Shares of the axial plane's width and height at z = 0, where the cursor begins: air, the liver, skin on the right
// side.
constexpr std::pair<double, double> kOutside{0.043, 0.10}, kLiver{0.244, 0.447}, kFlank{0.078, 0.475};

class TrainEditorTest : public testing::Test {
 protected:
  void SetUp() override {
    case_id_ = fixtures::draft_of_course(library_);
    library_.done("case lesion " + case_id_ + " --remove " + shown()["lesions"][0]["lesion_id"].get<std::string>());
    library_.done("case setting " + case_id_ + " --title 'From the case editor' --pass 'hit >= 1'");
  }
  void sit_down(const std::vector<std::string>& options = {}) {
    mentor_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_.path(), library_.folder(), options);
  }
  Json shown() const { return library_.ask("case show " + case_id_); }
  Json editor() const { return mentor_->now().value("editor", Json::object()); }
  // Once what was done last is checked.
  bool check_is(const std::string& list, const std::string& name) {
    return fixtures::until(
        [&] {
          const Json now = editor();
          return !now.value("checking", true) && now.contains(list) &&
                 std::find(now[list].begin(), now[list].end(), name) != now[list].end();
        },
        60.0);
  }
  void click_axial(const std::pair<double, double>& at) const { mentor_->click("plane", at.first, at.second); }

  fixtures::CommandLibrary library_{fixtures::fresh_folder("train_editor")};
  std::string case_id_;
  std::unique_ptr<fixtures::Trainee> mentor_;
};

TEST_F(TrainEditorTest, AMentorPlacesChecksAndPublishesAndATraineeFindsIt) {
  sit_down();
  ASSERT_FALSE(HasFailure());
  const fixtures::Screen& screen = mentor_->screen();
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("mona", kPassword));
  mentor_->click("Open draft#2");  // the first is the demo's own, which attempts have frozen
  ASSERT_TRUE(mentor_->reaches("editor"));
  ASSERT_TRUE(check_is("failing", "lesion_present")) << mentor_->now();
  mentor_->keep_picture();
  mentor_->press("l");
  click_axial(kOutside);
  ASSERT_TRUE(check_is("failing", "lesion_inside_body")) << mentor_->now();
  mentor_->keep_picture();
  click_axial(kLiver);
  ASSERT_TRUE(check_is("holding", "lesion_inside_body")) << mentor_->now();
  EXPECT_EQ(editor()["lesions"], 1);
  const double before_mm = shown()["lesions"][0]["radius_mm"];
  const double grip_px = before_mm / editor()["mm_per_pixel"].get<double>();
  const auto [x_px, y_px] = mentor_->place_of("plane").at(kLiver.first, kLiver.second);
  screen.drag(x_px + static_cast<int>(std::lround(grip_px)), y_px, x_px + 22, y_px, 1, 0.8);
  ASSERT_TRUE(fixtures::until([&] { return shown()["lesions"][0]["radius_mm"].get<double>() > before_mm + 1.0; }))
      << "the rim was dragged";
  mentor_->press("e");
  click_axial(kFlank);
  ASSERT_TRUE(check_is("holding", "entry_on_skin")) << mentor_->now();
  mentor_->press("ctrl+z");
  ASSERT_TRUE(fixtures::until([&] { return !editor().value("entry", true); })) << "taken back";
  click_axial(kFlank);
  ASSERT_TRUE(fixtures::until([&] { return editor().value("entry", false) && !editor().value("checking", true); }));
  ASSERT_TRUE(editor()["failing"].empty()) << editor();
  mentor_->keep_picture();
  const auto checked = library_.call("case check " + case_id_);
  EXPECT_EQ(checked.exit_code, 0) << "the command line says the same\n" << checked.out;

  mentor_->click("Try it");
  ASSERT_TRUE(mentor_->reaches("ready")) << mentor_->now();
  ASSERT_NO_FATAL_FAILURE(mentor_->enter_room());
  mentor_->press("y");
  mentor_->press("F9");
  ASSERT_TRUE(mentor_->reaches("debrief"));
  mentor_->press("Escape");
  ASSERT_TRUE(mentor_->reaches("editor"));
  const Json attempts = library_.ask("attempt list");
  for (const Json& attempt : attempts["attempts"])
    EXPECT_TRUE(attempt["synthetic"].get<bool>()) << "it was only tried";
  EXPECT_TRUE(attempts["running"].empty());

  mentor_->click("Publish to my cohort");
  mentor_->click("Not yet (Esc)");
  EXPECT_TRUE(mentor_->passes(1.0));
  EXPECT_EQ(shown()["state"], "draft") << "it was asked about, and not done";
  mentor_->click("Publish to my cohort");
  mentor_->place_of("Publish it");
  mentor_->keep_picture();
  mentor_->click("Publish it");
  ASSERT_TRUE(fixtures::until([&] { return editor().value("state", "") == "published"; })) << mentor_->now();
  mentor_->keep_picture();
  EXPECT_EQ(shown()["state"], "published");
  mentor_->click("Cases");
  ASSERT_TRUE(mentor_->reaches("choose"));
  mentor_->click("Log out");
  ASSERT_TRUE(mentor_->reaches("log_in"));
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("tina", kPassword));
  mentor_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(mentor_->open_first_case());
}

// Submitted, returned, submitted again, approved by another, published; and edited afterwards, which is a new
// draft.
TEST_F(TrainEditorTest, TwoMentorsReviewADraftAndEditWhatTheyPublished) {
  const std::string demo = library_.ask("case list")["cases"].at(0)["case_id"];
  const std::string whole = library_.ask("case version " + demo + " --by mona")["case_id"];
  library_.done("case setting " + whole + " --title Reviewed --pass 'hit >= 1' --difficulty easy");
  library_.done("user add rita --role mentor");
  sit_down({"--case", whole});
  ASSERT_FALSE(HasFailure());
  const auto state = [&] { return library_.ask("case show " + whole)["state"].get<std::string>(); };
  const auto becomes = [&](const char* wanted) {
    return fixtures::until(
               [&] { return editor().value("state", "") == wanted && !editor().value("checking", true); }, 60.0) &&
           state() == wanted;
  };
  const auto log_out = [&] {
    mentor_->click("Cases");
    ASSERT_TRUE(mentor_->reaches("choose")) << mentor_->now();
    mentor_->click("Log out");
    ASSERT_TRUE(mentor_->reaches("log_in"));
  };
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("mona", kPassword, "editor"));
  ASSERT_TRUE(becomes("draft")) << mentor_->now();
  ASSERT_TRUE(editor()["failing"].empty()) << editor();
  mentor_->click("Submit for review");
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  mentor_->keep_picture();
  mentor_->click("Return to draft");
  ASSERT_TRUE(becomes("draft")) << mentor_->now();
  mentor_->click("Submit for review");
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  mentor_->click("Approve");  // not for who made it
  ASSERT_TRUE(fixtures::until([&] { return !editor().value("refusal", "").empty(); })) << mentor_->now();
  ASSERT_NO_FATAL_FAILURE(log_out());
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("rita", kPassword, "editor"));
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  mentor_->click("Approve");
  mentor_->click("Publish");
  mentor_->click("Publish it");
  ASSERT_TRUE(becomes("published")) << mentor_->now();
  mentor_->keep_picture();
  mentor_->click("Cases");
  ASSERT_TRUE(mentor_->reaches("choose"));
  mentor_->keep_picture();
  mentor_->click("Edit#2");  // of the second one that may be practised
  ASSERT_TRUE(mentor_->reaches("editor")) << mentor_->now();
  EXPECT_TRUE(fixtures::until([&] { return editor().value("state", "") == "draft"; })) << mentor_->now();
  EXPECT_EQ(state(), "published") << "trainees keep what they have";

  // A draft is deleted from the list, once that is meant; one with attempts stays, and says why.
  mentor_->place_of("History");
  mentor_->place_of("room");
  mentor_->keep_picture();
  mentor_->click("Cases");
  ASSERT_TRUE(mentor_->reaches("choose"));
  const auto cases = [&] { return library_.ask("case list")["cases"].size(); };
  const std::size_t before = cases();
  mentor_->click("Delete#3");
  mentor_->click("Keep it (Esc)");
  EXPECT_TRUE(mentor_->passes(1.0));
  EXPECT_EQ(cases(), before);
  mentor_->click("Delete#3");
  mentor_->place_of("Delete it");
  mentor_->keep_picture();
  mentor_->click("Delete it");
  EXPECT_TRUE(fixtures::until([&] { return !mentor_->shows("Delete#3"); })) << mentor_->now();
  EXPECT_EQ(cases(), before - 1);
  mentor_->click("Delete");  // the demo's
  mentor_->click("Delete it");
  EXPECT_TRUE(fixtures::until([&] { return mentor_->shows("refused"); })) << mentor_->now();
  EXPECT_EQ(cases(), before - 1);
}

// The skin's value is dragged in the histogram and a number typed; what that costs is told, and it becomes a draft
// of its own that the command line shows as it was prepared.
TEST_F(TrainEditorTest, AMentorPreparesTheCtBesideTheOriginal) {
  sit_down({"--case", case_id_});
  ASSERT_FALSE(HasFailure());
  const fixtures::Screen& screen = mentor_->screen();
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("mona", kPassword, "editor"));
  const auto prepared = [&] { return editor().value("prepared", Json::object()); };
  const auto becomes = [&](const std::string& settings) {
    return fixtures::until([&] { return prepared().value("settings", "none") == settings; }, 120.0);
  };
  ASSERT_TRUE(fixtures::until([&] { return editor().contains("cursor_lps_mm"); }));
  mentor_->press("p");
  ASSERT_TRUE(becomes("")) << mentor_->now();
  const std::size_t triangles = prepared().at("triangles");
  mentor_->place_of("room");
  mentor_->place_of("room#2");
  mentor_->keep_picture();
  const fixtures::Place histogram = mentor_->place_of("histogram");
  const auto x_of = [&](double hu) { return histogram.at((hu + 1024.0) / 3024.0, 0.5).first; };
  const int y_px = histogram.at(0.5, 0.5).second;
  screen.drag(x_of(-300.0), y_px, x_of(-600.0), y_px, 1, 0.8);
  ASSERT_TRUE(fixtures::until([&] { return prepared().value("settings", "").rfind("skin_hu -", 0) == 0; }, 120.0))
      << mentor_->now();
  const std::string dragged = prepared().at("settings");
  EXPECT_NEAR(std::stod(dragged.substr(8)), -600.0, 3024.0 / histogram.width_px + 1.0) << "a pixel is some HU";
  mentor_->click("take triangles away", 0.1, 0.5);
  // Each key once the one before was heard: beside other work a picture takes longer than a hand from key to key.
  for (const char* key : {"ctrl+a", "0", "period", "3", "Return"}) mentor_->press(key);
  ASSERT_TRUE(becomes(dragged + ", skin_decimate 0.30")) << mentor_->now();
  EXPECT_GT(prepared().at("triangles").get<std::size_t>(), 2 * triangles);
  EXPECT_GT(prepared().at("most_mm").get<double>(), 0.0);
  mentor_->place_of("what it costs");
  EXPECT_TRUE(mentor_->passes(1.5));
  mentor_->keep_picture();
  const std::size_t before = library_.ask("case list")["cases"].size();
  mentor_->click("Keep as a new draft");
  ASSERT_TRUE(fixtures::until([&] { return library_.ask("case list")["cases"].size() == before + 1; }, 60.0));
  ASSERT_TRUE(fixtures::until([&] { return !editor().contains("prepared"); })) << "another case is in the editor";
  mentor_->keep_picture();
  Json made;
  const Json listed = library_.ask("case list");
  for (const Json& one : listed["cases"])
    if (one["title"] == "Copy of From the case editor")
      made = library_.ask("case show " + one["case_id"].get<std::string>());
  ASSERT_TRUE(made.is_object());
  EXPECT_EQ(made["preparation"]["skin_decimate"], 0.3);
  EXPECT_EQ(made["preparation"]["shrink_i"], 1.0);
  EXPECT_TRUE(shown()["preparation"].is_null()) << "the one before stays as it was";
}

}  // namespace
}  // namespace seldinger
