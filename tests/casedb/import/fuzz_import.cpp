#include "tests/casedb/import/fuzz_import.h"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <set>

#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"
#include "tests/casedb/import/mutate.h"
#include "tests/casedb/import/packed_frame.h"
#include "tests/casedb/import/peak_memory.h"
#include "tests/fixtures/cpu_time.h"

namespace seldinger::casedb {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Small files of every kind: every way through the reader begins in one of them.
std::vector<std::pair<std::string, std::string>> seeds() {
  std::vector<std::pair<std::string, std::string>> all;
  const auto dicom = [&](const std::string& bytes) { all.emplace_back(".dcm", bytes); };
  for (const TestSyntax syntax :
       {TestSyntax::implicit_le, TestSyntax::explicit_le, TestSyntax::explicit_be, TestSyntax::deflated}) {
    dicom(TestDicom::ct_slice({4, 3}).bytes(syntax));
    dicom(enhanced_ct({4, 3}, {{0, 0, 0}, {0, 0, 2}, {0, 0, 6}}).bytes(syntax));
  }
  TestDicom nested = TestDicom().u16(0x00280010, "US", 99);
  for (int i = 0; i < 5; ++i) nested = TestDicom().sequence(0x00081140, {nested, nested}, i % 2 == 0);
  dicom(TestDicom::ct_slice({4, 3}).sequence(0x00081115, {nested}, true).bytes());
  constexpr glm::ivec2 kSize{24, 20};
  std::vector<int> stored;
  for (int i = 0; i < kSize.x * kSize.y; ++i) stored.push_back((i * 37) % 1500 - 1000);
  for (const char* syntax : {"1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.57",
                             "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"}) {
    const std::string frame = packed_frame(syntax, kSize, stored);
    dicom(TestDicom::ct_slice(kSize).fragments(syntax, {frame}).bytes());
    dicom(enhanced_ct(kSize, {{0, 0, 0}, {0, 0, 2}}).fragments(syntax, {frame, frame}, {0, 1}).bytes());
  }
  const std::vector<std::int16_t> voxels(64, 5);
  const std::string nifti = Nifti({4, 4, 4}, glm::dmat4(1.0)).bytes(little_endian(voxels));
  all.emplace_back(".nii", nifti);
  all.emplace_back(".nii.gz", gzip(nifti));
  all.emplace_back(".mha",
                   "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                   "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
                   "ElementSpacing = 1 1 1\nDimSize = 4 4 4\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                       little_endian(voxels));
  all.emplace_back(".nrrd",
                   "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
                   "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
                   "encoding: raw\nspace origin: (0,0,0)\n\n" +
                       little_endian(voxels));
  return all;
}

void put(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void fuzz_import(const std::filesystem::path& folder, std::uint64_t seed, const FuzzLimits& limits) {
  constexpr std::size_t kMostBytes = 1 << 16;
  constexpr double kSlowestSeconds = 5.0;
  const auto all = seeds();
  std::vector<std::string> others;
  for (const auto& [ending, bytes] : all) others.push_back(bytes);
  // Half of the mutated DICOM files lie beside two sound slices.
  std::filesystem::create_directories(folder / "series");
  for (int k = 1; k < 3; ++k)
    put(folder / "series" / numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());

  std::mt19937_64 random(seed);
  std::set<std::string> codes;
  int read = 0, rounds = 0;
  double slowest = 0.0;  // of the processor's time
  const auto begin = Clock::now();
  const PeakMemory memory;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  bool good = true;
  for (; good && rounds < limits.rounds && seconds_since(begin) < limits.seconds; ++rounds) {
    const auto& [ending, whole] = all[random() % all.size()];
    const std::string bytes = mutated(whole, others, kMostBytes, random);
    const bool in_series = ending == ".dcm" && random() % 2 == 0;
    const std::filesystem::path file = in_series ? folder / "series" / "mutated" : folder / ("mutated" + ending);
    put(file, bytes);
    const double from_s = fixtures::cpu_s();
    try {
      const auto source = read_source(in_series ? folder / "series" : file);
      if (source) {
        ++read;
        const glm::ivec3 size = source->volume.size_voxels;
        good = size.x > 0 && size.y > 0 && size.z > 0 &&
               source->volume.hu.size() == static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                                               static_cast<std::size_t>(size.z) &&
               largest_difference(source->volume.lps_from_voxel, glm::dmat4(0.0)) < 1e7;  // finite
      } else {
        codes.insert(source.error().code);
        good = !source.error().code.empty();
      }
    } catch (...) {
      good = false;
    }
    const double seconds = fixtures::cpu_s() - from_s;
    slowest = std::max(slowest, seconds);
    good = good && seconds < kSlowestSeconds && memory.bytes() < allowed_bytes(kMostBytes);
    if (!good) put(folder.parent_path() / "failed", bytes);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(good) << "round " << rounds << ", seed " << seed << ", " << slowest << " s, " << memory.bytes()
                    << " bytes";
  std::string said;
  for (const std::string& code : codes) said += ' ' + code;
  std::printf("[ fuzz       ] %d files, %d read, slowest %.3f s, %.1f MB at most, refused as:%s\n", rounds, read,
              slowest, static_cast<double>(memory.bytes()) / 1048576.0, said.c_str());
  EXPECT_TRUE(!good || (read > 0 && !codes.empty())) << "some are read and some refused, however few there were";
  if (good && rounds > 1000) {  // a driver whose files are all refused at the door proves nothing
    EXPECT_GT(read, rounds / 20);
    EXPECT_GT(codes.size(), 10U);
  }
}

}  // namespace seldinger::casedb
