#include "casedb/export/dicom_series.h"

#include <gdcmDataSet.h>
#include <gdcmFile.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <span>
#include <sstream>
#include <vector>

#include "casedb/export/uid.h"
#include "sim/base/failure.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kCtImageStorage = "1.2.840.10008.5.1.4.1.1.2";
constexpr std::size_t kDecimalString = 16, kLongString = 64;  // PS3.5 §6.2: bytes of a DS, characters of an LO
constexpr double kRightAngle = 1e-6;                          // |cosine| between axes taken as perpendicular

// A UID from a hash.
std::string uid_from(std::uint64_t content, std::uint64_t role) {
  std::array<std::byte, 16> bits{};
  for (std::size_t half = 0; half < 2; ++half) {
    const std::uint64_t hash = base::hash_combine(base::hash_combine(content, role), std::uint64_t{half + 1});
    for (std::size_t i = 0; i < 8; ++i) bits[8 * half + i] = static_cast<std::byte>(hash >> (56 - 8 * i));
  }
  return uid_of(bits);
}

enum UidRole : std::uint64_t { kStudy, kSeries, kFrameOfReference, kFirstInstance };

std::uint64_t content_hash(const volume::Volume& volume, const std::string& description) {
  std::uint64_t hash = base::hash_bytes(std::as_bytes(std::span(volume.hu)));
  hash = base::hash_combine(hash, base::hash_bytes(std::as_bytes(std::span(description))));
  for (int axis = 0; axis < 3; ++axis) {
    hash = base::hash_combine(hash, static_cast<std::uint64_t>(volume.size_voxels[axis]));
    hash = base::hash_combine(hash, volume.spacing_mm[axis]);
  }
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) hash = base::hash_combine(hash, volume.lps_from_voxel[column][row]);
  return hash;
}

// As many digits as a decimal string may hold.
std::string decimal(double value) {
  if (value == 0.0) return "0";
  char text[64];
  auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  for (int digits = 16; end - text > static_cast<std::ptrdiff_t>(kDecimalString); --digits)
    end = std::to_chars(std::begin(text), std::end(text), value, std::chars_format::general, digits).ptr;
  return {text, end};
}

std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text.push_back('\\');
    text += decimal(value);
  }
  return text;
}

// UTF-8 cut to a number of characters; control characters and backslashes (DICOM's separator) become spaces.
std::string long_string(const std::string& text) {
  std::string out;
  std::size_t characters = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool starts = (byte & 0xc0U) != 0x80U;
    if (starts && ++characters > kLongString) break;
    out.push_back(byte < 0x20 || byte == 0x7f || c == '\\' ? ' ' : c);
  }
  return out;
}

class DataSet {
 public:
  explicit DataSet(gdcm::DataSet& to) : to_(to) {}

  void put(std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, std::string text) {
    if (text.size() % 2 != 0) text.push_back(vr == gdcm::VR::UI ? '\0' : ' ');
    put_bytes(group, element, vr, text.data(), text.size());
  }
  void put_short(std::uint16_t group, std::uint16_t element, std::uint16_t value) {
    const char bytes[2] = {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)};
    put_bytes(group, element, gdcm::VR::US, bytes, sizeof bytes);
  }
  void put_bytes(std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, const char* bytes,
                 std::size_t size) {
    gdcm::DataElement made(gdcm::Tag(group, element));
    made.SetVR(vr);
    made.SetByteValue(bytes, gdcm::VL(static_cast<std::uint32_t>(size)));
    to_.Replace(made);
  }

 private:
  gdcm::DataSet& to_;
};

struct Series {
  const volume::Volume& volume;
  std::string description;
  std::uint64_t content = 0;
};

// What all slices share. Empty: type 2 attributes that a made-up person does not have; dates among them, since a
// clock would change the bytes.
void put_series(DataSet& to, const Series& series) {
  using VR = gdcm::VR;
  to.put(0x0008, 0x0005, VR::CS, "ISO_IR 192");
  to.put(0x0008, 0x0008, VR::CS, "ORIGINAL\\PRIMARY\\AXIAL");
  to.put(0x0008, 0x0016, VR::UI, kCtImageStorage);
  to.put(0x0008, 0x0020, VR::DA, "");
  to.put(0x0008, 0x0030, VR::TM, "");
  to.put(0x0008, 0x0050, VR::SH, "");
  to.put(0x0008, 0x0060, VR::CS, "CT");
  to.put(0x0008, 0x0070, VR::LO, "Seldinger");
  to.put(0x0008, 0x0090, VR::PN, "");
  to.put(0x0008, 0x103e, VR::LO, series.description);
  to.put(0x0010, 0x0010, VR::PN, "SELDINGER^PHANTOM");
  to.put(0x0010, 0x0020, VR::LO, "PHANTOM");
  to.put(0x0010, 0x0030, VR::DA, "");
  to.put(0x0010, 0x0040, VR::CS, "");
  to.put(0x0018, 0x0060, VR::DS, "");
  to.put(0x0018, 0x5100, VR::CS, "HFS");
  to.put(0x0020, 0x000d, VR::UI, uid_from(series.content, kStudy));
  to.put(0x0020, 0x000e, VR::UI, uid_from(series.content, kSeries));
  to.put(0x0020, 0x0010, VR::SH, "");
  to.put(0x0020, 0x0011, VR::IS, "1");
  to.put(0x0020, 0x0012, VR::IS, "");
  to.put(0x0020, 0x0052, VR::UI, uid_from(series.content, kFrameOfReference));
  to.put(0x0020, 0x1040, VR::LO, "");
  to.put_short(0x0028, 0x0002, 1);
  to.put(0x0028, 0x0004, VR::CS, "MONOCHROME2");
  to.put_short(0x0028, 0x0100, 16);
  to.put_short(0x0028, 0x0101, 16);
  to.put_short(0x0028, 0x0102, 15);
  to.put_short(0x0028, 0x0103, 1);
  to.put(0x0028, 0x1050, VR::DS, "40");
  to.put(0x0028, 0x1051, VR::DS, "400");
  to.put(0x0028, 0x1052, VR::DS, "0");
  to.put(0x0028, 0x1053, VR::DS, "1");
  to.put(0x0028, 0x1054, VR::LO, "HU");
}

