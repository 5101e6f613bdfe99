// Every file of the shared DICOM samples does what their README says. A file without a row fails the test.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

class DicomSamples : public ImportCase {};

struct Row {
  const char* refusal;                // "" when it loads
  std::vector<std::string> warnings;  // all of them, in order
  bool is_chest = false;              // the README's one slice: same pixels, −3024 (here −1024) to 1378 HU
};

const std::map<std::string, Row> kRows = {
    {"CT_small.dcm", {"", {"single_slice"}}},
    {"chest_explicit_le.dcm", {"", {"single_slice"}, true}},
    {"chest_deflated.dcm", {"", {"single_slice"}, true}},
    {"chest_j2k_lossless.dcm", {"", {"single_slice"}, true}},
    {"chest_jpegls_lossless.dcm", {"", {"single_slice"}, true}},
    {"chest_jpeg_lossless_sv1.dcm", {"", {"single_slice"}, true}},
    {"chest_rle.dcm", {"", {"single_slice"}, true}},
    {"chest_jpeg12_lossy.dcm", {"", {"lossy", "single_slice"}}},
    {"MR_small.dcm", {"not_ct", {}}},
    {"MR_small_bigendian.dcm", {"not_ct", {}}},
    {"emri_small.dcm", {"not_ct", {}}},
    {"rtstruct.dcm", {"not_ct", {}}},
    {"rtdose.dcm", {"not_ct", {}}},
    {"liver_1frame.dcm", {"not_ct", {}}},
    {"sr_no_pixel_data.dcm", {"not_ct", {}}},
    {"us_no_pixel_spacing.dcm", {"not_ct", {}}},
    {"SC_rgb_rle.dcm", {"secondary_capture", {}}},
    {"no_meta_group_length.dcm", {"not_ct", {}}},
    {"priv_SQ.dcm", {"not_ct", {}}},
};

TEST_F(DicomSamples, EachDoesWhatTheReadmeSays) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto chest = read(shared_data("dicom-samples/chest_explicit_le.dcm"));
  ASSERT_TRUE(chest);
  std::size_t seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data("dicom-samples"))) {
    const std::string name = entry.path().filename();
    if (name == "README.md") continue;
    SCOPED_TRACE(name);
    const auto row = kRows.find(name);
    ASSERT_NE(row, kRows.end()) << "a sample without a row here";
    ++seen;
    const auto source = read(entry.path());
    EXPECT_EQ(source ? "" : source.error().code, row->second.refusal);
    if (!source) continue;
    std::vector<std::string> codes;
    for (const base::Problem& warning : source->warnings) codes.push_back(warning.code);
    EXPECT_EQ(codes, row->second.warnings);
    if (!row->second.is_chest) continue;
    EXPECT_EQ(source->volume.size_voxels, glm::ivec3(512, 512, 1));
    EXPECT_NEAR(source->volume.spacing_mm.x, 0.675781, 1e-9);
    EXPECT_EQ(source->volume.hu, chest->volume.hu);
    EXPECT_EQ(*std::max_element(source->volume.hu.begin(), source->volume.hu.end()), 1378);
  }
  EXPECT_EQ(seen, kRows.size());
}

TEST_F(DicomSamples, TheLossyOneIsCloseAndNotIdentical) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto plain = read(shared_data("dicom-samples/chest_explicit_le.dcm")),
             lossy = read(shared_data("dicom-samples/chest_jpeg12_lossy.dcm"));
  ASSERT_TRUE(plain && lossy);
  double sum = 0.0, sum_of_squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < plain->volume.hu.size(); ++i) {
    if (plain->volume.hu[i] < -500) continue;  // at air and padding, what is below -1024 is cut off
    const double difference = lossy->volume.hu[i] - plain->volume.hu[i];
    sum += difference;
    sum_of_squares += difference * difference;
    ++count;
  }
  ASSERT_GT(count, plain->volume.hu.size() / 10);
  const double mean = sum / static_cast<double>(count),
               rms = std::sqrt(sum_of_squares / static_cast<double>(count));
  std::printf("[ lossy      ] %.2f HU off in the mean, %.2f HU rms\n", mean, rms);
  EXPECT_LT(std::abs(mean), 2.0);  // no class boundary moves
  EXPECT_LT(rms, 15.0);            // a CT's own noise
  EXPECT_GT(rms, 0.0);
}

}  // namespace
}  // namespace seldinger::casedb
