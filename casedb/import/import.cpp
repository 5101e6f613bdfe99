#include "casedb/import/import.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <new>

#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/dicom/read_dicom.h"
#include "casedb/import/dropped_fields.h"
#include "casedb/import/files/byte_count.h"
#include "casedb/import/files/read_file.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/source_frames.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

const base::Error kNoMemory{"bad_size", "there is not enough memory for the volume"};
constexpr int kTissueHu = -200;            // a CT of a patient without anything below is none, or not in HU
constexpr std::size_t kStartBytes = 4096;  // enough of a file to tell what it is

std::string lower_extension(const std::filesystem::path& file) {
  const std::string name = base::lower(file.filename().string());
  for (const char* known : {".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".dcm"})
    if (name.ends_with(known)) return known;
  return {};
}

bool is_nifti_header(const char* bytes, std::size_t size) {
  return size >= 348 && std::memcmp(bytes + 344, "n+1", 4) == 0;
}

// By its first keys, or, where its name says so, by anything that is a key: a comment may be longer than the start.
bool is_metaimage_header(std::string_view start, bool named_so) {
  if (start.find("ElementDataFile") != std::string_view::npos || start.starts_with("ObjectType")) return true;
  const std::string_view key = start.substr(0, start.find_first_of(" =\r\n"));
  const std::size_t after = std::min(start.find_first_not_of(' ', key.size()), start.size());
  const bool is_key = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  }) && start.substr(after).starts_with('=');
  return is_key && (named_so || key == "NDims");
}

base::Result<Source> read_volume(const std::filesystem::path& file, FileFormat format,
                                 const UnpackingLimit& limit) {
  auto source = read_volume_file(file, format, limit);
  if (source) source->dropped = dropped_fields(file, format);
  return source;
}

// What a file begins as decides; its name only tells what is packed.
std::optional<FileFormat> format_of(std::string_view start, const std::string& extension) {
  const bool packed = start.size() >= 2 && start[0] == '\x1F' && start[1] == '\x8B';
  if (packed) return extension == ".nii.gz" ? std::optional(FileFormat::nifti) : std::nullopt;
  if (is_nifti_header(start.data(), start.size()) && extension == ".nii") return FileFormat::nifti;
  if (start.starts_with("NRRD000")) return FileFormat::nrrd;
  if (is_metaimage_header(start, extension == ".mha" || extension == ".mhd")) return FileFormat::metaimage;
  return std::nullopt;
}

// Where the folder of a volume file was given in its place. By its kind: its name may be a patient's.
base::Error with_volume_files(base::Error refused, const std::filesystem::path& folder) {
  std::size_t count = 0;
  std::string kind;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; it != end; it.increment(error)) {
    const std::string extension = lower_extension(it->path());
    const auto bytes =
        extension.empty() || !it->is_regular_file(error) ? std::nullopt : read_bytes(it->path(), 0, kStartBytes);
    if (!bytes || !format_of({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, extension)) continue;
    ++count;
    kind = extension;
  }
  if (count == 1) refused.text += "; it holds one volume file (" + kind + "): give that file itself";
  if (count > 1) refused.text += "; it holds " + std::to_string(count) + " volume files: give one of them itself";
  return refused;
}

base::Result<Source> read_one_file(const std::filesystem::path& file, const std::optional<std::string>& series,
                                   const UnpackingLimit& limit) {
  const auto bytes = read_bytes(file, 0, kStartBytes);
  if (!bytes) return base::Error{"not_readable", "the file cannot be read"};
  const std::string_view start(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::string extension = lower_extension(file);
  if (looks_like_dicom(start.data(), start.size())) return read_dicom_files({file}, series);
  if (series && *series != "1")
    return base::Error{"no_series", "there is no such series: the file holds one volume"};
  if (const auto format = format_of(start, extension)) return read_volume(file, *format, limit);
  if (!extension.empty()) return base::Error{"damaged", "the file does not begin as its name says"};
  return base::Error{"unknown_format", "the file is not DICOM, NIfTI, NRRD or MetaImage"};
}

// Of a folder; nothing where the source is one file.
using Files = std::optional<std::vector<std::filesystem::path>>;

// In the jail.
base::Result<Source> read_inside(const std::filesystem::path& source, const std::optional<std::string>& series,
                                 const UnpackingLimit& limit, const Files& files) {
  try {
    auto result = files ? read_dicom_files(*files, series) : read_one_file(source, series, limit);
    if (!result) return result;
    const auto& hu = result->volume.hu;
    if (*std::min_element(hu.begin(), hu.end()) > kTissueHu)
      result->warnings.push_back({"no_air", "nothing in the volume is air: are its values HU?"});
    if (const auto at_limit = std::count(hu.begin(), hu.end(), std::int16_t{32767}); at_limit > 0)
      result->warnings.push_back({"hu_at_limit", std::to_string(at_limit) +
                                                     " voxels are at 32767 HU, the most "
                                                     "that is kept: the source may hold more"});
    return result;
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  }
}

constexpr std::uint64_t kBytesOfAnEntry = 8192;  // what is kept of a slice until all are known

JailInputs inputs_of(const std::filesystem::path& source, const Files& files) {
  JailInputs inputs;
  if (files)
    inputs.files.insert(files->begin(), files->end());
  else
    inputs.files.insert(source);
  if (!files) inputs.beside = source.parent_path();
  std::uint64_t largest = 0;
  for (const std::filesystem::path& file : inputs.files) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (!error) largest = std::max<std::uint64_t>(largest, size);
  }
  inputs.bytes = std::min(largest, kLargestDicomFile) + inputs.files.size() * kBytesOfAnEntry;
  return inputs;
}

base::Result<Files> files_of(const std::filesystem::path& source) {
  std::error_code error;
  const auto status = std::filesystem::status(source, error);
  if (error || !std::filesystem::exists(status)) return base::Error{"not_found", "there is no such file or folder"};
  if (std::filesystem::is_directory(status)) {
    auto found = files_of_folder(source);
    if (!found) return found.error();
    return Files(std::move(*found));
  }
  if (!std::filesystem::is_regular_file(status)) return base::Error{"unknown_format", "no file or folder"};
  return Files();
}

}  // namespace

base::Result<Source> read_source(const std::filesystem::path& source, const std::optional<std::string>& series,
                                 const UnpackingLimit& limit) {
  const auto files = files_of(source);
  if (!files) return files.error();
  base::Result<Source> result = base::Error{};
  try {
    const auto read = read_in_jail(
        inputs_of(source, *files),
        [&](Outlet& out) { put_source(out, read_inside(source, series, limit, *files)); },
        [&](Inlet& in) { result = take_source(in); });
    if (!read) return read.error();
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  }
  if (!result && result.error().code == "no_dicom") return with_volume_files(result.error(), source);
  return result;
}

base::Result<Source> read_source_here(const std::filesystem::path& source) {
  const auto files = files_of(source);
  if (!files) return files.error();
  return read_inside(source, {}, kCtFile, *files);
}

}  // namespace seldinger::casedb
