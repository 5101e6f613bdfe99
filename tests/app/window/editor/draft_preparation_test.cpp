// What a mentor looks at while a CT is prepared is what import then makes of it, setting by setting, bit for bit;
// what is kept is that.
#include "app/window/editor/draft_preparation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "app/cases/import_case.h"
#include "casedb/export/dicom_series.h"
#include "casedb/people/people.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/volume_bytes.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

class DraftPreparationTest : public testing::Test {
 protected:
  // A ball of soft tissue with a rod of bone, as DICOM.
  void SetUp() override {
    fixtures::Ball ball;
    ball.radius_mm = 40.0;
    ball.inside = {{volume::Sphere{{-20, 0, 0}, 8.0}, 900.0, ""}};
    std::filesystem::create_directories(source_);
    ASSERT_TRUE(casedb::write_dicom_series(fixtures::new_ball(ball).volume, {"ball"}, source_));
    library_.emplace(std::move(casedb::Library::open_or_create(folder_).value()));
    ASSERT_TRUE(casedb::add_user(*library_, "mona", casedb::Role::mentor, "a long password"));
    case_id_ = casedb::add_case(*library_, import({}));
  }
  casedb::NewCase import(const casedb::Preparation& settings) const {
    return import_case(source_, {}, "Ball", "import", {}, false, settings).value();
  }
  std::unique_ptr<DraftPreparation> preparing(const std::string& case_id) {
    const auto stored = casedb::find_preparation(library_->database(), case_id);
    return std::make_unique<DraftPreparation>(folder_, casedb::find_case(*library_, case_id).value(),
                                              stored ? stored->settings : casedb::Preparation{});
  }
  static bool is_there(const DraftPreparation& preparing) {
    return fixtures::until([&] { return !preparing.busy(); });
  }
  static void expect_same(const PreparedDraft& seen, const casedb::NewCase& made) {
    EXPECT_EQ(volume::bytes_from_volume(seen.shown->scene.volume), volume::bytes_from_volume(made.volume));
    EXPECT_EQ(cases::bytes_from_mesh(seen.shown->scene.skin), cases::bytes_from_mesh(made.skin));
    const auto told = [](const std::vector<base::Problem>& warnings) {
      std::string text;
      for (const base::Problem& one : warnings)
        if (one.code == "prepared" || one.code == "denoised") text += one.code + ": " + one.text + "\n";
      return text;
    };
    EXPECT_EQ(told(seen.warnings), told(made.warnings));
  }

  std::filesystem::path place_ = fixtures::fresh_test_folder("app"), folder_ = place_ / "library",
                        source_ = place_ / "series";
  std::optional<casedb::Library> library_;
  std::string case_id_;
};

// Of each setting, in the table's order, another than usual.
constexpr std::array<double, casedb::kPreparationRows.size()> kOthers = {-900.0, 500.0,  3.0, 2.0,  2.0,
                                                                         2.0,    -500.0, 3.0, 40.0, 0.3};

TEST_F(DraftPreparationTest, EachSettingIsSeenAsImportMakesIt) {
  const auto preparing = this->preparing(case_id_);
  ASSERT_TRUE(is_there(*preparing));
  expect_same(*preparing->newest(), import({}));
  const auto usual = cases::bytes_from_mesh(import({}).skin);
  for (const casedb::PreparationRow& row : casedb::kPreparationRows) {
    SCOPED_TRACE(row.name);
    casedb::Preparation settings;
    settings.*row.value = kOthers.at(static_cast<std::size_t>(&row - casedb::kPreparationRows.data()));
    preparing->wish(settings);
    ASSERT_TRUE(is_there(*preparing));
    ASSERT_FALSE(preparing->error()) << preparing->error()->findings.size();
    ASSERT_EQ(preparing->newest()->settings, settings);
    const casedb::NewCase made = import(settings);
    expect_same(*preparing->newest(), made);
    ASSERT_TRUE(made.prepared);
    const bool other_skin = cases::bytes_from_mesh(made.skin) != usual,
               other_volume = made.volume.hu != made.prepared->original.hu;
    EXPECT_TRUE(other_skin || other_volume) << "it does something";
    EXPECT_EQ(other_volume, settings.changes_volume());
  }
}

