#include "casedb/import/dicom_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

constexpr int kMostPixels = 4096;  // along one side

bool is_one_of(const std::string& value, std::span<const char* const> terms) {
  return std::any_of(terms.begin(), terms.end(), [&](const char* term) { return value == term; });
}

// PS3.3 C.7.3.1.1.2.
constexpr std::array<const char*, 16> kPositions = {"HFP", "HFS", "HFDR", "HFDL", "FFDR", "FFDL", "FFP",  "FFS",
                                                    "LFP", "LFS", "RFP",  "RFS",  "AFDR", "AFDL", "PFDR", "PFDL"};
// The regions of PS3.16 Annex L a CT puncture case can show; any other word may be free text and is dropped.
constexpr std::array<const char*, 22> kBodyParts = {
    "ABDOMEN", "ABDOMENPELVIS", "BREAST", "CHEST",  "CHESTABDOMEN", "CHESTABDPELVIS", "CSPINE",    "HEART",
    "HIP",     "KIDNEY",        "LIVER",  "LSPINE", "LUNG",         "NECK",           "NECKCHEST", "PANCREAS",
    "PELVIS",  "SHOULDER",      "SPINE",  "THORAX", "TSPINE",       "WHOLEBODY"};

std::string plain_number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::vector<std::pair<std::string, std::string>> allowed_attributes(const DicomFile& file) {
  std::vector<std::pair<std::string, std::string>> kept = {{"modality", "CT"}};
  if (const std::string part = file.text(0x00180015); is_one_of(part, kBodyParts))
    kept.emplace_back("body_part_examined", part);
  if (const auto mm = file.numbers(0x00180050); mm.size() == 1 && mm[0] > 0.0 && mm[0] < 100.0)
    kept.emplace_back("slice_thickness_mm", plain_number(mm[0]));
  if (const auto kv = file.numbers(0x00180060); kv.size() == 1 && kv[0] >= 10.0 && kv[0] <= 500.0)
    kept.emplace_back("tube_voltage_kv", plain_number(kv[0]));
  if (const std::string position = file.text(0x00185100); is_one_of(position, kPositions))
    kept.emplace_back("patient_position", position);
  return kept;
}

bool has_part(const std::string& image_type, const char* part) {
  return ("\\" + image_type + "\\").find(std::string("\\") + part + "\\") != std::string::npos;
}

void read_geometry(const DicomFile& file, DicomSlice& slice) {
  const auto position = file.numbers(0x00200032), orientation = file.numbers(0x00200037),
             spacing = file.numbers(0x00280030);
  std::string missing;
  if (position.size() != 3) missing += " position";
  if (orientation.size() != 6) missing += " orientation";
  if (spacing.size() != 2) missing += " pixel spacing";
  if (!missing.empty()) {
    slice.problems.push_back({"no_geometry", "has no sound" + missing});
    return;
  }
  slice.position_lps_mm = {position[0], position[1], position[2]};
  slice.spacing_mm = {spacing[1], spacing[0]};  // stored as row spacing (down), column spacing (across)
  slice.row = {orientation[0], orientation[1], orientation[2]};
  slice.column = {orientation[3], orientation[4], orientation[5]};
  const double row_mm = glm::length(slice.row), column_mm = glm::length(slice.column);
  const bool orthonormal = std::abs(row_mm - 1.0) < 1e-3 && std::abs(column_mm - 1.0) < 1e-3 &&
                           std::abs(glm::dot(slice.row, slice.column)) < 1e-3;
  if (!orthonormal) {
    slice.problems.push_back({"no_geometry", "has an orientation that is not two perpendicular unit vectors"});
    return;
  }
  slice.row /= row_mm;
  slice.column = glm::normalize(slice.column - slice.row * glm::dot(slice.row, slice.column));
  const bool sane = std::min(slice.spacing_mm.x, slice.spacing_mm.y) >= volume::kMinSpacingMm &&
                    std::max(slice.spacing_mm.x, slice.spacing_mm.y) <= volume::kMaxSpacingMm &&
                    glm::length(slice.position_lps_mm) < 1e6;
  if (!sane) slice.problems.push_back({"no_geometry", "has a pixel spacing or position out of range"});
}

