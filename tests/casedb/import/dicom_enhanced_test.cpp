// Enhanced (multi-frame) CT: each frame lies where its functional groups say, in whatever order and however packed.
#include <random>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

constexpr glm::ivec2 kFrame{4, 3};
constexpr const char* kRleSyntax = "1.2.840.10008.1.2.5";
constexpr std::uint32_t kSharedGroups = 0x52009229, kFrameGroups = 0x52009230, kPosition = 0x00209113;

std::vector<glm::dvec3> places(std::initializer_list<double> heights_mm) {
  std::vector<glm::dvec3> all;
  for (const double z : heights_mm) all.emplace_back(-3.0, 4.0, z);
  return all;
}

class DicomEnhanced : public ImportCase {
 protected:
  // The shuffled file below: heights 0, 2, 4, 6 are frames 1, 3, 0, 2.
  static TestDicom shuffled() { return enhanced_ct(kFrame, places({4, 0, 6, 2})); }
  void expect_shuffled(const base::Result<Source>& source) {
    ASSERT_TRUE(source) << source.error().code << source.error().text;
    EXPECT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 4));
    EXPECT_EQ(source->slices_used, 4);
    const glm::dmat4 expected({0.25, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 2.0, 0}, {-3.0, 4.0, 0.0, 1.0});
    EXPECT_LT(largest_difference(source->volume.lps_from_voxel, expected), 1e-12);
    const int frame_at[] = {1, 3, 0, 2};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 12; ++i)
        EXPECT_EQ(source->volume.at(i % 4, i / 4, k), 100 * frame_at[k] + i) << k << ' ' << i;
  }
  static std::vector<std::string> rle_frames(std::size_t count) {
    std::vector<std::string> frames;
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<int> stored;
      for (int i = 0; i < 12; ++i) stored.push_back(100 * static_cast<int>(k) + i);
      frames.push_back(rle_frame(stored));
    }
    return frames;
  }
};

TEST_F(DicomEnhanced, FramesLieWhereTheyAreSaidTo) {
  for (const TestSyntax syntax :
       {TestSyntax::implicit_le, TestSyntax::explicit_le, TestSyntax::explicit_be, TestSyntax::deflated})
    expect_shuffled(read(write("PLANTED.dcm", shuffled().bytes(syntax))));
}

TEST_F(DicomEnhanced, SequencesOfUndefinedLengthAndWithinUnknownOnes) {
  TestDicom file = shuffled();
  std::vector<TestDicom> frames;
  for (const glm::dvec3& place : places({4, 0, 6, 2}))
    frames.push_back(TestDicom().sequence(kPosition, {TestDicom().at(place)}, true));
  file.sequence(kFrameGroups, frames, true);
  expect_shuffled(read(write("PLANTED.dcm", file.bytes())));
  // As another program would pass it on that does not know the tag: UN, implicit inside.
  TestDicom shared;
  shared.sequence(0x00209116, {TestDicom().lying({1, 0, 0}, {0, 1, 0})});
  shared.sequence(0x00289110, {TestDicom().text(0x00280030, "DS", "0.5\\0.25")});
  const std::string inner = shared.data_set(false, false);
  const auto length = static_cast<char>(inner.size());
  file.raw(kSharedGroups, "UN", std::string("\xFE\xFF\x00\xE0", 4) + length + std::string(3, '\0') + inner);
  const auto source = read(write("PLANTED.dcm", file.bytes()));
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->volume.size_voxels, glm::ivec3(4, 3, 4));
  EXPECT_TRUE(has_code(source->warnings, "no_rescale"));  // that was in what is no longer there
}

TEST_F(DicomEnhanced, PackedFramesByTableOrOneFragmentEach) {
  const auto frames = rle_frames(4);
  expect_shuffled(read(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, frames).bytes())));
  expect_shuffled(read(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, frames, {0, 1, 2, 3}).bytes())));
  // One frame in two fragments: with a table it is known which, without one nobody says.
  std::vector<std::string> split = frames;
  split[1] = frames[1].substr(0, 64);
  split.insert(split.begin() + 2, frames[1].substr(64));
  expect_shuffled(read(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, split, {0, 1, 3, 4}).bytes())));
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, split).bytes())), "damaged");
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, frames, {0, 2, 3}).bytes())), "");
  std::vector<std::string> fewer(frames.begin(), frames.begin() + 3);
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().fragments(kRleSyntax, fewer).bytes())), "damaged");
}

