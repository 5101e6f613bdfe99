// The stated rules for what is taken for a CT: each is broken by the least that breaks it, and kept by what lies
// just on its other side; the document shows the table.
#include "casedb/import/ct_rules.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "tests/fixtures/files.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

// A sound CT of 4 × 4 × 4 voxels: air, and tissue of several HU.
Source sound() {
  Source source;
  source.volume.size_voxels = {4, 4, 4};
  source.volume.spacing_mm = {1.0, 1.0, 2.0};
  source.volume.lps_from_voxel[2].z = 2.0;
  for (int i = 0; i < 64; ++i) source.volume.hu.push_back(static_cast<std::int16_t>(i < 32 ? -1000 : i));
  source.slices_used = 4;
  return source;
}

void spaced(Source& source, int axis, double mm) {
  source.volume.spacing_mm[axis] = mm;
  source.volume.lps_from_voxel[axis] = glm::dvec4(0.0);
  source.volume.lps_from_voxel[axis][axis] = mm;
}

std::string verdict(Source source) {
  const auto judged = judge_ct(source);
  if (!judged) return "refused " + judged.error().code;
  std::string text;
  for (const base::Problem& one : source.warnings) text += (text.empty() ? "" : " ") + one.code;
  return text;
}

TEST(CtRules, ASoundCtIsTakenWithoutAWord) {
  EXPECT_EQ(verdict(sound()), "");
}

TEST(CtRules, AVolumeOfOneValueIsRefused) {
  for (const int hu : {-1024, 0, 1, 40}) {
    Source source = sound();
    source.volume.hu.assign(64, static_cast<std::int16_t>(hu));
    EXPECT_EQ(verdict(source), "refused one_value") << hu;
    source.volume.hu[17] = static_cast<std::int16_t>(hu + 2);
    EXPECT_EQ(verdict(source), "") << hu;
  }
}

TEST(CtRules, ValuesFromMinusOneToOneAreNoHu) {
  Source source = sound();
  for (std::size_t i = 0; i < 64; ++i) source.volume.hu[i] = static_cast<std::int16_t>(i % 3) - 1;
  EXPECT_EQ(verdict(source), "refused normalised");
  source.volume.hu[5] = 2;
  EXPECT_EQ(verdict(source), "");
}

TEST(CtRules, WithoutRescaleThereMustBeAir) {
  Source source = sound();
  source.warnings = {{"no_rescale", "as the reader says it"}};
  EXPECT_EQ(verdict(source), "no_rescale");
  for (std::int16_t& hu : source.volume.hu) hu = std::max<std::int16_t>(hu, -199);
  EXPECT_EQ(verdict(source), "refused no_rescale");
  source.volume.hu[0] = volume::kAirHu;  // padding
  EXPECT_EQ(verdict(source), "refused no_rescale");
  source.volume.hu[0] = -200;
  EXPECT_EQ(verdict(source), "no_rescale");
}

TEST(CtRules, SlicesOf30MmAndMoreAreRefusedAndAbove10Told) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto of = [&](double mm) {
      Source source = sound();
      spaced(source, axis, mm);
      return verdict(source);
    };
    EXPECT_EQ(of(10.0), "") << axis;
    EXPECT_EQ(of(10.1), "thick_slices") << axis;
    EXPECT_EQ(of(29.9), "thick_slices") << axis;
    EXPECT_EQ(of(30.0), "refused thick_slices") << axis;
  }
  Source said = sound();  // thick slices that overlap
  said.attributes = {{"slice_thickness_mm", "30"}};
  EXPECT_EQ(verdict(said), "refused thick_slices");
}

TEST(CtRules, TwoSlicesAreTold) {
  Source source = sound();
  source.volume.size_voxels = {4, 8, 2};
  EXPECT_EQ(verdict(source), "few_slices");
  source.volume.size_voxels = {2, 8, 4};
  EXPECT_EQ(verdict(source), "few_slices");
  source.volume.size_voxels = {4, 16, 1};  // which the reader tells
  EXPECT_EQ(verdict(source), "");
}

TEST(CtRules, EveryReasonToRefuseIsTold) {
  Source source = sound();
  source.volume.hu.assign(64, 7);
  source.warnings = {{"no_rescale", ""}};
  spaced(source, 2, 40.0);
  const auto judged = judge_ct(source);
  ASSERT_FALSE(judged);
  EXPECT_EQ(judged.error().code, "one_value");
  ASSERT_EQ(judged.error().findings.size(), 2U);
  EXPECT_EQ(judged.error().findings[0].code, "no_rescale");
  EXPECT_EQ(judged.error().findings[1].code, "thick_slices");
  EXPECT_NE(judged.error().findings[1].text.find("40 mm"), std::string::npos);
}

TEST(CtRules, AMissingRescaleIsNamedBeforeAFace) {
  Source source = sound();
  const base::Error face{"face", "a face"};
  EXPECT_EQ(with_doubted_hu(face, source).code, "face");
  source.warnings = {{"no_rescale", ""}};
  const base::Error doubted = with_doubted_hu(face, source);
  EXPECT_EQ(doubted.code, "no_rescale");
  ASSERT_EQ(doubted.findings.size(), 1U);
  EXPECT_EQ(doubted.findings[0].code, "face");
}

// 150 mm of the detector, 785 of 1200 mm from the tube: 98 mm at the isocentre.
TEST(CtRules, ASlabThinnerThanTheFluoroscopesFieldIsTold) {
  volume::Volume slab;
  slab.size_voxels = {200, 200, 98};
  slab.spacing_mm = {1.0, 1.0, 1.0};
  const auto thin = thin_slab(slab);
  ASSERT_TRUE(thin);
  EXPECT_EQ(thin->code, "thin_slab");
  EXPECT_NE(thin->text.find("98 mm"), std::string::npos) << thin->text;
  slab.size_voxels.z = 99;
  EXPECT_FALSE(thin_slab(slab));
  slab.spacing_mm.y = 0.4;
  EXPECT_TRUE(thin_slab(slab));
}

TEST(CtRules, TheDocumentShowsTheTable) {
  const std::string document = fixtures::whole_file(fixtures::source_dir() / "docs/import.md");
  EXPECT_NE(document.find(ct_rules_markdown()), std::string::npos) << "docs/import.md lacks\n"
                                                                   << ct_rules_markdown();
}

}  // namespace
}  // namespace seldinger::casedb
