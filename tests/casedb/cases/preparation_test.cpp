// How a case's CT was prepared is stored with it, with the CT as it came, and a copy can be prepared anew.
#include "casedb/cases/preparation.h"

#include <nlohmann/json.hpp>

#include "casedb/cases/authoring.h"
#include "casedb/cases/case_checks.h"
#include "casedb/cases/versions.h"
#include "casedb/json/case_json.h"
#include "casedb/people/people.h"
#include "sim/volume/volume_bytes.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class PreparationTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(add_user(library_, "ann", Role::mentor, "a password")); }
  Preparation settings() const {
    Preparation made;
    made.clamp_high_hu = 1500.0;
    made.skin_grid_mm = 1.5;
    return made;
  }
  NewCase prepared_case() const {
    NewCase made = sample_case();
    made.prepared = {settings(), sample_volume({9, 7, 5}, 2)};
    return made;
  }
  // Of fewer voxels where it is shrunk.
  PreparedCopy copy(double shrink_k) const {
    PreparedCopy made{sample_volume({9, 7, shrink_k > 1.0 ? 2 : 5}, 3), sample_mesh(), settings(), {}};
    made.settings.shrink_k = shrink_k;
    made.warnings = {{"prepared", "asked for: something"}};
    return made;
  }
  std::optional<StoredPreparation> stored(const std::string& case_id) {
    return find_preparation(library_.database(), case_id);
  }
  nlohmann::ordered_json json(const std::string& case_id) {
    nlohmann::ordered_json made = nlohmann::ordered_json::object();
    add_authoring(load_parts(library_, case_id).value(), made);
    return made.at("preparation");
  }

  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
};

TEST_F(PreparationTest, IsStoredWithTheCtAsItCame) {
  const std::string plain = add_case(library_, sample_case()), made = add_case(library_, prepared_case());
  EXPECT_FALSE(stored(plain));
  EXPECT_TRUE(json(plain).is_null());
  ASSERT_TRUE(stored(made));
  EXPECT_EQ(stored(made)->settings, settings());
  const auto bytes = library_.load_asset(stored(made)->original_sha256).value();
  EXPECT_EQ(volume::volume_from_bytes(bytes).value().hu, prepared_case().prepared->original.hu);
  for (const PreparationRow& row : kPreparationRows) EXPECT_EQ(json(made).at(row.name), settings().*row.value);
  EXPECT_EQ(text_of(settings()), "clamp_high_hu 1500, skin_grid_mm 1.5");
  for (const PreparationRow& row : kPreparationRows)
    EXPECT_TRUE(refused_by_constraint([&] {
      library_.database().run(std::string("UPDATE case_preparation SET ") + row.name + " = " + row.name);
    }));
}

TEST_F(PreparationTest, ACopyIsPreparedAnewOfTheSameCt) {
  const std::string case_id = add_case(library_, sample_case());
  ASSERT_TRUE(add_lesion(library_, case_id, sample_lesion()));
  const std::string first = add_prepared_copy(library_, case_id, copy(1.0), "ann").value();
  const CaseRow before = find_case(library_, case_id).value(), after = find_case(library_, first).value();
  EXPECT_EQ(stored(first)->original_sha256, before.volume_sha256);
  EXPECT_EQ(stored(first)->settings, copy(1.0).settings);
  EXPECT_EQ(load_volume(library_, after).value().hu, copy(1.0).volume.hu);
  EXPECT_EQ(load_volume(library_, before).value().hu, sample_volume().hu);
  EXPECT_EQ(load_classes(library_, after).value().size(), copy(1.0).volume.hu.size());
  EXPECT_EQ(list_lesions(library_, first).size(), 1U);
  EXPECT_EQ(after.attributes, before.attributes);
  ASSERT_EQ(after.warnings.size(), before.warnings.size() + 1);
  EXPECT_EQ(after.warnings.back().code, "prepared");
  EXPECT_EQ(after.state, CaseState::draft);
  EXPECT_EQ(after.title, "Copy of " + before.title);
  // Again, of the CT as it came, and what was told before gives way.
  const std::string second = add_prepared_copy(library_, first, copy(1.0), "ann").value();
  EXPECT_EQ(stored(second)->original_sha256, before.volume_sha256);
  EXPECT_EQ(find_case(library_, second).value().warnings.size(), after.warnings.size());
  // A version keeps how its CT was prepared.
  EXPECT_EQ(stored(new_version(library_, second, "ann").value())->original_sha256, before.volume_sha256);
}

