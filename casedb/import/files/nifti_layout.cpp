// NIfTI-1 headers (nifti1.h of the NIfTI Data Format Working Group): 348 bytes, either byte order.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "casedb/import/files/file_layout.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kHeaderBytes = 348;

class NiftiHeader {
 public:
  explicit NiftiHeader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
    swapped_ = number<std::int32_t>(0) != static_cast<std::int32_t>(kHeaderBytes);
  }
  bool sound() const { return number<std::int32_t>(0) == static_cast<std::int32_t>(kHeaderBytes); }

  template <typename T>
  T number(std::size_t at) const {
    std::array<std::byte, sizeof(T)> raw;
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = bytes_[at + (swapped_ ? sizeof(T) - 1 - i : i)];
    return std::bit_cast<T>(raw);
  }
  bool swapped() const { return swapped_; }
  std::uint8_t byte(std::size_t at) const { return static_cast<std::uint8_t>(bytes_[at]); }
  bool is_single_file() const { return std::memcmp(bytes_.data() + 344, "n+1", 4) == 0; }
  glm::dvec3 srow_column(std::size_t axis) const {
    return {number<float>(280 + 4 * axis), number<float>(296 + 4 * axis), number<float>(312 + 4 * axis)};
  }

 private:
  std::vector<std::byte> bytes_;
  bool swapped_ = false;
};

Scalar scalar_of(int datatype) {
  switch (datatype) {
    case 2:
      return Scalar::uint8;
    case 256:
      return Scalar::int8;
    case 4:
      return Scalar::int16;
    case 512:
      return Scalar::uint16;
    case 8:
      return Scalar::int32;
    case 768:
      return Scalar::uint32;
    case 16:
      return Scalar::float32;
    case 64:
      return Scalar::float64;
    case 1024:
      return Scalar::int64;
    case 1280:
      return Scalar::uint64;
    default:
      return Scalar::none;  // RGB, complex, long double, bits
  }
}

void read_size(const NiftiHeader& header, FileLayout& layout, Problems& problems) {
  const int dimensions = header.number<std::int16_t>(40);
  if (dimensions < 1 || dimensions > 7) {
    problems.add("damaged", "the header's number of dimensions is out of range");
    return;
  }
  for (int axis = 1; axis <= dimensions; ++axis) {
    const int count = header.number<std::int16_t>(40 + 2 * static_cast<std::size_t>(axis));
    if (axis <= 3)
      layout.size_voxels[static_cast<std::size_t>(axis - 1)] = count;
    else if (axis == 5 && count > 1)
      problems.add("not_scalar", "a voxel holds more than one value");
    else if (count > 1)
      problems.add("not_3d", "the file holds more than one volume");
  }
  if (dimensions == 1) problems.add("not_3d", "the file holds no volume");
  layout.voxels.scalar = scalar_of(header.number<std::int16_t>(70));
  if (layout.voxels.scalar == Scalar::none) problems.add("not_scalar", "a voxel is not one plain number");
  layout.voxels.big_endian = header.swapped();
}

// The qform's rotation, of nifti1.h: from the quaternion's b, c, d, the third axis times pixdim[0].
std::array<glm::dvec3, 3> qform_axes(const NiftiHeader& header) {
  glm::dvec3 vector(header.number<float>(256), header.number<float>(260), header.number<float>(264));
  const double rest = 1.0 - glm::dot(vector, vector);
  if (rest < 1e-7) vector = glm::normalize(vector);  // half a turn, as nifti1_io.c takes it
  const double a = rest < 1e-7 ? 0.0 : std::sqrt(rest), b = vector.x, c = vector.y, d = vector.z;
  const double flip = header.number<float>(76) < 0.0F ? -1.0 : 1.0;
  return {glm::dvec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
          glm::dvec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)),
          flip * glm::dvec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b)};
}

glm::dvec3 qform_origin(const NiftiHeader& header) {
  return {header.number<float>(268), header.number<float>(272), header.number<float>(276)};
}