TEST_F(DicomEnhanced, FramesInJpegAreTheSampleTwice) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::string sample = fixtures::whole_file(shared_data("dicom-samples/chest_jpeg_lossless_sv1.dcm"));
  const std::size_t begin = sample.find("\xFF\xD8\xFF"), end = sample.rfind("\xFF\xD9") + 2;
  const std::string frame = sample.substr(begin, end - begin) + std::string((end - begin) % 2, '\0');
  TestDicom file = enhanced_ct({512, 512}, places({0, 2}));
  const auto plain = read(shared_data("dicom-samples/chest_explicit_le.dcm"));
  ASSERT_TRUE(plain);
  const auto source =
      read(write("PLANTED.dcm", file.fragments("1.2.840.10008.1.2.4.70", {frame, frame}, {0, 1}).bytes()));
  ASSERT_TRUE(source) << source.error().text;
  ASSERT_EQ(source->volume.size_voxels, glm::ivec3(512, 512, 2));
  for (std::size_t i = 0; i < source->volume.hu.size(); ++i) {
    const int hu = source->volume.hu[i], sample_hu = plain->volume.hu[i % plain->volume.hu.size()];
    if (sample_hu > -1024)
      ASSERT_EQ(hu, sample_hu + 1024) << i;  // the sample's intercept is −1024, here it is 0
    else
      ASSERT_LE(hu, 0) << i;
  }
}

TEST_F(DicomEnhanced, AFramesOwnRescaleStandsAboveTheSharedOne) {
  TestDicom file = shuffled();
  std::vector<TestDicom> frames;
  int k = 0;
  for (const glm::dvec3& place : places({4, 0, 6, 2})) {
    TestDicom frame;
    frame.sequence(kPosition, {TestDicom().at(place)});
    if (k++ == 2)
      frame.sequence(0x00289145, {TestDicom().text(0x00281052, "DS", "-500").text(0x00281053, "DS", "2")});
    frames.push_back(frame);
  }
  const auto source = read(write("PLANTED.dcm", file.sequence(kFrameGroups, frames).bytes()));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->volume.at(1, 0, 3), 2 * 201 - 500);  // frame 2 lies highest
  EXPECT_EQ(source->volume.at(1, 0, 2), 1);
}

TEST_F(DicomEnhanced, FramesThatDoNotSayWhereTheyLie) {
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().remove(kFrameGroups).bytes())), "multi_frame");
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().text(0x00280008, "IS", "5").bytes())), "multi_frame");
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().text(0x00280008, "IS", "0").bytes())), "multi_frame");
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().text(0x00280008, "IS", "999999999").bytes())), "multi_frame");
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().remove(kSharedGroups).bytes())), "no_geometry");
  const std::vector<TestDicom> empty(4);
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().sequence(kFrameGroups, empty).bytes())), "no_geometry");
}

TEST_F(DicomEnhanced, FewerPixelsThanFrames) {
  TestDicom file = shuffled();
  file.pixels(std::vector<int>(47, 0));
  EXPECT_EQ(refusal(write("PLANTED.dcm", file.bytes())), "truncated");
  const std::string whole = shuffled().bytes();
  for (const std::size_t lost : {1U, 30U, 100U})
    EXPECT_EQ(refusal(write("PLANTED.dcm", whole.substr(0, whole.size() - lost))), "truncated") << lost;
}

TEST_F(DicomEnhanced, TwoTimesAtOnePlaceAreRefused) {
  EXPECT_EQ(refusal(write("PLANTED.dcm", enhanced_ct(kFrame, places({0, 2, 0, 2})).bytes())), "duplicate_slices");
}

TEST_F(DicomEnhanced, FramesOfSeveralFilesMakeOneVolume) {
  write("a", enhanced_ct(kFrame, places({0, 4})).bytes());
  write("b", enhanced_ct(kFrame, places({6, 2})).bytes());
  write("c", TestDicom::ct_slice(kFrame, 7).at({-3.0, 4.0, 8.0}).bytes());
  const auto source = read(folder_);
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ(source->volume.size_voxels.z, 5);
  const int first[] = {0, 100, 100, 0, 7};
  for (int k = 0; k < 5; ++k) EXPECT_EQ(source->volume.at(0, 0, k), first[k]) << k;
}

TEST_F(DicomEnhanced, ProjectionsAndLocalizersAmongFrames) {
  EXPECT_EQ(refusal(write("PLANTED.dcm", shuffled().text(0x00089207, "CS", "MAX_IP").bytes())), "derived");
  EXPECT_EQ(
      refusal(write("PLANTED.dcm", shuffled().text(0x00080008, "CS", "DERIVED\\PRIMARY\\VOLUME\\MAXIMUM").bytes())),
      "derived");
  EXPECT_EQ(refusal(write("PLANTED.dcm",
                          shuffled().text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER\\NONE").bytes())),
            "localizer");
  TestDicom file = shuffled();
  std::vector<TestDicom> frames;
  for (const glm::dvec3& place : places({4, 0, 6, 2}))
    frames.push_back(
        TestDicom()
            .sequence(kPosition, {TestDicom().at(place)})
            .sequence(0x00189329, {TestDicom().text(0x00089007, "CS",
                                                    frames.size() == 2 ? "ORIGINAL\\PRIMARY\\LOCALIZER\\NONE"
                                                                       : "ORIGINAL\\PRIMARY\\VOLUME\\NONE")}));
  const auto source = read(write("PLANTED.dcm", file.sequence(kFrameGroups, frames).bytes()));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->slices_used, 3);
  EXPECT_TRUE(has_code(source->warnings, "left_out"));
}

}  // namespace
}  // namespace seldinger::casedb