TEST_F(PreparationTest, WhatWouldBeLostIsRefusedAndNothingStays) {
  const auto cases = [&] { return list_cases(library_).size(); };
  const auto code = [](const base::Result<std::string>& made) { return made ? "" : made.error().code; };
  const std::string case_id = add_case(library_, sample_case());
  ASSERT_TRUE(add_lesion(library_, case_id, sample_lesion()));
  EXPECT_EQ(code(add_prepared_copy(library_, "none", copy(1.0), "ann")), "no_case");
  EXPECT_EQ(code(add_prepared_copy(library_, case_id, copy(1.0), "eve")), "no_user");
  EXPECT_EQ(code(add_prepared_copy(library_, case_id, copy(2.0), "ann")), "bad_preparation")
      << "its lesion lies in a slice that is gone";
  const std::string labelled = add_case(library_, sample_case());
  volume::LabelMap labels{std::vector<std::uint8_t>(sample_volume().hu.size(), 1), {"none", "liver"}};
  ASSERT_TRUE(add_label_map(library_, labelled, labels));
  EXPECT_EQ(code(add_prepared_copy(library_, labelled, copy(2.0), "ann")), "bad_preparation");
  EXPECT_EQ(cases(), 2U);
  EXPECT_EQ(code(add_prepared_copy(library_, labelled, copy(1.0), "ann")), "") << "the same voxels";
}

// What no command would take today is copied as it is, but not onto another volume.
TEST_F(PreparationTest, OnlyACopyWithAnotherVolumeIsLookedAtAgain) {
  const std::string case_id = add_case(library_, sample_case());
  ASSERT_TRUE(add_lesion(library_, case_id, sample_lesion()));
  library_.database().run("DROP TRIGGER lesion_is_immutable");
  library_.database().run("UPDATE lesion SET center_x_lps_mm = center_x_lps_mm + 1000.0");
  EXPECT_TRUE(new_version(library_, case_id, "ann"));
  EXPECT_TRUE(duplicate_case(library_, case_id, "ann"));
  EXPECT_FALSE(add_prepared_copy(library_, case_id, copy(1.0), "ann"));
}

TEST_F(PreparationTest, AStructureThatWouldBeLostIsRefused) {
  const std::string case_id = add_case(library_, sample_case());
  StructureRow drawn;
  drawn.case_id = case_id;
  drawn.name = "far slice";
  drawn.drawn = cases::Sphere{glm::dvec3(sample_volume().lps_from_voxel * glm::dvec4(4.0, 3.0, 4.0, 1.0)), 0.1};
  ASSERT_TRUE(add_structure(library_, drawn));
  EXPECT_TRUE(add_prepared_copy(library_, case_id, copy(1.0), "ann"));
  const auto refused = add_prepared_copy(library_, case_id, copy(2.0), "ann");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "bad_preparation");
  EXPECT_NE(refused.error().text.find("far slice"), std::string::npos);
}

// As many voxels elsewhere are other voxels.
TEST_F(PreparationTest, LabelMapsStayWithTheirGrid) {
  const std::string case_id = add_case(library_, sample_case());
  ASSERT_TRUE(add_label_map(library_, case_id,
                            {std::vector<std::uint8_t>(sample_volume().hu.size(), 1), {"none", "liver"}}));
  PreparedCopy moved = copy(1.0);
  moved.volume.lps_from_voxel[3].x += 1.0;
  EXPECT_FALSE(add_prepared_copy(library_, case_id, moved, "ann"));
  EXPECT_TRUE(add_prepared_copy(library_, case_id, copy(1.0), "ann"));
}

// An earlier program kept the denoised CT alone: it is so in every copy, however often it is prepared.
TEST_F(PreparationTest, ThatTheCtWasDenoisedBeforeStaysTold) {
  const auto told = [&](const std::string& case_id) {
    std::vector<std::string> texts;
    const CaseRow row = find_case(library_, case_id).value();
    for (const base::Problem& one : row.warnings)
      if (one.code == "denoised") texts.push_back(one.text);
    return texts;
  };
  const auto prepared = [&](const std::string& case_id, double denoise) {
    PreparedCopy made = copy(1.0);
    made.settings.denoise = denoise;
    if (denoise > 0.0) made.warnings.push_back({"denoised", "now"});
    return add_prepared_copy(library_, case_id, made, "ann").value();
  };
  NewCase earlier = sample_case();
  earlier.warnings.push_back({"denoised", "before"});
  using Texts = std::vector<std::string>;
  const std::string first = prepared(add_case(library_, earlier), 0.0), second = prepared(first, 3.0),
                    third = prepared(second, 5.0), fourth = prepared(third, 0.0);
  EXPECT_EQ(told(first), Texts{"before"});
  EXPECT_EQ(told(second), (Texts{"before", "now"}));
  EXPECT_EQ(told(third), (Texts{"before", "now"}));
  EXPECT_EQ(told(fourth), Texts{"before"});
  EXPECT_EQ(told(prepared(prepared(add_case(library_, sample_case()), 3.0), 0.0)), Texts{});
}

// Surrogates keep marks of before there were preparations.
TEST_F(PreparationTest, ACaseThatWasNotPreparedKeepsItsMark) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string mark = content_mark(library_, case_id);
  const std::string copied = duplicate_case(library_, case_id, "ann").value(),
                    before = content_mark(library_, copied);
  add_preparation(library_.database(), copied, {settings(), find_case(library_, copied).value().volume_sha256});
  EXPECT_NE(content_mark(library_, copied), before);
  library_.database().run("DELETE FROM case_preparation");
  library_.database().run("DROP TABLE case_preparation");
  EXPECT_EQ(content_mark(library_, case_id), mark);
}

}  // namespace
}  // namespace seldinger::casedb
