// Which fields of a NIfTI, NRRD or MetaImage header did not enter a case: all but the volume's shape and place.
#include "casedb/import/dropped_fields.h"

#include <algorithm>
#include <array>

#include "casedb/import/dicom/allow_list.h"
#include "casedb/import/files/file_layout.h"

namespace seldinger::casedb {
namespace {

// nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h: texts of fixed length.
struct TextField {
  const char* name;
  std::size_t at, size;
};
constexpr TextField kNiftiTexts[] = {{"data_type", 4, 10},
                                     {"db_name", 14, 18},
                                     {"descrip", 148, 80},
                                     {"aux_file", 228, 24},
                                     {"intent_name", 328, 16}};

Dropped nifti_field(const char* name) {
  Dropped field{"nifti", name, "not_on_the_list", 1};
  return field;
}

std::vector<Dropped> of_nifti(const std::filesystem::path& file) {
  std::vector<std::byte> header = read_bytes(file, 0, 352).value_or(std::vector<std::byte>());
  const bool packed = header.size() >= 2 && header[0] == std::byte{0x1F} && header[1] == std::byte{0x8B};
  if (packed) header = unpack_start(file, 352);
  std::vector<Dropped> dropped;
  if (header.size() < 352) return dropped;
  for (const TextField& field : kNiftiTexts)
    if (header[field.at] != std::byte{0}) dropped.push_back(nifti_field(field.name));
  if (header[348] != std::byte{0}) dropped.push_back(nifti_field("extensions"));
  return dropped;
}

bool is_used(const std::string& line, std::span<const char* const> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return line.starts_with(name); });
}

// Names of keys may be anything, a person's too: they are only counted.
std::vector<Dropped> of_text(const std::filesystem::path& file, FileFormat format) {
  static constexpr const char* kNrrd[] = {"NRRD",      "type:",     "dimension:", "space",      "sizes:",
                                          "spacings:", "encoding:", "endian:",    "kinds:",     "byte skip",
                                          "line skip", "byteskip",  "lineskip",   "data file",  "datafile",
                                          "axis mins", "axismins",  "centers:",   "centerings:"};
  static constexpr const char* kMeta[] = {"ObjectType",
                                          "NDims",
                                          "BinaryData",
                                          "CompressedData",
                                          "TransformMatrix",
                                          "Offset",
                                          "Origin",
                                          "Position",
                                          "Orientation",
                                          "Rotation",
                                          "ElementSpacing",
                                          "ElementSize",
                                          "DimSize",
                                          "ElementType",
                                          "ElementDataFile",
                                          "HeaderSize",
                                          "ElementByteOrderMSB",
                                          "AnatomicalOrientation",
                                          "CenterOfRotation",
                                          "ElementNumberOfChannels"};
  const bool nrrd = format == FileFormat::nrrd;
  const TextHeader header = read_text_header(file, nrrd ? "" : "ElementDataFile");
  Dropped other{nrrd ? "nrrd" : "metaimage", "", "not_on_the_list", 0};
  for (const std::string& line : header.lines) {
    const bool pair = nrrd && line.find(":=") != std::string::npos;
    const bool used = nrrd ? !pair && is_used(line, kNrrd) : is_used(line, kMeta);
    if (!line.empty() && !used) ++other.count;
  }
  return other.count == 0 ? std::vector<Dropped>() : std::vector<Dropped>{other};
}

}  // namespace

std::vector<Dropped> dropped_fields(const std::filesystem::path& file, FileFormat format) {
  return format == FileFormat::nifti ? of_nifti(file) : of_text(file, format);
}

}  // namespace seldinger::casedb
