// NRRD headers (teem.sourceforge.net/nrrd/format.html): attached or detached, raw or gzip.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <map>
#include <optional>

#include "casedb/import/files/file_layout.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

using Fields = std::map<std::string, std::string>;

std::string after_blanks(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// Every field of the format, without blanks.
bool is_known_field(const std::string& name) {
  static constexpr std::array<const char*, 33> kFields = {
      "content",     "number",           "type",           "blocksize",   "dimension",
      "space",       "spacedimension",   "sizes",          "spacings",    "axismins",
      "axismin",     "thicknesses",      "axismaxs",       "axismax",     "centers",
      "centerings",  "labels",           "units",          "kinds",       "min",
      "max",         "oldmin",           "oldmax",         "datafile",    "endian",
      "encoding",    "lineskip",         "byteskip",       "sampleunits", "spaceunits",
      "spaceorigin", "measurementframe", "spacedirections"};
  return std::find(kFields.begin(), kFields.end(), name) != kFields.end();
}

// Nothing when a line is neither a comment, a key and its value, nor a field of the format.
std::optional<Fields> nrrd_fields_of(const TextHeader& header) {
  Fields fields;
  for (std::size_t i = 1; i < header.lines.size(); ++i) {  // behind the magic
    const std::string& line = header.lines[i];
    if (line.empty() || line.starts_with('#') || line.find(":=") != std::string::npos) continue;
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) return std::nullopt;
    std::string name = base::lower(line.substr(0, colon));
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());  // "data file" and "datafile" are one
    if (!is_known_field(name)) return std::nullopt;
    fields[name] = after_blanks(line.substr(colon + 1));
  }
  return fields;
}

Scalar nrrd_scalar_of(const std::string& type) {
  static const std::map<std::string, Scalar> kScalars = [] {
    using Names = std::initializer_list<const char*>;
    std::map<std::string, Scalar> scalars;
    const auto add = [&](Scalar scalar, Names names) {
      for (const char* name : names) scalars[name] = scalar;
    };
    add(Scalar::int8, {"signed char", "int8", "int8_t"});
    add(Scalar::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"});
    add(Scalar::int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"});
    add(Scalar::uint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"});
    add(Scalar::int32, {"int", "signed int", "int32", "int32_t"});
    add(Scalar::uint32, {"uint", "unsigned int", "uint32", "uint32_t"});
    add(Scalar::int64,
        {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"});
    add(Scalar::uint64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"});
    add(Scalar::float32, {"float"});
    add(Scalar::float64, {"double"});
    return scalars;
  }();
  const auto found = kScalars.find(base::lower(type));
  return found == kScalars.end() ? Scalar::none : found->second;
}

void read_nrrd_size(const Fields& fields, FileLayout& layout, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const auto dimension = numbers_of(field("dimension")), sizes = numbers_of(field("sizes"));
  if (dimension.size() != 1 || sizes.empty() || static_cast<double>(sizes.size()) != dimension[0]) {
    problems.add("damaged", "the header's sizes are missing or do not fit its dimension");
    return;
  }
  const auto kinds = words_of(base::lower(field("kinds")));
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
  layout.voxels.scalar = nrrd_scalar_of(field("type"));
  if (layout.voxels.scalar == Scalar::none) problems.add("not_scalar", "a voxel is not one plain number");
}

std::vector<double> vectors_of(std::string text) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  return numbers_of(text);
}

void read_geometry(const Fields& fields, FileLayout& layout, Problems& problems) {
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  const std::string space = base::lower(field("space"));
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
  for (const std::string& unit : words_of(base::lower(field("spaceunits"))))
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
  const auto read = nrrd_fields_of(header);
  if (!read) {
    problems.add("damaged", "the header holds a line that the format does not have");
    return layout;
  }
  const Fields& fields = *read;
  const auto field = [&](const char* name) { return fields.contains(name) ? fields.at(name) : std::string(); };
  read_nrrd_size(fields, layout, problems);
  if (problems.empty()) read_geometry(fields, layout, problems);
  const std::string encoding = base::lower(field("encoding"));
  if (encoding == "gzip" || encoding == "gz")
    layout.packing = Packing::gzip_or_zlib;
  else if (encoding != "raw")
    problems.add(encoding.empty() ? "damaged" : "unknown_format", "the voxels are not stored raw or with gzip");
  layout.voxels.big_endian = base::lower(field("endian")) == "big";
  if (bytes_of(layout.voxels.scalar) > 1 && field("endian").empty() && layout.packing == Packing::none &&
      encoding == "raw")
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
