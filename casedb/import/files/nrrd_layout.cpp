// NRRD headers (teem.sourceforge.net/nrrd/format.html): attached or detached, raw or gzip.
#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <map>

#include "casedb/import/files/file_layout.h"

namespace seldinger::casedb {
namespace {

using Fields = std::map<std::string, std::string>;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string after_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

Fields nrrd_fields_of(const TextHeader& header) {
  Fields fields;
  for (const std::string& line : header.lines) {
    if (line.starts_with('#') || line.find(":=") != std::string::npos) continue;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    std::string name = lower(line.substr(0, colon));
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());  // "data file" and "datafile" are one
    fields[name] = after_blanks(line.substr(colon + 1));
  }
  return fields;
}

int nrrd_scalar_bytes(std::string type) {
  type = lower(std::move(type));
  static const std::map<std::string, int> kBytes = [] {
    std::map<std::string, int> bytes;
    for (const char* name : {"signed char", "int8", "int8_t", "uchar", "unsigned char", "uint8", "uint8_t"})
      bytes[name] = 1;
    for (const char* name : {"short", "short int", "signed short", "signed short int", "int16", "int16_t", "ushort",
                             "unsigned short", "unsigned short int", "uint16", "uint16_t"})
      bytes[name] = 2;
    for (const char* name :
         {"int", "signed int", "int32", "int32_t", "uint", "unsigned int", "uint32", "uint32_t", "float"})
      bytes[name] = 4;
    for (const char* name :
         {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t",
          "ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t", "double"})
      bytes[name] = 8;
    return bytes;
  }();
  const auto found = kBytes.find(type);
  return found == kBytes.end() ? 0 : found->second;
}

void read_nrrd_size(const Fields& fields, FileLayout& layout, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const auto dimension = numbers_of(field("dimension")), sizes = numbers_of(field("sizes"));
  if (dimension.size() != 1 || sizes.empty() || static_cast<double>(sizes.size()) != dimension[0]) {
    problems.add("damaged", "the header's sizes are missing or do not fit its dimension");
    return;
  }
  const auto kinds = words_of(lower(field("kinds")));
  const bool spatial = std::all_of(kinds.begin(), kinds.end(), [](const std::string& kind) {
    return kind == "domain" || kind == "space" || kind == "none" || kind == "???";
  });
  const bool in_time = std::any_of(kinds.begin(), kinds.end(),
                                   [](const std::string& kind) { return kind == "time" || kind == "list"; });
  if (!spatial && !in_time)
    problems.add("not_scalar", "a voxel holds more than one value");
  else if (sizes.size() < 2 || sizes.size() > 3 || !spatial)
    problems.add("not_3d", "the file does not hold one volume");
  for (std::size_t axis = 0; axis < std::min<std::size_t>(sizes.size(), 3); ++axis)
    layout.size_voxels[axis] = sizes[axis] >= 1.0 && sizes[axis] < 1e9 ? static_cast<std::int64_t>(sizes[axis]) : 0;
  layout.bytes_per_voxel = nrrd_scalar_bytes(field("type"));
  if (layout.bytes_per_voxel == 0) problems.add("not_scalar", "a voxel is not one plain number");
}

std::vector<double> vectors_of(std::string text) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  return numbers_of(text);
}

// Read here, since ITK 5.2 turns the directions of left-anterior-superior space but not its origin.
void read_geometry(const Fields& fields, FileLayout& layout, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const std::string space = lower(field("space"));
  glm::dvec3 turn;
  if (space == "left-posterior-superior" || space == "lps")
    turn = {1.0, 1.0, 1.0};
  else if (space == "right-anterior-superior" || space == "ras")
    turn = {-1.0, -1.0, 1.0};
  else if (space == "left-anterior-superior" || space == "las")
    turn = {1.0, -1.0, 1.0};
  else {
    problems.add("no_geometry", "the header does not say how the volume lies in the patient");
    return;
  }
  for (const std::string& unit : words_of(lower(field("spaceunits"))))
    if (unit != "\"mm\"" && unit != "mm" && unit != "\"\"")
      problems.add("no_geometry", "the voxel size is not in millimetres");
  const auto axes = vectors_of(field("spacedirections")), origin = vectors_of(field("spaceorigin"));
  const std::size_t count = numbers_of(field("sizes")).size();
  if (axes.size() != count * 3 || origin.size() != 3) {
    problems.add("no_geometry", "the space directions and origin are not three numbers for each axis");
    return;
  }
  glm::dmat4 matrix(1.0);
  for (std::size_t axis = 0; axis < count; ++axis)
    matrix[static_cast<int>(axis)] =
        glm::dvec4(turn * glm::dvec3(axes[3 * axis], axes[3 * axis + 1], axes[3 * axis + 2]), 0.0);
  if (count == 2)  // one slice, 1 mm thick
    matrix[2] = glm::dvec4(glm::normalize(glm::cross(glm::dvec3(matrix[0]), glm::dvec3(matrix[1]))), 0.0);
  matrix[3] = glm::dvec4(turn * glm::dvec3(origin[0], origin[1], origin[2]), 1.0);
  layout.lps_from_voxel = matrix;
}

}  // namespace

FileLayout nrrd_layout(const std::filesystem::path& file, Problems& problems) {
  FileLayout layout;
  const TextHeader header = read_text_header(file, "");
  if (!header.ended) {
    problems.add("truncated", "the header has no end");
    return layout;
  }
  const Fields fields = nrrd_fields_of(header);
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  read_nrrd_size(fields, layout, problems);
  if (problems.empty()) read_geometry(fields, layout, problems);
  const std::string encoding = lower(field("encoding"));
  if (encoding == "gzip" || encoding == "gz")
    layout.packing = Packing::gzip_or_zlib;
  else if (encoding != "raw")
    problems.add(encoding.empty() ? "damaged" : "unknown_format", "the voxels are not stored raw or with gzip");
  if (layout.bytes_per_voxel > 1 && field("endian").empty() && layout.packing == Packing::none && encoding == "raw")
    problems.add("damaged", "the header does not say the order of bytes");
  for (const char* skip : {"lineskip", "byteskip"})
    if (const std::string value = field(skip); !value.empty() && value != "0")
      problems.add("unknown_format", "bytes or lines are to be skipped before the voxels, which is not read");
  layout.data_file = file;
  layout.data_offset = header.data_offset;
  if (const std::string name = field("datafile"); !name.empty()) {
    layout.data_file = data_file_beside(file, name, problems);
    layout.data_offset = 0;
  } else if (header.data_offset >= file_size_bytes(file) && problems.empty()) {
    problems.add("truncated", "the file ends with its header");
  }
  return layout;
}

}  // namespace seldinger::casedb