// Whether qform and sform put a corner of the volume more than half a millimetre apart.
bool forms_differ(const NiftiHeader& header, const FileLayout& layout) {
  const std::array<glm::dvec3, 3> axis = qform_axes(header);
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec3 apart_mm = qform_origin(header) - header.srow_column(3);
    for (std::size_t i = 0; i < 3; ++i) {
      const double voxels = (corner >> i & 1U) != 0 ? static_cast<double>(layout.size_voxels[i] - 1) : 0.0;
      apart_mm += voxels * (double{header.number<float>(80 + 4 * i)} * axis[i] - header.srow_column(i));
    }
    if (!(glm::length(apart_mm) <= 0.5)) return true;
  }
  return false;
}

// Whether one form turns right into left against the other: axes of the one are a mirror image of the other's.
bool forms_mirror(const NiftiHeader& header) {
  const std::array<glm::dvec3, 3> by_qform = qform_axes(header);
  const double q = glm::dot(glm::cross(by_qform[0], by_qform[1]), by_qform[2]);
  const double s = glm::dot(glm::cross(header.srow_column(0), header.srow_column(1)), header.srow_column(2));
  return q * s < 0.0;
}

// Which of the patient's sides change places between the forms; empty where it is none of them alone.
std::string mirrored_sides(const NiftiHeader& header) {
  static constexpr std::array<const char*, 3> kSides = {"right and left", "front and back", "head and feet"};
  const std::array<glm::dvec3, 3> by_qform = qform_axes(header);
  std::string sides;
  for (int side = 0; side < 3; ++side) {
    double along = 0.0;  // of the side's unit vector, carried from one form to the other
    for (std::size_t axis = 0; axis < 3; ++axis)
      along += by_qform[axis][side] * glm::normalize(header.srow_column(axis))[side];
    if (along < -0.5) sides += (sides.empty() ? "" : ", ") + std::string(kSides[static_cast<std::size_t>(side)]);
  }
  return sides;
}

void judge_two_forms(const NiftiHeader& header, bool both_of_the_scanner, FileLayout& layout, Problems& problems) {
  if (forms_mirror(header)) {
    const std::string sides = mirrored_sides(header);
    const std::string text = "the sform is mirrored against the qform" +
                             (sides.empty() ? std::string() : ": " + sides + " change places");
    if (both_of_the_scanner)
      problems.add("mirrored_geometry", text + ", and nobody knows which is the patient's");
    else
      layout.warnings.push_back({"mirrored_geometry", text + "; the one of the scanner's frame is taken"});
  } else if (both_of_the_scanner) {
    problems.add("no_geometry", "the header gives two places in the patient that contradict each other");
  } else {
    layout.warnings.push_back(
        {"two_geometries", "the header also gives a place in another frame, which is not used"});
  }
}

// The place in RAS, as nifti1.h has it, becomes one in LPS.
void take_geometry(const std::array<glm::dvec3, 3>& axes, const glm::dvec3& origin, FileLayout& layout) {
  const auto lps = [](const glm::dvec3& ras) { return glm::dvec3(-ras.x, -ras.y, ras.z); };
  for (std::size_t axis = 0; axis < 3; ++axis)
    layout.lps_from_voxel[static_cast<int>(axis)] = glm::dvec4(lps(axes[axis]), 0.0);
  layout.lps_from_voxel[3] = glm::dvec4(lps(origin), 1.0);
}

