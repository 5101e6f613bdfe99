// One window that its user draws larger and smaller, with letters of two sizes: on each screen what is to be
// pressed is in sight and apart at every size between, and at three of them the screen looks as it is kept
// (tests/e2e/window/pictures; SELDINGER_RENEW_PICTURES=1 writes them anew).
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/fixtures/coarse_picture.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"
#include "tests/fixtures/window_looks.h"

namespace seldinger {
namespace {

using fixtures::kPassword;
using fixtures::WindowLook;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

struct Size {
  int width, height;
  bool kept;
};
constexpr Size kSizes[] = {
    {1920, 1080, true}, {1440, 900, false}, {1280, 800, true}, {1024, 700, false}, {800, 600, true}};

class TrainSizesTest : public testing::TestWithParam<double> {
 protected:
  static void SetUpTestSuite() {
    library_.emplace(fixtures::fresh_folder("train_sizes"));
    const std::string case_id = fixtures::draft_of_course(*library_);
    library_->done("user add tim --role trainee");
    library_->done("cohort enrol Autumn --user tim");
    library_->done(
        "case setting " + case_id + " --title 'A liver biopsy' --entry-mm " +
        fixtures::straight_way(*library_, case_id).entry() +
        " --instrument core --throw-mm 22 --difficulty easy --inr 1.1 --platelets 210 --pass 'hit >= 1'");
    library_->done("case publish " + case_id + " --by mona --own-cohort");
  }
  void TearDown() override {
    if (!trainee_) return;
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
  }
  Json now() const { return trainee_->now(); }

  void resize(const Size& size) {
    trainee_->screen().resize(size.width, size.height);
    const Json wanted = {size.width, size.height};
    ASSERT_TRUE(fixtures::until([&] { return now().value("window_px", Json()) == wanted; })) << now();
  }
  // Of the attempt that ended last: a machine with other work may be too slow for scatterers, and the debrief says
  // so in a line that takes its place.
  static bool speckle_was_simplified() {
    const std::string id = library_->ask("attempt list")["attempts"][0]["attempt_id"];
    return library_->ask("attempt show " + id)["conditions"]["speckle_fallback"];
  }
  // On the screen that is up; the largest window is there again when it returns.
  void look(const std::string& screen, const Names& names) {
    for (const Size& size : kSizes) {
      const WindowLook look{size.width, size.height, GetParam()};
      SCOPED_TRACE(screen + ", " + look.name());
      ASSERT_NO_FATAL_FAILURE(resize(size));
      ASSERT_NO_FATAL_FAILURE(fixtures::expect_in_sight(*trainee_, look, names));
      if (size.kept) fixtures::expect_as_kept([&] { return trainee_->keep_picture(); }, screen + "-" + look.name());
    }
    ASSERT_NO_FATAL_FAILURE(resize(kSizes[0]));
  }

  static inline std::optional<fixtures::CommandLibrary> library_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

TEST_P(TrainSizesTest, EveryScreenIsUsableAndLooksAsItIsKept) {
  const std::string name = "letters_" + std::to_string(static_cast<int>(10.0 * GetParam()));
  const std::filesystem::path folder = library_->folder() / name;
  std::filesystem::create_directories(folder);
  trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), folder,
                                                 WindowLook{1920, 1080, GetParam()}.options());
  ASSERT_NO_FATAL_FAILURE(look("log_in", {"Name", "Password", "Log in"}));
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in(GetParam() > 1.0 ? "tim" : "tina", kPassword));
  ASSERT_TRUE(fixtures::until([&] { return trainee_->shows("thumbnail"); })) << now();
  ASSERT_NO_FATAL_FAILURE(look("choose", {"thumbnail", "Practise", "Hands (F10)", "Log out"}));
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  trainee_->click("All checked");
  ASSERT_NO_FATAL_FAILURE(look("briefing", {"Back", "Enter the room (Enter)"}));
  trainee_->press("p");
  ASSERT_NO_FATAL_FAILURE(look("planning", {"Axial", "Coronal", "Sagittal", "in 3-D", "Entry (1)", "Tip (2)",
                                            "As proposed (3)", "Back to the briefing (P)"}));
  trainee_->press("p");
  trainee_->click("Enter the room (Enter)");
  ASSERT_TRUE(trainee_->reaches("attempt")) << now();
  ASSERT_TRUE(fixtures::until([&] { return now().value("attempt_s", 0.0) > 0.5; })) << now();
  trainee_->press("y");
  ASSERT_NO_FATAL_FAILURE(
      look("attempt", {"room", "picture", "F1  Probe checked", "F3  Aspirate", "F9  Sign out and finish"}));
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  const std::string debrief = speckle_was_simplified() ? "debrief_simplified" : "debrief";
  ASSERT_NO_FATAL_FAILURE(look(debrief, {"Cases", "What is missing"}));
}

// What is kept of one screen is not what is kept of another: a comparison that all pass would hold nothing.
TEST(KeptPictures, TellScreensApart) {
  const std::filesystem::path folder = fixtures::source_dir() / "tests" / "e2e" / "window" / "pictures";
  const Names screens = {"log_in", "choose", "briefing", "planning", "attempt", "debrief"};
  for (const double letters : {1.0, 1.6})
    for (const Size& size : kSizes) {
      if (!size.kept) continue;
      const auto kept = [&](const std::string& screen) {
        return fixtures::read_png(folder /
                                  (screen + "-" + WindowLook{size.width, size.height, letters}.name() + ".png"));
      };
      for (std::size_t i = 0; i < screens.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_FALSE(fixtures::alike(fixtures::difference(kept(screens[i]), kept(screens[j]))))
              << screens[i] << " and " << screens[j] << " at " << size.width << ", " << letters;
    }
}

INSTANTIATE_TEST_SUITE_P(Letters, TrainSizesTest, testing::Values(1.0, 1.6));

}  // namespace
}  // namespace seldinger
