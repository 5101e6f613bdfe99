#include "tests/casedb/import/import_case.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "tests/fixtures/folders.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {

void ImportCase::SetUp() {
  folder_ = fixtures::fresh_test_folder(std::filesystem::path("casedb_import") / kPlanted);
}

void ImportCase::TearDown() {
  std::filesystem::remove_all(folder_);
}

base::Result<Source> ImportCase::read(const std::filesystem::path& source,
                                      const std::optional<std::string>& series) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  auto result = read_source(source, series);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  std::string said;
  if (result) {
    for (const auto& [name, value] : result->attributes) said += name + value;
    for (const base::Problem& warning : result->warnings) said += warning.code + warning.text;
    EXPECT_LE(result->attributes.size(), 25U);
  } else {
    said = result.error().code + result.error().text;
    for (const base::Problem& finding : result.error().findings) said += finding.code + finding.text;
  }
  EXPECT_EQ(said.find(kPlanted), std::string::npos) << said;
  EXPECT_EQ(said.find('/'), std::string::npos) << said;
  return result;
}

std::string ImportCase::refusal(const std::filesystem::path& source, const std::optional<std::string>& series) {
  const auto result = read(source, series);
  return result ? "" : result.error().code;
}

std::filesystem::path ImportCase::write(const std::string& name, const std::string& bytes) const {
  const std::filesystem::path file = folder_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::string numbered(std::string name, int number) {
  return name.append(std::to_string(number));
}

std::filesystem::path shared_data(const std::string& name) {
  return fixtures::shared_data_dir() / name;
}

namespace {

std::string deflated(const std::string& bytes, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string in = bytes, out(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace

std::string gzip(const std::string& bytes) {
  return deflated(bytes, MAX_WBITS + 16);
}

std::string zlib_stream(const std::string& bytes) {
  return deflated(bytes, MAX_WBITS);
}

std::string little_endian(const std::vector<std::int16_t>& values) {
  std::string bytes;
  for (const std::int16_t value : values) {
    const unsigned bits = static_cast<std::uint16_t>(value);
    bytes.push_back(static_cast<char>(bits & 0xFF));
    bytes.push_back(static_cast<char>(bits >> 8));
  }
  return bytes;
}

bool has_code(const std::vector<base::Problem>& problems, const std::string& code) {
  return std::any_of(problems.begin(), problems.end(), [&](const base::Problem& p) { return p.code == code; });
}

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
  double largest = 0.0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      const double difference = std::abs(a[column][row] - b[column][row]);
      if (!(difference <= largest)) largest = difference;
    }
  return largest;
}

Nifti::Nifti(std::array<std::int16_t, 3> size, const glm::dmat4& ras_from_voxel) {
  put<std::int32_t>(0, 348).put<std::int16_t>(40, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put<std::int16_t>(42 + 2 * axis, size[axis]);
    const glm::dvec3 column(ras_from_voxel[static_cast<int>(axis)]);
    put<float>(80 + 4 * axis, static_cast<float>(glm::length(column)));
    for (int c = 0; c < 4; ++c)
      put<float>(280 + 16 * axis + 4 * static_cast<std::size_t>(c),
                 static_cast<float>(ras_from_voxel[c][static_cast<int>(axis)]));
  }
  for (std::size_t axis = 3; axis < 7; ++axis) put<std::int16_t>(42 + 2 * axis, 1).put<float>(80 + 4 * axis, 1.0F);
  put<float>(76, 1.0F).put<std::int16_t>(70, 4).put<std::int16_t>(72, 16).put<float>(108, 352.0F);
  put<float>(112, 1.0F).put<char>(123, 2).put<std::int16_t>(254, 1);
  put(344, std::array<char, 4>{'n', '+', '1', '\0'});
  const std::string description = std::string(kPlanted) + " description";
  std::copy(description.begin(), description.end(), header_.begin() + 148);
}

}  // namespace seldinger::casedb
