// MetaImage headers (itk.org/Wiki/ITK/MetaIO/Documentation): .mha with the voxels behind, .mhd with a file beside.
#include <algorithm>
#include <initializer_list>
#include <map>

#include "casedb/import/files/file_layout.h"

namespace seldinger::casedb {
namespace {

using Fields = std::map<std::string, std::string>;

constexpr std::size_t kLongestKey = 254;  // MetaIO keeps 255 bytes for one (metaUtils.h), with the zero at its end

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

Fields fields_of(const TextHeader& header) {
  Fields fields;
  for (const std::string& line : header.lines)
    if (const std::size_t equals = line.find('='); equals != std::string::npos)
      fields[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  return fields;
}

bool is_true(const std::string& value) {
  return !value.empty() && (value[0] == 'T' || value[0] == 't' || value[0] == '1');
}

Scalar scalar_of(const std::string& type) {
  static const std::map<std::string, Scalar> kScalars = {
      {"MET_CHAR", Scalar::int8},     {"MET_UCHAR", Scalar::uint8},    {"MET_SHORT", Scalar::int16},
      {"MET_USHORT", Scalar::uint16}, {"MET_INT", Scalar::int32},      {"MET_UINT", Scalar::uint32},
      {"MET_LONG", Scalar::int32},    {"MET_ULONG", Scalar::uint32},   {"MET_LONG_LONG", Scalar::int64},
      {"MET_FLOAT", Scalar::float32}, {"MET_DOUBLE", Scalar::float64}, {"MET_ULONG_LONG", Scalar::uint64}};
  const auto found = kScalars.find(type);
  return found == kScalars.end() ? Scalar::none : found->second;
}

// The one value that a field has under any of its names; "" when it has none.
std::string one_of(const Fields& fields, std::initializer_list<const char*> names, Problems& problems) {
  std::string value;
  for (const char* name : names) {
    const auto found = fields.find(name);
    if (found == fields.end() || found->second.empty()) continue;
    if (!value.empty() && numbers_of(found->second) != numbers_of(value))
      problems.add("no_geometry", "the header says the same thing twice, and differently");
    value = found->second;
  }
  return value;
}

// A row of the matrix is the direction of an axis; of one slice the third stands on the other two.
void read_geometry(const Fields& fields, std::size_t axes, FileLayout& layout, Problems& problems) {
  if (axes < 2) return;
  const auto spacing = numbers_of(one_of(fields, {"ElementSpacing", "ElementSize"}, problems));
  bool sound = spacing.size() >= axes;
  for (const double mm : spacing) sound = sound && mm > 0.0 && mm < 1000.0;
  if (!sound) {
    problems.add("no_geometry", "the voxel size is not a positive number along each axis");
    return;
  }
  const std::string place = one_of(fields, {"Offset", "Origin", "Position"}, problems),
                    turn = one_of(fields, {"TransformMatrix", "Orientation", "Rotation"}, problems);
  const auto origin = numbers_of(place), matrix = numbers_of(turn);
  if (!place.empty() && origin.size() < axes)
    problems.add("no_geometry", "the position is not a number along each axis");
  if (!turn.empty() && matrix.size() != axes * axes)
    problems.add("no_geometry", "the orientation is not a square of numbers");
  if (!problems.empty()) return;
  for (std::size_t axis = 0; axis < std::min<std::size_t>(axes, 3); ++axis) {
    const int column = static_cast<int>(axis);
    for (std::size_t row = 0; row < std::min<std::size_t>(axes, 3); ++row)
      layout.lps_from_voxel[column][static_cast<int>(row)] =
          spacing[axis] * (matrix.empty() ? (row == axis ? 1.0 : 0.0) : matrix[axis * axes + row]);
    if (!origin.empty()) layout.lps_from_voxel[3][column] = origin[axis];
  }
}

void read_size(const Fields& fields, FileLayout& layout, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const auto dimension = numbers_of(field("NDims")), sizes = numbers_of(field("DimSize"));
  if (dimension.size() != 1 || sizes.empty() || static_cast<double>(sizes.size()) != dimension[0]) {
    problems.add("damaged", "the header's sizes are missing or do not fit its dimension");
    return;
  }
  if (const auto channels = numbers_of(field("ElementNumberOfChannels"));
      channels.size() == 1 && channels[0] != 1.0)
    problems.add("not_scalar", "a voxel holds more than one value");
  for (std::size_t axis = 0; axis < sizes.size(); ++axis)
    if (axis < 3)
      layout.size_voxels[axis] =
          sizes[axis] >= 1.0 && sizes[axis] < 1e9 ? static_cast<std::int64_t>(sizes[axis]) : 0;
    else if (sizes[axis] != 1.0)
      problems.add("not_3d", "the file holds more than one volume");
  if (sizes.size() == 1) problems.add("not_3d", "the file holds no volume");
  layout.voxels.scalar = scalar_of(field("ElementType"));
  if (layout.voxels.scalar == Scalar::none) problems.add("not_scalar", "a voxel is not one plain number");
  // Taking the numbers as they are would give other HU or millimetres.
  if (const std::string slope = field("ElementToIntensityFunctionSlope");
      !slope.empty() && numbers_of(slope) != std::vector<double>{1.0})
    problems.add("bad_rescale", "the voxels are to be scaled, which is not read");
  if (const std::string offset = field("ElementToIntensityFunctionOffset");
      !offset.empty() && numbers_of(offset) != std::vector<double>{0.0})
    problems.add("bad_rescale", "the voxels are to be shifted, which is not read");
  if (const std::string unit = field("DistanceUnits"); !unit.empty() && unit != "mm" && unit != "?")
    problems.add("no_geometry", "the voxel size is not in millimetres");
  read_geometry(fields, sizes.size(), layout, problems);
}

}  // namespace

FileLayout metaimage_layout(const std::filesystem::path& file, Problems& problems) {
  FileLayout layout;
  const TextHeader header = read_text_header(file, "ElementDataFile");
  if (!header.ended) {
    problems.add("truncated", "the header has no end");
    return layout;
  }
  const Fields fields = fields_of(header);
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  for (const auto& [key, value] : fields)
    if (key.size() > kLongestKey) {
      problems.add("damaged", "a key of the header is longer than the format's can be");
      return layout;
    }
  read_size(fields, layout, problems);
  if (const std::string skip = field("HeaderSize"); !skip.empty() && skip != "0")
    problems.add("unknown_format", "bytes are to be skipped before the voxels, which is not read");
  if (!is_true(field("BinaryData")))  // MetaIO's default is text
    problems.add("unknown_format", "the voxels are stored as text, which is not read");
  for (const char* order : {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"})
    if (fields.contains(order)) layout.voxels.big_endian = is_true(fields.at(order));
  if (is_true(field("CompressedData"))) {
    layout.packing = Packing::gzip_or_zlib;
    // Where packed voxels end nobody else says; writers of MetaImage give it always (metaImage.cxx).
    const auto size = numbers_of(field("CompressedDataSize"));
    if (size.size() == 1 && size[0] > 0.0 && size[0] < 1e15)
      layout.packed_limit = static_cast<std::uint64_t>(size[0]);
    else
      problems.add("damaged", "the header does not say how many bytes the packed voxels take (CompressedDataSize)");
  }
  const std::string name = field("ElementDataFile");
  if (name == "LOCAL" || name == "Local" || name == "local") {
    layout.data_file = file;
    layout.data_offset = header.data_offset;
  } else if (name.empty() || words_of(name).size() != 1 || name == "LIST") {
    problems.add("bad_data_file", "the header names voxels that do not lie in one file beside it");
  } else {
    layout.data_file = data_file_beside(file, name, problems);
  }
  return layout;
}

}  // namespace seldinger::casedb
