#include "casedb/import/read_dicom.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "casedb/import/byte_count.h"
#include "casedb/import/dicom_slice.h"
#include "casedb/import/problems.h"
#include "casedb/import/slice_stack.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostFiles = 50000, kMostSlices = 4096;
constexpr int kDeepestFolder = 16;

struct Found {
  std::vector<DicomSlice> slices;
  std::map<DicomKind, int> left_out;
  int unreadable = 0;                      // may be slices
  std::vector<std::string> other_endings;  // of files that are no DICOM; an empty file counts as every ending
  int files = 0;
};

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

void look_at(const std::filesystem::path& path, Found& found) {
  const DicomFile file = read_dicom_file(path);
  const DicomKind kind = kind_of(file);
  ++found.files;
  if (kind == DicomKind::not_dicom) {
    if (!read_bytes(path, 0, 1))
      ++found.unreadable;
    else
      found.other_endings.push_back(file_size_bytes(path) == 0 ? "*" : ending_of(path));
  }
  if (kind != DicomKind::ct_slice) {
    ++found.left_out[kind];
    return;
  }
  DicomSlice slice = slice_from(file);
  slice.file = path;
  if (!file.encapsulated && slice.problems.empty()) {
    const std::size_t need = static_cast<std::size_t>(slice.size_px.x) * static_cast<std::size_t>(slice.size_px.y) *
                             static_cast<std::size_t>(slice.bits_allocated / 8);
    if (file.pixel_pieces.front().second < need)
      slice.problems.push_back({"truncated", "ends before its pixels do"});
  } else if (file.pixels_cut) {
    slice.problems.push_back({"truncated", "ends before its pixels do"});
  }
  found.slices.push_back(std::move(slice));
}

// Files in name order, so that a folder is read the same way on every machine. Links to files are followed, links
// to folders are not; a file that is reached twice counts once.
base::Result<Found> look_through(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  std::set<fs::path> reached;
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    std::error_code ignored;
    const bool dangling = walk->is_symlink(ignored) && !fs::exists(walk->path(), ignored);
    if (walk.depth() >= kDeepestFolder) walk.disable_recursion_pending();
    if (!walk->is_regular_file(ignored) && !dangling) continue;
    if (reached.insert(fs::weakly_canonical(walk->path(), ignored)).second) files.push_back(walk->path());
    if (files.size() > kMostFiles) return base::Error{"too_many_files", "the folder holds more than 50000 files"};
  }
  if (error) return base::Error{"not_readable", "the folder cannot be read"};
  std::sort(files.begin(), files.end());
  Found found;
  for (const fs::path& file : files) look_at(file, found);
  return found;
}

// Why a source without any CT slice is refused: the most telling reason first.
base::Error nothing_found(const Found& found) {
  Problems problems;
  const auto say = [&](DicomKind kind, const char* code, const std::string& text) {
    if (const auto it = found.left_out.find(kind); it != found.left_out.end())
      problems.add(code, std::to_string(it->second) + (it->second == 1 ? " file " : " files ") + text);
  };
  say(DicomKind::multi_frame, "multi_frame", "with several frames: only classic CT, one slice a file, is read");
  say(DicomKind::truncated, "truncated", "ending in the middle of an element");
  say(DicomKind::damaged, "damaged", "that cannot be followed as DICOM");
  say(DicomKind::ct_localizer, "localizer", "with a localizer picture, which is no slice");
  say(DicomKind::other_modality, "not_ct", "of DICOM that are no CT image");
  say(DicomKind::no_image, "no_image", "of DICOM without an image");
  if (found.unreadable > 0) problems.add("not_readable", "files in the folder cannot be read");
  if (found.files == 0) problems.add("empty_folder", "the folder holds no file");
  if (problems.empty()) problems.add("no_dicom", "no file in the folder is DICOM");
  return problems.error();
}

using Series = std::vector<DicomSlice>;

std::vector<Series> series_of(std::vector<DicomSlice> slices) {
  std::map<std::pair<double, std::string>, Series> by_series;
  std::map<std::string, double> number_of;  // one number a series, should its slices disagree
  for (const DicomSlice& slice : slices) number_of.try_emplace(slice.series_uid, slice.series_number);
  for (DicomSlice& slice : slices)
    by_series[{number_of[slice.series_uid], slice.series_uid}].push_back(std::move(slice));
  std::vector<Series> all;
  for (auto& [key, series] : by_series) all.push_back(std::move(series));
  return all;
}

std::string slice_count(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " slice" : " slices");
}