std::string bytes_of_slice(const Series& series, int k) {
  using VR = gdcm::VR;
  const volume::Volume& volume = series.volume;
  gdcm::Writer writer;
  gdcm::File& file = writer.GetFile();
  DataSet to(file.GetDataSet());
  put_series(to, series);

  glm::dvec3 axis[3], origin_mm(volume.lps_from_voxel[3]);
  for (int column = 0; column < 3; ++column) axis[column] = glm::dvec3(volume.lps_from_voxel[column]);
  const glm::dvec3 row = glm::normalize(axis[0]), down = glm::normalize(axis[1]);
  const glm::dvec3 corner_mm = origin_mm + static_cast<double>(k) * axis[2];
  to.put(0x0008, 0x0018, VR::UI, uid_from(series.content, kFirstInstance + static_cast<std::uint64_t>(k)));
  to.put(0x0018, 0x0050, VR::DS, decimal(glm::length(axis[2])));
  to.put(0x0020, 0x0013, VR::IS, std::to_string(k + 1));
  to.put(0x0020, 0x0032, VR::DS, decimals({corner_mm.x, corner_mm.y, corner_mm.z}));
  to.put(0x0020, 0x0037, VR::DS, decimals({row.x, row.y, row.z, down.x, down.y, down.z}));
  to.put_short(0x0028, 0x0010, static_cast<std::uint16_t>(volume.size_voxels.y));
  to.put_short(0x0028, 0x0011, static_cast<std::uint16_t>(volume.size_voxels.x));
  to.put(0x0028, 0x0030, VR::DS, decimals({glm::length(axis[1]), glm::length(axis[0])}));  // between rows, columns

  const auto pixels = std::as_bytes(std::span(volume.hu).subspan(
      volume.index(0, 0, k), volume.index(0, 0, 1)));  // little-endian, as sim/base/hash.cpp asserts
  std::string pixel_bytes(pixels.size(), '\0');
  std::transform(pixels.begin(), pixels.end(), pixel_bytes.begin(),
                 [](std::byte b) { return static_cast<char>(std::to_integer<unsigned char>(b)); });
  to.put_bytes(0x7fe0, 0x0010, VR::OW, pixel_bytes.data(), pixel_bytes.size());

  file.GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  std::ostringstream out;
  writer.SetStream(out);
  CHECK(writer.Write());
  return out.str();
}

// Files as they come; gone again unless kept.
class WrittenFiles {
 public:
  explicit WrittenFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  WrittenFiles(const WrittenFiles&) = delete;
  WrittenFiles& operator=(const WrittenFiles&) = delete;
  ~WrittenFiles() {
    std::error_code ignored;
    for (const std::filesystem::path& path : paths_) std::filesystem::remove(path, ignored);
  }

  void write(int number, const std::string& bytes) {
    char name[32];
    std::snprintf(name, sizeof name, "slice_%04d.dcm", number);
    const std::filesystem::path path = folder_ / name;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    if (out) paths_.push_back(path);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw base::Failure("disk", "a slice could not be written");
  }
  void keep() noexcept { paths_.clear(); }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> paths_;
};

}  // namespace

base::Result<int> write_dicom_series(const volume::Volume& volume, const SeriesText& text,
                                     const std::filesystem::path& folder) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(volume.lps_from_voxel[0]));
  const glm::dvec3 y = glm::normalize(glm::dvec3(volume.lps_from_voxel[1]));
  const glm::dvec3 z = glm::normalize(glm::dvec3(volume.lps_from_voxel[2]));
  if (!(glm::dot(glm::cross(x, y), z) > 0.0))
    return base::Error{"left_handed", "the volume's axes are left-handed"};
  if (!(std::abs(glm::dot(x, y)) < kRightAngle && std::abs(glm::dot(y, z)) < kRightAngle &&
        std::abs(glm::dot(z, x)) < kRightAngle))
    return base::Error{"sheared", "the volume's axes are not perpendicular"};
  if (volume.size_voxels.x > 65535 || volume.size_voxels.y > 65535)
    return base::Error{"too_large", "a slice has more rows or columns than DICOM can say"};

  Series series{volume, long_string(text.description)};
  series.content = content_hash(volume, series.description);
  WrittenFiles files(folder);
  for (int k = 0; k < volume.size_voxels.z; ++k) files.write(k + 1, bytes_of_slice(series, k));
  files.keep();
  return volume.size_voxels.z;
}

}  // namespace seldinger::casedb
