// Tests of the DICOM writer: ITK reads back what was written, voxel by voxel and in the same place.
#include "casedb/export/dicom_series.h"

#include <gdcmReader.h>
#include <gdcmStringFilter.h>
#include <gtest/gtest.h>
#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageSeriesReader.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>
#include <set>

#include "sim/base/failure.h"
#include "sim/base/rng.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;
using Image = itk::Image<std::int16_t, 3>;

// An empty folder of this test alone.
fs::path fresh_folder(const std::string& name) {
  return fixtures::fresh_test_folder(fs::path("casedb_export") / name);
}

volume::Volume filled(glm::ivec3 size, glm::dvec3 spacing_mm, const glm::dmat3& direction, glm::dvec3 origin_mm) {
  volume::Volume made = volume::make_volume(size, spacing_mm, direction, origin_mm);
  base::Rng rng(7);
  for (auto& hu : made.hu) hu = static_cast<std::int16_t>(-1024.0 + 4095.0 * rng.uniform());
  made.hu.front() = volume::kAirHu;
  made.hu.back() = 32767;
  return made;
}

volume::Volume axial() {
  return filled({13, 9, 6}, {0.7, 0.9, 2.5}, glm::dmat3(1.0), {-101.5, 33.25, -512.0});
}

volume::Volume oblique() {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1.0, -2.0, 0.7)));
  return filled({8, 11, 5}, {0.7421875, 0.7421875, 1.25}, glm::dmat3(turn), {12.3456789, -98.7654321, 1234.5678});
}

Image::Pointer read_back(const fs::path& folder) {
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(true);
  names->SetDirectory(folder.string());
  const auto series = names->GetSeriesUIDs();
  EXPECT_EQ(series.size(), 1U);
  const auto reader = itk::ImageSeriesReader<Image>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetFileNames(series.front()));
  reader->Update();
  return reader->GetOutput();
}

void expect_same(const volume::Volume& expected, Image& image) {
  const auto size = image.GetLargestPossibleRegion().GetSize();
  for (unsigned axis = 0; axis < 3; ++axis)
    ASSERT_EQ(size[axis], static_cast<std::size_t>(expected.size_voxels[static_cast<int>(axis)]));
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 last = expected.size_voxels - 1;
    const glm::ivec3 index((corner & 1) != 0 ? last.x : 0, (corner & 2) != 0 ? last.y : 0,
                           (corner & 4) != 0 ? last.z : 0);
    Image::PointType p;
    image.TransformIndexToPhysicalPoint(Image::IndexType{{index.x, index.y, index.z}}, p);
    const glm::dvec4 there = expected.lps_from_voxel * glm::dvec4(glm::dvec3(index), 1.0);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p[static_cast<unsigned>(axis)], there[axis], 1e-8);
  }
  const std::int16_t* voxel = image.GetBufferPointer();
  EXPECT_TRUE(std::equal(expected.hu.begin(), expected.hu.end(), voxel));
}

std::string tag_of(const fs::path& path, std::uint16_t group, std::uint16_t element) {
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  EXPECT_TRUE(reader.Read());
  gdcm::StringFilter filter;
  filter.SetFile(reader.GetFile());
  std::string value = filter.ToString(gdcm::Tag(group, element));
  while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
  return value;
}

TEST(DicomSeries, an_axial_volume_is_read_back_by_itk_as_it_was) {
  const fs::path folder = fresh_folder("axial");
  const auto written = write_dicom_series(axial(), {"test"}, folder);
  ASSERT_TRUE(written.has_value());
  EXPECT_EQ(*written, 6);
  expect_same(axial(), *read_back(folder));
}

TEST(DicomSeries, an_oblique_volume_is_read_back_by_itk_as_it_was) {
  const fs::path folder = fresh_folder("oblique");
  ASSERT_TRUE(write_dicom_series(oblique(), {"test"}, folder).has_value());
  expect_same(oblique(), *read_back(folder));
}

TEST(DicomSeries, two_writes_give_the_same_bytes) {
  const fs::path first = fresh_folder("first"), second = fresh_folder("second");
  ASSERT_TRUE(write_dicom_series(oblique(), {"test"}, first).has_value());
  ASSERT_TRUE(write_dicom_series(oblique(), {"test"}, second).has_value());
  for (int number = 1; number <= 5; ++number) {
    const std::string name = "slice_000" + std::to_string(number) + ".dcm";
    const std::string bytes = fixtures::whole_file(first / name);
    EXPECT_GT(bytes.size(), 8U * 11U * 2U);
    EXPECT_EQ(bytes, fixtures::whole_file(second / name));
  }
}

TEST(DicomSeries, uids_are_of_the_uuid_root_distinct_and_change_with_the_content) {
  const fs::path folder = fresh_folder("uids"), changed_folder = fresh_folder("uids_changed");
  volume::Volume changed = axial();
  ++changed.hu[40];
  ASSERT_TRUE(write_dicom_series(axial(), {"test"}, folder).has_value());
  ASSERT_TRUE(write_dicom_series(changed, {"test"}, changed_folder).has_value());
  std::set<std::string> uids;
  for (const fs::path& from : {folder, changed_folder}) {
    for (const std::uint16_t element : std::initializer_list<std::uint16_t>{0x000d, 0x000e, 0x0052}) {
      const std::string uid = tag_of(from / "slice_0001.dcm", 0x0020, element);
      EXPECT_EQ(uid, tag_of(from / "slice_0006.dcm", 0x0020, element));
      uids.insert(uid);
    }
    for (int number = 1; number <= 6; ++number)
      uids.insert(tag_of(from / ("slice_000" + std::to_string(number) + ".dcm"), 0x0008, 0x0018));
  }
  EXPECT_EQ(uids.size(), 18U);
  for (const std::string& uid : uids) {
    EXPECT_EQ(uid.rfind("2.25.", 0), 0U);
    EXPECT_LE(uid.size(), 64U);
    EXPECT_GT(uid.size(), 25U);
    EXPECT_NE(uid[5], '0');
    EXPECT_EQ(uid.find_first_not_of("0123456789", 5), std::string::npos);
  }
}

