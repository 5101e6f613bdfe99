#include "casedb/import/files/read_file.h"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkOutputWindow.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

#include "casedb/import/files/file_layout.h"
#include "casedb/import/files/quiet_standard_error.h"

namespace seldinger::casedb {
namespace {

// ITK reports to a window, which on this platform is standard error.
class SilentWindow : public itk::OutputWindow {
 public:
  using Self = SilentWindow;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericOutputText(const char*) override {}
  void DisplayDebugText(const char*) override {}
};

itk::ImageIOBase::Pointer reader_of(FileFormat format) {
  switch (format) {
    case FileFormat::nifti:
      return itk::NiftiImageIO::New().GetPointer();
    case FileFormat::nrrd:
      return itk::NrrdImageIO::New().GetPointer();
    case FileFormat::metaimage:
      return itk::MetaImageIO::New().GetPointer();
  }
  return nullptr;
}

FileLayout layout_of(const std::filesystem::path& file, FileFormat format, Problems& problems) {
  switch (format) {
    case FileFormat::nifti:
      return nifti_layout(file, problems);
    case FileFormat::nrrd:
      return nrrd_layout(file, problems);
    case FileFormat::metaimage:
      return metaimage_layout(file, problems);
  }
  return {};
}

// An axis of one voxel that the reader left out stands perpendicular on the others, 1 mm thick.
glm::dmat4 lps_from_voxel(const itk::ImageIOBase& reader) {
  glm::dmat4 matrix(1.0);
  for (unsigned axis = 0; axis < std::min(reader.GetNumberOfDimensions(), 3U); ++axis) {
    const std::vector<double> cosines = reader.GetDirection(axis);
    const int column = static_cast<int>(axis);
    matrix[column] = glm::dvec4(0.0);
    for (unsigned row = 0; row < std::min<std::size_t>(cosines.size(), 3); ++row)
      matrix[column][static_cast<int>(row)] = cosines[row] * reader.GetSpacing(axis);
    matrix[3][column] = reader.GetOrigin(axis);
  }
  return matrix;
}

// Perpendicular axes of a sound length; the library's volumes have no others.
void check_axes(volume::Volume& volume, Problems& problems) {
  std::array<glm::dvec3, 3> axis;
  bool sound = true;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 column(volume.lps_from_voxel[i]);
    volume.spacing_mm[i] = glm::length(column);
    sound = sound && volume.spacing_mm[i] >= volume::kMinSpacingMm &&
            volume.spacing_mm[i] <= volume::kMaxSpacingMm && std::abs(volume.lps_from_voxel[3][i]) < 1e6;
    axis[static_cast<std::size_t>(i)] = column / volume.spacing_mm[i];
  }
  for (std::size_t i = 0; i < 3; ++i) sound = sound && std::abs(glm::dot(axis[i], axis[(i + 1) % 3])) < 2e-3;
  if (!sound) problems.add("no_geometry", "the axes are not perpendicular, or sizes are out of range");
}

template <typename T>
std::int16_t hu_from(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return static_cast<std::int16_t>(
        std::lround(std::clamp(static_cast<double>(value), double{volume::kAirHu}, 32767.0)));
  else if constexpr (std::is_signed_v<T>)
    return static_cast<std::int16_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(value), volume::kAirHu, 32767));
  else
    return static_cast<std::int16_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(value), 32767));
}

template <typename T>
void read_as(itk::ImageIOBase& reader, std::vector<std::int16_t>& hu, Problems& problems) {
  if constexpr (std::is_same_v<T, short>) {  // the usual case needs no second copy
    reader.Read(hu.data());
    for (std::int16_t& value : hu) value = std::max(value, volume::kAirHu);
  } else {
    std::vector<T> values(hu.size());
    reader.Read(values.data());
    if constexpr (std::is_floating_point_v<T>)
      if (!std::all_of(values.begin(), values.end(), [](T value) { return std::isfinite(value); })) {
        problems.add("not_finite", "voxels hold values that are no numbers");
        return;
      }
    std::transform(values.begin(), values.end(), hu.begin(), hu_from<T>);
  }
}

