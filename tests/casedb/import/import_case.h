// What the tests of import share: a folder of their own, reading that must stay silent and name nobody, and volume
// files written by hand, so that what is read is compared with numbers put in.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "casedb/import/import.h"
#include "tests/fixtures/files.h"

namespace seldinger::casedb {

constexpr const char* kPlanted = "PLANTED";  // in every name, path, identifier and free text the tests write

class ImportCase : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Reads; fails the test when anything is written to standard output or error, or when a text holds kPlanted.
  base::Result<Source> read(const std::filesystem::path& source, const std::optional<std::string>& series = {});
  // The code of the refusal; "" when it is read.
  std::string refusal(const std::filesystem::path& source, const std::optional<std::string>& series = {});
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;

  std::filesystem::path folder_;  // empty at the start; kPlanted is in its path
};

std::string numbered(std::string name, int number);
std::filesystem::path shared_data(const std::string& name);
std::string gzip(const std::string& bytes);
std::string zlib_stream(const std::string& bytes);
std::string little_endian(const std::vector<std::int16_t>& values);
bool has_code(const std::vector<base::Problem>& problems, const std::string& code);
double largest_difference(const glm::dmat4& a, const glm::dmat4& b);  // NaN when there is one

// A NIfTI-1 file of int16 voxels with an sform; fields may be overwritten before it becomes bytes.
class Nifti {
 public:
  Nifti(std::array<std::int16_t, 3> size, const glm::dmat4& ras_from_voxel);
  template <typename T>
  Nifti& put(std::size_t at, T value) {
    std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T),
                header_.begin() + static_cast<std::ptrdiff_t>(at));
    return *this;
  }
  std::string bytes(const std::string& voxels) const { return header_ + voxels; }

 private:
  std::string header_ = std::string(352, '\0');
};

}  // namespace seldinger::casedb