TEST(DicomSeries, slices_say_what_a_ct_slice_must_say_and_no_date) {
  const fs::path folder = fresh_folder("tags");
  ASSERT_TRUE(write_dicom_series(axial(), {"Torso \\ phantom"}, folder).has_value());
  const fs::path slice = folder / "slice_0003.dcm";
  EXPECT_EQ(tag_of(slice, 0x0002, 0x0010), "1.2.840.10008.1.2.1");
  EXPECT_EQ(tag_of(slice, 0x0008, 0x0016), "1.2.840.10008.5.1.4.1.1.2");
  EXPECT_EQ(tag_of(slice, 0x0002, 0x0003), tag_of(slice, 0x0008, 0x0018));
  EXPECT_EQ(tag_of(slice, 0x0008, 0x0060), "CT");
  EXPECT_EQ(tag_of(slice, 0x0008, 0x103e), "Torso   phantom");
  EXPECT_EQ(tag_of(slice, 0x0010, 0x0010), "SELDINGER^PHANTOM");
  EXPECT_EQ(tag_of(slice, 0x0010, 0x0020), "PHANTOM");
  EXPECT_EQ(tag_of(slice, 0x0018, 0x5100), "HFS");
  EXPECT_EQ(tag_of(slice, 0x0018, 0x0050), "2.5");
  EXPECT_EQ(tag_of(slice, 0x0020, 0x0013), "3");
  EXPECT_EQ(tag_of(slice, 0x0020, 0x0032), "-101.5\\33.25\\-507");
  EXPECT_EQ(tag_of(slice, 0x0020, 0x0037), "1\\0\\0\\0\\1\\0");
  EXPECT_EQ(tag_of(slice, 0x0028, 0x0030), "0.9\\0.7");
  EXPECT_EQ(tag_of(slice, 0x0028, 0x1052), "0");
  EXPECT_EQ(tag_of(slice, 0x0028, 0x1053), "1");
  EXPECT_EQ(tag_of(slice, 0x0008, 0x0020), "");
  EXPECT_EQ(tag_of(slice, 0x0010, 0x0030), "");
}

TEST(DicomSeries, decimal_strings_hold_at_most_sixteen_characters) {
  const fs::path folder = fresh_folder("decimals");
  ASSERT_TRUE(write_dicom_series(oblique(), {"test"}, folder).has_value());
  for (const std::uint16_t element : std::initializer_list<std::uint16_t>{0x0032, 0x0037}) {
    std::istringstream values(tag_of(folder / "slice_0004.dcm", 0x0020, element));
    int count = 0;
    for (std::string value; std::getline(values, value, '\\'); ++count) {
      EXPECT_LE(value.size(), 16U);
      EXPECT_GE(value.size(), 12U);
    }
    EXPECT_EQ(count, element == 0x0032 ? 3 : 6);
  }
}

TEST(DicomSeries, a_long_description_is_cut_between_characters) {
  const fs::path folder = fresh_folder("description");
  std::string description;
  for (int i = 0; i < 80; ++i) description += "\xc3\xa4";  // ä
  ASSERT_TRUE(write_dicom_series(axial(), {description}, folder).has_value());
  EXPECT_EQ(tag_of(folder / "slice_0001.dcm", 0x0008, 0x103e), description.substr(0, 128));
}

TEST(DicomSeries, left_handed_and_sheared_volumes_are_refused_and_leave_nothing) {
  const fs::path folder = fresh_folder("refused");
  glm::dmat3 mirrored(1.0);
  mirrored[2][2] = -1.0;
  const auto left =
      write_dicom_series(filled({3, 3, 3}, glm::dvec3(1.0), mirrored, glm::dvec3(0.0)), {"t"}, folder);
  ASSERT_FALSE(left.has_value());
  EXPECT_EQ(left.error().code, "left_handed");
  volume::Volume tilted = axial();
  tilted.lps_from_voxel[2][1] += 0.5;
  const auto sheared = write_dicom_series(tilted, {"t"}, folder);
  ASSERT_FALSE(sheared.has_value());
  EXPECT_EQ(sheared.error().code, "sheared");
  EXPECT_TRUE(fs::is_empty(folder));
}

// Runs the writer, expects Failure("disk") and text without a path.
void expect_disk_failure(const volume::Volume& volume, const fs::path& folder) {
  try {
    (void)write_dicom_series(volume, {"test"}, folder);
    FAIL() << "no failure";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "disk");
    EXPECT_EQ(std::string(failure.what()).find(folder.string()), std::string::npos);
  }
}

TEST(DicomSeries, a_full_disk_is_a_failure_and_leaves_nothing) {
  const fs::path folder = fresh_folder("full");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;  // less than a slice
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_disk_failure(axial(), folder);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(DicomSeries, a_failure_halfway_removes_the_slices_before) {
  const fs::path folder = fresh_folder("halfway");
  fs::create_directories(folder / "slice_0004.dcm");  // no file can be opened here
  expect_disk_failure(axial(), folder);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_TRUE(fs::is_directory(folder / "slice_0004.dcm"));
}

TEST(DicomSeries, a_missing_folder_is_a_failure) {
  expect_disk_failure(axial(), fresh_folder("missing") / "not_there");
}

}  // namespace
}  // namespace seldinger::casedb