void read_voxels(itk::ImageIOBase& reader, std::vector<std::int16_t>& hu, Problems& problems) {
  using IO = itk::ImageIOBase;
  switch (reader.GetComponentType()) {
    case IO::UCHAR:
      return read_as<unsigned char>(reader, hu, problems);
    case IO::CHAR:
      return read_as<signed char>(reader, hu, problems);
    case IO::USHORT:
      return read_as<unsigned short>(reader, hu, problems);
    case IO::SHORT:
      return read_as<short>(reader, hu, problems);
    case IO::UINT:
      return read_as<unsigned int>(reader, hu, problems);
    case IO::INT:
      return read_as<int>(reader, hu, problems);
    case IO::ULONG:
      return read_as<unsigned long>(reader, hu, problems);
    case IO::LONG:
      return read_as<long>(reader, hu, problems);
    case IO::ULONGLONG:
      return read_as<unsigned long long>(reader, hu, problems);
    case IO::LONGLONG:
      return read_as<long long>(reader, hu, problems);
    case IO::FLOAT:
      return read_as<float>(reader, hu, problems);
    case IO::DOUBLE:
      return read_as<double>(reader, hu, problems);
    default:
      problems.add("not_scalar", "a voxel is not one plain number");
  }
}

bool same_size(const itk::ImageIOBase& reader, const FileLayout& layout) {
  for (unsigned axis = 0; axis < std::max(3U, reader.GetNumberOfDimensions()); ++axis) {
    const std::int64_t found =
        axis < reader.GetNumberOfDimensions() ? static_cast<std::int64_t>(reader.GetDimensions(axis)) : 1;
    if (found != (axis < 3 ? layout.size_voxels[axis] : 1)) return false;
  }
  return true;
}

}  // namespace

base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format) {
  itk::OutputWindow::SetInstance(SilentWindow::New());
  Problems problems;
  const FileLayout layout = layout_of(file, format, problems);
  check_layout(layout, problems);
  if (!problems.empty()) return problems.error();

  Source source;
  source.warnings = layout.warnings;
  volume::Volume& volume = source.volume;
  for (int axis = 0; axis < 3; ++axis)
    volume.size_voxels[axis] = static_cast<int>(layout.size_voxels[static_cast<std::size_t>(axis)]);
  const QuietStandardError quiet;
  try {
    const itk::ImageIOBase::Pointer reader = reader_of(format);
    reader->SetFileName(file.string());
    reader->ReadImageInformation();
    if (reader->GetNumberOfComponents() != 1) {
      problems.add("not_scalar", "a voxel holds more than one value");
    } else if (!same_size(*reader, layout)) {
      problems.add("damaged", "the header's sizes contradict each other");
    } else {
      volume.lps_from_voxel = layout.lps_from_voxel ? *layout.lps_from_voxel : lps_from_voxel(*reader);
      check_axes(volume, problems);
    }
    if (problems.empty()) {
      itk::ImageIORegion whole(reader->GetNumberOfDimensions());
      for (unsigned axis = 0; axis < reader->GetNumberOfDimensions(); ++axis)
        whole.SetSize(axis, reader->GetDimensions(axis));
      reader->SetIORegion(whole);
      volume.hu.resize(
          static_cast<std::size_t>(layout.size_voxels[0] * layout.size_voxels[1] * layout.size_voxels[2]));
      read_voxels(*reader, volume.hu, problems);
    }
  } catch (const std::exception&) {  // its text names the file
    problems.add("damaged", "the file cannot be read as what it begins as");
  }
  if (!problems.empty()) return problems.error();
  source.slices_used = volume.size_voxels.z;
  if (volume.size_voxels.z == 1) source.warnings.push_back({"single_slice", "the case is one slice"});
  return source;
}

}  // namespace seldinger::casedb
