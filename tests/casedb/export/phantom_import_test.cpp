// Tests that the built-in phantom comes through the door of every patient: written as DICOM, imported, its skin
// found.
#include <gtest/gtest.h>

#include <filesystem>

#include "casedb/export/dicom_series.h"
#include "casedb/import/import.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/phantom.h"
#include "tests/fixtures/folders.h"

namespace seldinger::casedb {
namespace {

TEST(PhantomImport, the_written_phantom_is_imported_without_a_warning_and_voxel_for_voxel) {
  const std::filesystem::path folder = fixtures::fresh_test_folder("casedb_export");
  const volume::Phantom phantom = volume::make_phantom();
  const auto written = write_dicom_series(phantom.volume, {"Seldinger built-in torso phantom"}, folder);
  ASSERT_TRUE(written.has_value());
  EXPECT_EQ(*written, phantom.volume.size_voxels.z);
  const auto source = read_source(folder);
  ASSERT_TRUE(source.has_value()) << source.error().code;
  EXPECT_TRUE(source->warnings.empty());
  EXPECT_EQ(source->slices_used, phantom.volume.size_voxels.z);
  EXPECT_EQ(source->volume.size_voxels, phantom.volume.size_voxels);
  EXPECT_EQ(source->volume.hu, phantom.volume.hu);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      EXPECT_NEAR(source->volume.lps_from_voxel[column][row], phantom.volume.lps_from_voxel[column][row], 1e-9);
  std::filesystem::remove_all(folder);
}

TEST(PhantomImport, its_body_mask_is_exactly_its_labelled_voxels) {
  const volume::Phantom phantom = volume::make_phantom();
  const std::vector<std::uint8_t> body = body_mask(phantom.volume);
  ASSERT_EQ(body.size(), phantom.labels.label.size());
  std::size_t differ = 0;
  for (std::size_t at = 0; at < body.size(); ++at)
    differ += (body[at] != 0) != (phantom.labels.label[at] != 0) ? 1 : 0;
  EXPECT_EQ(differ, 0U);
}

}  // namespace
}  // namespace seldinger::casedb
