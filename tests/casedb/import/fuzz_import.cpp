#include "tests/casedb/import/fuzz_import.h"

#include <cstdio>
#include <fstream>
#include <set>

#include "casedb/import/jail/jail.h"
#include "tests/casedb/import/dicom_writer.h"
#include "tests/casedb/import/import_case.h"
#include "tests/casedb/import/mutate.h"
#include "tests/casedb/import/packed_frame.h"
#include "tests/casedb/import/peak_memory.h"
#include "tests/fixtures/cpu_time.h"

namespace seldinger::casedb {
namespace {

using Seeds = std::vector<std::pair<std::string, std::string>>;  // ending, bytes

std::vector<std::string> plain_dicom() {
  std::vector<std::string> all;
  for (const TestSyntax syntax :
       {TestSyntax::implicit_le, TestSyntax::explicit_le, TestSyntax::explicit_be, TestSyntax::deflated}) {
    all.push_back(TestDicom::ct_slice({4, 3}).bytes(syntax));
    all.push_back(enhanced_ct({4, 3}, {{0, 0, 0}, {0, 0, 2}, {0, 0, 6}}).bytes(syntax));
  }
  TestDicom nested = TestDicom().u16(0x00280010, "US", 99);
  for (int i = 0; i < 5; ++i) nested = TestDicom().sequence(0x00081140, {nested, nested}, i % 2 == 0);
  all.push_back(TestDicom::ct_slice({4, 3}).sequence(0x00081115, {nested}, true).bytes());
  return all;
}

std::vector<std::string> packed_dicom() {
  std::vector<std::string> all;
  constexpr glm::ivec2 kSize{24, 20};
  std::vector<int> stored;
  for (int i = 0; i < kSize.x * kSize.y; ++i) stored.push_back((i * 37) % 1500 - 1000);
  for (const char* syntax : {"1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.57",
                             "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"}) {
    const std::string frame = packed_frame(syntax, kSize, stored);
    all.push_back(TestDicom::ct_slice(kSize).fragments(syntax, {frame}).bytes());
    all.push_back(enhanced_ct(kSize, {{0, 0, 0}, {0, 0, 2}}).fragments(syntax, {frame, frame}, {0, 1}).bytes());
  }
  return all;
}

Seeds seeds_of(FuzzedReader reader) {
  const std::string voxels = little_endian(std::vector<std::int16_t>(64, 5));
  Nifti nifti({4, 4, 4}, glm::dmat4(1.0));
  switch (reader) {
    case FuzzedReader::dicom: {
      Seeds all;
      for (const std::string& bytes : dicom_seeds()) all.emplace_back(".dcm", bytes);
      return all;
    }
    case FuzzedReader::nifti:
      return {{".nii", nifti.bytes(voxels)},
              {".nii.gz", nifti.bytes(voxels)},  // packed when it was mutated, or mutated again
              {".nii", nifti.put<std::int16_t>(252, 1).put<float>(112, 2.0F).bytes(voxels)}};
    case FuzzedReader::metaimage: {
      const std::string head =
          "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
          "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
          "ElementSpacing = 1 1 1\nDimSize = 4 4 4\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
      const std::string stream = zlib_stream(voxels);
      std::string packed = head;
      packed.replace(packed.find("CompressedData = False"), 22,
                     "CompressedData = True\nCompressedDataSize = " + std::to_string(stream.size()));
      return {{".mha", head + voxels}, {".mha", packed + stream}};
    }
    case FuzzedReader::nrrd: {
      const std::string head =
          "NRRD0004\n# made here\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
          "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
          "encoding: raw\nspace origin: (0,0,0)\nkey:=value\n\n";
      std::string packed = head;
      packed.replace(packed.find("raw"), 3, "gzip");
      return {{".nrrd", head + voxels}, {".nrrd", packed + gzip(voxels)}};
    }
  }
  return {};
}

void put(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

std::vector<std::string> dicom_seeds() {
  std::vector<std::string> all = plain_dicom();
  for (std::string& bytes : packed_dicom()) all.push_back(std::move(bytes));
  return all;
}

void fuzz_import(const std::filesystem::path& folder, FuzzedReader reader, std::uint64_t seed, int rounds) {
  constexpr std::size_t kMostBytes = 1 << 16;
  constexpr double kSlowestSeconds = 5.0;
  const Seeds all = seeds_of(reader);
  std::vector<std::string> others;
  for (const auto& [ending, bytes] : all) others.push_back(bytes);
  // Half of the mutated DICOM files lie beside two sound slices.
  std::filesystem::create_directories(folder / "series");
  for (int k = 1; k < 3; ++k)
    put(folder / "series" / numbered("s", k), TestDicom::ct_slice({4, 3}).at({0, 0, 2.0 * k}).bytes());

  std::mt19937_64 random(seed);
  std::set<std::string> codes;
  int read = 0, died = 0, round = 0;
  std::size_t most_bytes = 0;
  double slowest = 0.0;  // of the processor's time
  const PeakMemory memory;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  bool good = true;
  for (; good && round < rounds; ++round) {
    const auto& [ending, whole] = all[random() % all.size()];
    std::string bytes = mutated(whole, others, kMostBytes, random);
    if (ending == ".nii.gz") {
      bytes = gzip(bytes);
      if (random() % 2 == 0) bytes = mutated(bytes, others, kMostBytes, random);
    }
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
        died += source.error().code == "reader_died" ? 1 : 0;
      }
    } catch (...) {
      good = false;
    }
    const double seconds = fixtures::cpu_s() - from_s;
    slowest = std::max(slowest, seconds + last_jail_use().cpu_s);
    const JailUse jail = last_jail_use();
    most_bytes = std::max(most_bytes, jail.peak_bytes);
    good = good && seconds + jail.cpu_s < kSlowestSeconds &&
           jail.peak_bytes <= allowed_bytes(jail.announced_bytes) &&
           memory.bytes() < allowed_bytes(jail.announced_bytes);
    if (!good) put(folder.parent_path() / "failed", bytes);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(good) << "round " << round << ", seed " << seed << ", " << slowest << " s, " << most_bytes
                    << " bytes";
  std::string said;
  for (const std::string& code : codes) said += ' ' + code;
  std::printf("[ fuzz       ] %d files, %d read, %d readers died, slowest %.3f s, %.1f MB at most, refused as:%s\n",
              round, read, died, slowest, static_cast<double>(most_bytes) / 1048576.0, said.c_str());
  EXPECT_EQ(died, 0) << "contained, and yet a fault of ours or of a library";
  // A driver whose files are all refused at the door proves nothing. A hundred rounds meet fewer of the reasons.
  EXPECT_GT(read, round / 50);
  EXPECT_GE(codes.size(), rounds < 500 ? 3U : 5U);
}

}  // namespace seldinger::casedb