base::Result<Series> chosen_series(std::vector<Series> all, const std::optional<std::string>& wanted) {
  if (!wanted && all.size() == 1) return std::move(all.front());
  if (wanted)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (*wanted == std::to_string(i + 1) || *wanted == all[i].front().series_uid) return std::move(all[i]);
  base::Error error = wanted ? base::Error{"no_series", "there is no such CT series"}
                             : base::Error{"several_series", "there are " + std::to_string(all.size()) +
                                                                 " CT series: choose one by its number"};
  for (std::size_t i = 0; i < all.size(); ++i)
    error.findings.push_back({"series", std::to_string(i + 1) + ": CT, " + slice_count(all[i].size())});
  return error;
}

void warn(const Found& found, const Series& slices, std::vector<base::Problem>& warnings) {
  const auto any = [&](bool DicomSlice::*flag) {
    return std::any_of(slices.begin(), slices.end(), [&](const DicomSlice& slice) { return slice.*flag; });
  };
  if (slices.size() == 1) warnings.push_back({"single_slice", "the case is one slice"});
  if (any(&DicomSlice::lossy)) warnings.push_back({"lossy", "the pictures were compressed with loss"});
  if (any(&DicomSlice::no_rescale))
    warnings.push_back({"no_rescale", "rescale slope or intercept is missing: 1 and 0 are taken"});
  if (any(&DicomSlice::not_hu)) warnings.push_back({"not_hu", "the values are not said to be HU"});
  if (any(&DicomSlice::secondary))
    warnings.push_back({"secondary", "derived pictures: look whether text is burned into them"});
  int others = 0;
  for (const auto& [kind, count] : found.left_out)
    if (kind != DicomKind::not_dicom) others += count;
  if (others > 0)
    warnings.push_back({"left_out", std::to_string(others) + " DICOM files that are no CT slice were left out"});
}

base::Result<Source> volume_of(const Found& found, Series slices) {
  Problems problems;
  if (slices.size() > kMostSlices) problems.add("too_many_slices", "the series has more than 4096 slices");
  // A file that cannot be read may be a slice of this very series.
  for (const DicomKind kind : {DicomKind::truncated, DicomKind::damaged})
    if (found.left_out.contains(kind))
      problems.add(kind == DicomKind::truncated ? "truncated" : "damaged",
                   "a DICOM file beside the slices is not whole; it may be one of them");
  if (found.unreadable > 0)
    problems.add("not_readable", "a file beside the slices cannot be read; it may be one of them");
  // Junk beside a series is left out; what is named like its slices, or is empty, may be a lost one.
  const std::string ending = ending_of(slices.front().file);
  for (const std::string& other : found.other_endings)
    if (other == "*" || (!ending.empty() && other == ending)) {
      problems.add("damaged", "a file that looks like one of the slices is not DICOM");
      break;
    }
  order_slices(slices, problems);
  const glm::ivec3 size(slices.front().size_px, static_cast<int>(slices.size()));
  const std::size_t slice_voxels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  if (problems.empty() && slice_voxels * slices.size() > volume::kMaxVoxels)
    problems.add("bad_size", "the series has more voxels than can be held");
  if (!problems.empty()) return problems.error();

  Source source;
  source.slices_used = size.z;
  source.attributes = slices.front().attributes;
  warn(found, slices, source.warnings);
  double thickness_mm = 1.0;
  for (const auto& [name, value] : source.attributes)
    if (name == "slice_thickness_mm") thickness_mm = std::stod(value);
  volume::Volume& volume = source.volume;
  volume.size_voxels = size;
  volume.lps_from_voxel = lps_from_voxel(slices, thickness_mm);
  for (int axis = 0; axis < 3; ++axis)
    volume.spacing_mm[axis] = glm::length(glm::dvec3(volume.lps_from_voxel[axis]));
  volume.hu.resize(slice_voxels * slices.size());
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const DicomFile file = read_dicom_file(slices[k].file);
    const auto decoded = decode_slice(file, slices[k], {volume.hu.data() + k * slice_voxels, slice_voxels});
    if (!decoded)
      problems.add(decoded.error().code,
                   "slice " + std::to_string(k + 1) + " (ordered by position) " + decoded.error().text);
  }
  if (!problems.empty()) return problems.error();
  return source;
}

base::Result<Source> read_found(Found found, const std::optional<std::string>& series) {
  if (found.slices.empty()) return nothing_found(found);
  auto chosen = chosen_series(series_of(std::move(found.slices)), series);
  if (!chosen) return chosen.error();
  return volume_of(found, std::move(*chosen));
}

}  // namespace

base::Result<Source> read_dicom_folder(const std::filesystem::path& folder,
                                       const std::optional<std::string>& series) {
  auto found = look_through(folder);
  if (!found) return found.error();
  return read_found(std::move(*found), series);
}

base::Result<Source> read_dicom_slice(const std::filesystem::path& file, const std::optional<std::string>& series) {
  Found found;
  look_at(file, found);
  return read_found(std::move(found), series);
}

}  // namespace seldinger::casedb
