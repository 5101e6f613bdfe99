#include "casedb/import/dicom/dicom_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "casedb/import/dicom/frame_pixels.h"
#include "casedb/import/dicom/image_kind.h"
#include "casedb/import/dicom/terms.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

constexpr int kMostPixels = 4096;  // along one side

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
  slice.monochrome1 = photometric == "MONOCHROME1";
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
  // PS3.3 §C.11.1.1.2: other quantities than attenuation. Unspecified (US), modified (HU_MOD) and private ones may
  // be HU, and only warn.
  static constexpr std::array<const char*, 6> kOtherQuantities = {"OD", "MGML", "Z_EFF", "ED", "EDW", "PCT"};
  if (is_term(type, kOtherQuantities)) slice.problems.push_back({"not_hu", "holds another quantity than HU"});
  if (const auto first = file.unsigned_short(0x00280120)) {
    const int last = file.unsigned_short(0x00280121).value_or(*first);
    const auto value = [&](int bits) { return slice.is_signed && bits >= 0x8000 ? bits - 0x10000 : bits; };
    slice.padding = std::minmax(value(*first), value(last));
  }
}

bool is_lossy_syntax(const std::string& syntax) {
  static constexpr std::array<const char*, 4> kLossy = {"1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51",
                                                        "1.2.840.10008.1.2.4.81", "1.2.840.10008.1.2.4.91"};
  return is_term(syntax, kLossy);
}

}  // namespace

std::size_t PixelPlace::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [offset, length] : pieces) sum += length;
  return sum;
}

DicomKind kind_of(const DicomFile& file) {
  if (file.state == DicomState::not_dicom) return DicomKind::not_dicom;
  // PS3.4 §B.5: the classes of CT images; what is another class is no CT image even when its modality is CT.
  std::string sop_class = file.text(0x00080016);
  if (sop_class.empty()) sop_class = file.text(0x00020002);
  static const std::string kStorage = "1.2.840.10008.5.1.4.1.1.";
  const auto is_class = [&](const char* number) {
    return sop_class == kStorage + number || sop_class.starts_with(kStorage + number + ".");
  };
  if (sop_class == "1.2.840.10008.1.3.10") return DicomKind::directory;
  if (is_class("7")) return DicomKind::secondary_capture;
  if (is_class("30")) return DicomKind::parametric_map;
  if (is_class("104")) return DicomKind::encapsulated_document;
  const std::string modality = file.text(0x00080060);
  if ((!modality.empty() && modality != "CT") || (!sop_class.empty() && !is_class("2")))
    return DicomKind::other_object;  // also when cut: not wanted anyway
  switch (file.state) {
    case DicomState::truncated:
      return DicomKind::truncated;
    case DicomState::damaged:
      return DicomKind::damaged;
    case DicomState::bomb:
      return DicomKind::bomb;
    case DicomState::too_large:
      return DicomKind::too_large;
    case DicomState::whole:
    case DicomState::not_dicom:
      break;
  }
  if (!file.has_pixels) return DicomKind::no_image;
  if (modality.empty()) return DicomKind::other_object;
  const bool enhanced = is_class("2") && sop_class != kStorage + "2";
  if ((enhanced || frame_count(file) != 1) && (file.frames.empty() || file.frames.size() != frame_count(file)))
    return DicomKind::frames_without_place;
  if (has_part(file.text(0x00080008), "LOCALIZER")) return DicomKind::localizer;
  return DicomKind::ct;
}

std::size_t frame_count(const DicomFile& file) {
  if (file.text(0x00280008).empty()) return 1;
  const auto frames = file.numbers(0x00280008);
  return frames.size() == 1 && frames[0] >= 1.0 && frames[0] <= 1e6 ? static_cast<std::size_t>(frames[0]) : 0;
}

DicomSlice slice_from(const DicomFile& header) {
  DicomSlice slice;
  slice.series_uid = header.text(0x0020000E);
  if (const auto number = header.numbers(0x00200011); number.size() == 1) slice.series_number = number[0];
  slice.identity = identity_of(header);
  slice.transfer_syntax = header.transfer_syntax;
  slice.wrong_syntax = header.wrong_syntax;
  const std::string image_type = image_type_of(header);
  if (header.text(0x00280301) == "YES")
    slice.problems.push_back({"burned_in", "says that text is burned into the picture"});
  if (has_part(image_type, "SCREEN SAVE")) slice.problems.push_back({"burned_in", "is a screen picture"});
  const ImageKind kind = image_kind_of(header);
  if (kind == ImageKind::projection)
    slice.problems.push_back({"derived", "is a projection or a computed map, not a slice of HU"});
  if (kind == ImageKind::material)
    slice.problems.push_back({"derived", "is a map of a material, as of iodine, not a slice of HU"});
  slice.is_virtual = kind == ImageKind::virtual_hu;
  slice.described = kind == ImageKind::described;
  slice.secondary = has_part(image_type, "SECONDARY");
  slice.lossy = is_lossy_syntax(slice.transfer_syntax) || header.text(0x00282110) == "01";
  for (const double ratio : header.numbers(0x00282112)) slice.lossy_ratio = std::max(slice.lossy_ratio, ratio);
  if (const auto mm = header.numbers(0x00180050); mm.size() == 1 && mm[0] > 0.0 && mm[0] < 100.0)
    slice.thickness_mm = mm[0];
  read_geometry(header, slice);
  read_pixel_format(header, slice);
  read_values(header, slice);
  slice.attributes = allowed_attributes(header);
  slice.says_head = says_head(header);
  return slice;
}

std::vector<DicomSlice> slices_of(const DicomFile& file, const std::filesystem::path& path, int& localizers) {
  std::vector<DicomSlice> slices;
  std::optional<base::Result<std::vector<PixelPlace>>> places;  // the same question for every frame
  for (std::size_t frame = 0; frame < std::max<std::size_t>(file.frames.size(), 1); ++frame) {
    const DicomFile header = file.frames.empty() ? DicomFile() : frame_header(file, frame);
    DicomSlice slice = slice_from(file.frames.empty() ? file : header);
    if (has_part(header.text(0x00089007), "LOCALIZER")) {
      ++localizers;
      continue;
    }
    slice.file = path;
    if (slices.empty()) slice.dropped = dropped_elements(file);  // once, however many frames
    if (slice.problems.empty()) {
      const auto pixels = static_cast<std::size_t>(slice.size_px.x) * static_cast<std::size_t>(slice.size_px.y);
      if (!places) places = frame_pixels(file, pixels * static_cast<std::size_t>(slice.bits_allocated / 8));
      if (*places)
        slice.pixels = (**places)[frame];
      else
        slice.problems.push_back({places->error().code, places->error().text});
    }
    slices.push_back(std::move(slice));
  }
  return slices;
}

}  // namespace seldinger::casedb