void read_pixel_format(const DicomFile& file, DicomSlice& slice) {
  const int samples = file.unsigned_short(0x00280002).value_or(1);
  const std::string photometric = file.text(0x00280004);
  if (samples != 1 || !(photometric.empty() || photometric.starts_with("MONOCHROME")))
    slice.problems.push_back({"rgb", "is a colour image"});
  slice.size_px = {file.unsigned_short(0x00280011).value_or(0), file.unsigned_short(0x00280010).value_or(0)};
  if (slice.size_px.x < 1 || slice.size_px.y < 1 || slice.size_px.x > kMostPixels || slice.size_px.y > kMostPixels)
    slice.problems.push_back({"bad_size", "has a width or height out of range"});
  slice.bits_allocated = file.unsigned_short(0x00280100).value_or(0);
  slice.bits_stored = file.unsigned_short(0x00280101).value_or(slice.bits_allocated);
  slice.high_bit = file.unsigned_short(0x00280102).value_or(slice.bits_stored - 1);
  slice.is_signed = file.unsigned_short(0x00280103).value_or(0) == 1;
  const bool known = (slice.bits_allocated == 8 || slice.bits_allocated == 16) && slice.bits_stored >= 1 &&
                     slice.bits_stored <= slice.bits_allocated && slice.high_bit == slice.bits_stored - 1;
  if (!known) slice.problems.push_back({"unknown_pixels", "has a pixel format that is not 8 or 16 bit"});
}

void read_values(const DicomFile& file, DicomSlice& slice) {
  const auto slope = file.numbers(0x00281053), intercept = file.numbers(0x00281052);
  // Absent is a warning; there and no number is damage.
  const bool slope_absent = file.text(0x00281053).empty(), intercept_absent = file.text(0x00281052).empty();
  slice.no_rescale = slope_absent || intercept_absent;
  if ((!slope_absent && slope.size() != 1) || (!intercept_absent && intercept.size() != 1))
    slice.problems.push_back({"bad_rescale", "has a rescale slope or intercept that is no number"});
  if (slope.size() == 1) slice.slope = slope[0];
  if (intercept.size() == 1) slice.intercept = intercept[0];
  if (slice.slope == 0.0) slice.problems.push_back({"bad_rescale", "has a rescale slope of 0"});
  if (file.values.contains(0x00283000))
    slice.problems.push_back({"bad_rescale", "has a look-up table instead of HU"});
  const std::string type = file.text(0x00281054);
  slice.not_hu = !type.empty() && type != "HU";
  if (const auto first = file.unsigned_short(0x00280120)) {
    const int last = file.unsigned_short(0x00280121).value_or(*first);
    const auto value = [&](int bits) { return slice.is_signed && bits >= 0x8000 ? bits - 0x10000 : bits; };
    slice.padding = std::minmax(value(*first), value(last));
  }
}

bool is_lossy_syntax(const std::string& syntax) {
  static constexpr std::array<const char*, 4> kLossy = {"1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51",
                                                        "1.2.840.10008.1.2.4.81", "1.2.840.10008.1.2.4.91"};
  return is_one_of(syntax, kLossy);
}

}  // namespace

DicomKind kind_of(const DicomFile& file) {
  if (file.state == DicomState::not_dicom) return DicomKind::not_dicom;
  const std::string modality = file.text(0x00080060), sop_class = file.text(0x00080016);
  if (!modality.empty() && modality != "CT") return DicomKind::other_modality;  // also when cut: not wanted anyway
  if (file.state == DicomState::truncated) return DicomKind::truncated;
  if (file.state == DicomState::damaged) return DicomKind::damaged;
  if (!file.has_pixels) return DicomKind::no_image;
  if (modality.empty()) return DicomKind::other_modality;
  if (sop_class.starts_with("1.2.840.10008.5.1.4.1.1.7")) return DicomKind::other_modality;  // secondary capture
  const auto frames = file.numbers(0x00280008);
  const bool enhanced = sop_class.starts_with("1.2.840.10008.5.1.4.1.1.2.");
  if (enhanced || (frames.size() == 1 && frames[0] > 1.0)) return DicomKind::multi_frame;
  if (has_part(file.text(0x00080008), "LOCALIZER")) return DicomKind::ct_localizer;
  return DicomKind::ct_slice;
}

DicomSlice slice_from(const DicomFile& file) {
  DicomSlice slice;
  slice.series_uid = file.text(0x0020000E);
  if (const auto number = file.numbers(0x00200011); number.size() == 1) slice.series_number = number[0];
  slice.transfer_syntax = file.transfer_syntax;
  const std::string image_type = file.text(0x00080008);
  if (file.text(0x00280301) == "YES")
    slice.problems.push_back({"burned_in", "says that text is burned into the picture"});
  if (has_part(image_type, "SCREEN SAVE")) slice.problems.push_back({"burned_in", "is a screen picture"});
  slice.secondary = has_part(image_type, "SECONDARY");
  slice.lossy = is_lossy_syntax(slice.transfer_syntax) || file.text(0x00282110) == "01";
  read_geometry(file, slice);
  read_pixel_format(file, slice);
  read_values(file, slice);
  slice.attributes = allowed_attributes(file);
  return slice;
}

}  // namespace seldinger::casedb