TEST_F(DraftPreparationTest, WhatIsKeptIsWhatIsSeenAndIsPreparedAnewOfTheSameCt) {
  const auto first = preparing(case_id_);
  ASSERT_TRUE(is_there(*first));
  casedb::Preparation settings;
  settings.shrink_i = settings.shrink_j = 2.0;
  first->wish(settings);
  EXPECT_FALSE(first->keep(*library_, "mona")) << "it is not there yet";
  ASSERT_TRUE(is_there(*first));
  const std::string kept = first->keep(*library_, "mona").value();
  const casedb::CaseRow row = casedb::find_case(*library_, kept).value();
  EXPECT_EQ(casedb::load_volume(*library_, row).value().hu, import(settings).volume.hu);
  EXPECT_EQ(cases::bytes_from_mesh(casedb::load_skin(*library_, row).value()),
            cases::bytes_from_mesh(import(settings).skin));
  const auto again = preparing(kept);
  EXPECT_EQ(again->settings(), settings);
  again->wish({});
  ASSERT_TRUE(is_there(*again));
  expect_same(*again->newest(), import({}));
  EXPECT_EQ(again->original()->scene.volume.hu, import({}).volume.hu);
}

TEST_F(DraftPreparationTest, WhatCannotBeIsToldAndTheLastStays) {
  const auto preparing = this->preparing(case_id_);
  ASSERT_TRUE(is_there(*preparing));
  casedb::Preparation settings;
  settings.shrink_k = 99.0;
  preparing->wish(settings);
  ASSERT_TRUE(is_there(*preparing));
  ASSERT_TRUE(preparing->error());
  EXPECT_EQ(preparing->error()->code, "bad_preparation");
  EXPECT_EQ(preparing->newest()->settings, casedb::Preparation{});
  EXPECT_FALSE(preparing->keep(*library_, "mona"));
}

// As import prepares by itself there is no body in it: that is told, and is in the way of nothing else.
TEST_F(DraftPreparationTest, WhatHasNoUsualSkinIsPreparedAsAsked) {
  casedb::NewCase thin = fixtures::new_ball({});
  for (std::int16_t& hu : thin.volume.hu) hu = std::min<std::int16_t>(hu, -500);
  const auto preparing = this->preparing(casedb::add_case(*library_, thin));
  ASSERT_TRUE(is_there(*preparing));
  ASSERT_TRUE(preparing->error());
  EXPECT_EQ(preparing->error()->code, "no_body");
  casedb::Preparation settings;
  settings.skin_hu = -700.0;
  preparing->wish(settings);
  ASSERT_TRUE(is_there(*preparing));
  EXPECT_FALSE(preparing->error());
  ASSERT_TRUE(preparing->newest());
  EXPECT_EQ(preparing->newest()->settings, settings);
}

TEST(HuHistogram, CountsEveryVoxelOnce) {
  volume::Volume made = volume::make_volume({10, 10, 1}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  made.hu[0] = -1020;
  made.hu[1] = 3000;
  made.hu[2] = 1999;
  made.hu[3] = 0;
  const HuHistogram histogram = histogram_of(made);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}), 100U);
  EXPECT_EQ(histogram.counts.front(), 97U);
  EXPECT_EQ(histogram.counts.back(), 2U);
  EXPECT_EQ(histogram.counts[HuHistogram::bin_of(0.0)], 1U);
  EXPECT_EQ(histogram.height(0), 1.0);
  EXPECT_GT(histogram.height(HuHistogram::bin_of(0.0)), 0.1) << "one voxel beside many";
  EXPECT_EQ(histogram.height(10), 0.0);
}

}  // namespace
}  // namespace seldinger::app
