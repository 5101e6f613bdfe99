// MetaImage headers (itk.org/Wiki/ITK/MetaIO/Documentation): .mha with the voxels behind, .mhd with a file beside.
#include <map>

#include "casedb/import/files/file_layout.h"

namespace seldinger::casedb {
namespace {

using Fields = std::map<std::string, std::string>;

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

int scalar_bytes(const std::string& type) {
  static const std::map<std::string, int> kBytes = {{"MET_CHAR", 1},   {"MET_UCHAR", 1},     {"MET_SHORT", 2},
                                                    {"MET_USHORT", 2}, {"MET_INT", 4},       {"MET_UINT", 4},
                                                    {"MET_FLOAT", 4},  {"MET_LONG_LONG", 8}, {"MET_ULONG_LONG", 8},
                                                    {"MET_DOUBLE", 8}, {"MET_LONG", 4},      {"MET_ULONG", 4}};
  const auto found = kBytes.find(type);
  return found == kBytes.end() ? 0 : found->second;
}

void check_geometry(const Fields& fields, std::size_t axes, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const std::string spacing_text = field("ElementSpacing").empty() ? field("ElementSize") : field("ElementSpacing");
  const auto spacing = numbers_of(spacing_text);
  bool sound = spacing.size() >= axes;
  for (const double mm : spacing) sound = sound && mm > 0.0 && mm < 1000.0;
  if (!sound) problems.add("no_geometry", "the voxel size is not a positive number along each axis");
  for (const char* name : {"Offset", "Origin", "Position"})
    if (const std::string text = field(name); !text.empty() && numbers_of(text).size() < axes)
      problems.add("no_geometry", "the position is not a number along each axis");
  for (const char* name : {"TransformMatrix", "Orientation", "Rotation"}) {
    const std::string text = field(name);
    if (!text.empty() && numbers_of(text).size() != axes * axes)
      problems.add("no_geometry", "the orientation is not a square of numbers");
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
  layout.bytes_per_voxel = scalar_bytes(field("ElementType"));
  if (layout.bytes_per_voxel == 0) problems.add("not_scalar", "a voxel is not one plain number");
  // The reader knows none of these three; taking the numbers as they are would give other HU or millimetres.
  if (const std::string slope = field("ElementToIntensityFunctionSlope");
      !slope.empty() && numbers_of(slope) != std::vector<double>{1.0})
    problems.add("bad_rescale", "the voxels are to be scaled, which is not read");
  if (const std::string offset = field("ElementToIntensityFunctionOffset");
      !offset.empty() && numbers_of(offset) != std::vector<double>{0.0})
    problems.add("bad_rescale", "the voxels are to be shifted, which is not read");
  if (const std::string unit = field("DistanceUnits"); !unit.empty() && unit != "mm" && unit != "?")
    problems.add("no_geometry", "the voxel size is not in millimetres");
  check_geometry(fields, sizes.size(), problems);
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
  read_size(fields, layout, problems);
  if (const std::string skip = field("HeaderSize"); !skip.empty() && skip != "0")
    problems.add("unknown_format", "bytes are to be skipped before the voxels, which is not read");
  if (const std::string binary = field("BinaryData"); !binary.empty() && !is_true(binary))
    problems.add("unknown_format", "the voxels are stored as text, which is not read");
  if (is_true(field("CompressedData"))) layout.packing = Packing::gzip_or_zlib;
  if (const auto size = numbers_of(field("CompressedDataSize")); size.size() == 1 && size[0] > 0.0)
    layout.packed_limit = static_cast<std::uint64_t>(size[0]);
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