// The size of a voxel is pixdim's in either form: the sform's columns give its directions.
void read_geometry(const NiftiHeader& header, FileLayout& layout, Problems& problems) {
  std::array<double, 3> spacing_mm{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double mm = header.number<float>(80 + 4 * axis);
    const bool needed = layout.size_voxels[axis] > 1;
    if (!(mm > 0.0 && mm < 1000.0) && (needed || !(mm >= 0.0 && mm < 1000.0))) {
      problems.add("no_geometry", "the voxel size is not a positive number");
      return;
    }
    spacing_mm[axis] = mm;
  }
  const int unit = header.byte(123) & 7;  // XYZT_TO_SPACE: 0 unknown, 2 mm
  if (unit != 0 && unit != 2) problems.add("no_geometry", "the voxel size is not in millimetres");
  const int qform = header.number<std::int16_t>(252), sform = header.number<std::int16_t>(254);
  if (qform <= 0 && sform <= 0) {
    problems.add("no_geometry", "the header does not say how the volume lies in the patient");
    return;
  }
  // qform from byte 256, sform from 280 to 327.
  for (std::size_t at = qform > 0 ? 256 : 280; at < (sform > 0 ? 328 : 280); at += 4)
    if (!(std::abs(header.number<float>(at)) < 1e6F)) {
      problems.add("no_geometry", "the orientation holds values that are no numbers, or out of range");
      return;
    }
  if (sform > 0 && qform > 0 && forms_differ(header, layout))
    judge_two_forms(header, sform == 1 && qform == 1, layout, problems);
  std::array<glm::dvec3, 3> axes = qform_axes(header);
  const auto size_mm = [&](std::size_t axis) { return spacing_mm[axis] > 0.0 ? spacing_mm[axis] : 1.0; };
  if (sform <= 0 || (qform > 0 && sform != 1)) {  // the sform is taken when it is the scanner's, or alone
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis] *= size_mm(axis);
    take_geometry(axes, qform_origin(header), layout);
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3 a = header.srow_column(axis), b = header.srow_column((axis + 1) % 3);
    const double length_mm = glm::length(a);
    const bool orthogonal = std::abs(glm::dot(a, b)) <= 2e-3 * length_mm * glm::length(b);
    const bool right_length = std::abs(length_mm - spacing_mm[axis]) <= 0.01 * spacing_mm[axis];
    if (!(length_mm > 0.0) || !orthogonal || !(right_length || spacing_mm[axis] == 0.0)) {
      problems.add("no_geometry", "the orientation is singular, sheared, or of another size than the voxels");
      return;
    }
    axes[axis] = a / length_mm * size_mm(axis);
  }
  take_geometry(axes, header.srow_column(3), layout);
}

}  // namespace

FileLayout nifti_layout(const std::filesystem::path& file, Problems& problems) {
  FileLayout layout;
  layout.data_file = file;
  const auto start = read_bytes(file, 0, 2);
  const bool packed =
      start && start->size() == 2 && (*start)[0] == std::byte{0x1F} && (*start)[1] == std::byte{0x8B};
  std::vector<std::byte> bytes;
  if (packed)
    bytes = unpack_start(file, kHeaderBytes);
  else if (auto plain = read_bytes(file, 0, kHeaderBytes))
    bytes = std::move(*plain);
  if (bytes.size() < kHeaderBytes) {
    problems.add("truncated", "the file ends within its header");
    return layout;
  }
  const NiftiHeader header(std::move(bytes));
  if (!header.sound() || !header.is_single_file()) {
    problems.add("damaged", "the header is not that of a NIfTI-1 file");
    return layout;
  }
  read_size(header, layout, problems);
  read_geometry(header, layout, problems);
  const double offset = header.number<float>(108);
  if (!(offset >= 352.0 && offset < 1e7) || offset != std::floor(offset)) {
    problems.add("damaged", "the header does not say where the voxels begin");
    return layout;
  }
  const float slope = header.number<float>(112), intercept = header.number<float>(116);
  if (!std::isfinite(slope) || !std::isfinite(intercept))
    problems.add("bad_rescale", "the header's rescale values are no numbers");
  if (slope != 0.0F) {  // nifti1.h: 0 means that there is no rescaling
    layout.voxels.slope = slope;
    layout.voxels.intercept = intercept;
  }
  if (packed) {
    layout.packing = Packing::gzip_or_zlib;
    layout.unpacked_skip = static_cast<std::uint64_t>(offset);
  } else {
    layout.data_offset = static_cast<std::uint64_t>(offset);
  }
  return layout;
}

}  // namespace seldinger::casedb
