#include "casedb/import/dicom/read_dicom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "casedb/import/dicom/dicom_slice.h"
#include "casedb/import/dicom/dicom_volume.h"
#include "casedb/import/files/byte_count.h"
#include "casedb/import/files/number_text.h"
#include "casedb/import/files/problems.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostFiles = 50000, kMostFound = 65536;
constexpr int kDeepestFolder = 16;

using Series = std::vector<DicomSlice>;

struct Found {
  std::vector<DicomSlice> slices;
  std::map<DicomKind, int> left_out;
  int unreadable = 0;  // may be slices
  int hollow = 0;      // empty, or zeros where a slice's preamble would be: may be slices that were not copied
  std::vector<std::string> other_endings;  // of files that are something else
  int files = 0;
};

std::string ending_of(const std::filesystem::path& path) {
  return base::lower(path.extension().string());
}

void look_at_other(const std::filesystem::path& path, Found& found) {
  const auto start = read_bytes(path, 0, 132);
  if (!start)
    ++found.unreadable;
  else if (std::all_of(start->begin(), start->end(), [](std::byte b) { return b == std::byte{0}; }))
    ++found.hollow;
  else
    found.other_endings.push_back(ending_of(path));
}

void look_at(const std::filesystem::path& path, Found& found) {
  const DicomFile file = read_dicom_file(path);
  const DicomKind kind = kind_of(file);
  ++found.files;
  if (kind == DicomKind::not_dicom) look_at_other(path, found);
  if (kind != DicomKind::ct) {
    ++found.left_out[kind];
    return;
  }
  int localizers = 0;
  for (DicomSlice& slice : slices_of(file, path, localizers)) found.slices.push_back(std::move(slice));
  if (localizers > 0) found.left_out[DicomKind::localizer] += localizers;
}

base::Result<Found> look_through(const std::vector<std::filesystem::path>& files) {
  Found found;
  for (const std::filesystem::path& file : files) {
    look_at(file, found);
    if (found.slices.size() > kMostFound)
      return base::Error{"too_many_slices", "the source holds more than 65536 slices"};
  }
  return found;
}

struct LeftOut {
  DicomKind kind;
  const char* code;
  const char* text;
};

// The most telling reason first. What may be a lost slice comes before what surely is none.
constexpr std::array<LeftOut, 13> kReasons = {{
    {DicomKind::frames_without_place, "multi_frame", "frames that do not say where each lies"},
    {DicomKind::truncated, "truncated", "ending in the middle of an element"},
    {DicomKind::damaged, "damaged", "that cannot be followed as DICOM"},
    {DicomKind::bomb, "bad_size", "unpacking to more than twice their size and 64 MB"},
    {DicomKind::too_large, "bad_size", "larger than 1 GiB"},
    {DicomKind::localizer, "localizer", "localizer pictures, which are no slices"},
    {DicomKind::secondary_capture, "secondary_capture", "captured screen pictures"},
    {DicomKind::parametric_map, "parametric_map", "parametric maps, which hold no HU"},
    {DicomKind::encapsulated_document, "encapsulated_document", "documents (PDF or such)"},
    {DicomKind::other_object, "not_ct", "other DICOM objects than CT images"},
    {DicomKind::no_image, "no_image", "DICOM without an image"},
    {DicomKind::directory, "dicomdir", "lists of files (DICOMDIR), which are not followed: the folder is read"},
    {DicomKind::not_dicom, "no_dicom", "not DICOM"},
}};
constexpr std::size_t kMayBeSlices = 5;  // of these, the first ones

std::string left_out_text(const Found& found, const LeftOut& reason) {
  return count_text(static_cast<std::size_t>(found.left_out.at(reason.kind)), "file") + ": " + reason.text;
}

// Why a source without any CT slice is refused.
base::Error nothing_found(const Found& found) {
  Problems problems;
  for (const LeftOut& reason : kReasons)
    if (reason.kind != DicomKind::not_dicom && found.left_out.contains(reason.kind))
      problems.add(reason.code, left_out_text(found, reason));
  if (found.unreadable > 0) problems.add("not_readable", "files in the folder cannot be read");
  if (found.files == 0) problems.add("empty_folder", "the folder holds no file");
  if (problems.empty()) problems.add("no_dicom", "no file in the folder is DICOM");
  return problems.error();
}

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

// No slice of it can be read.
bool is_hopeless(const Series& series) {
  return std::none_of(series.begin(), series.end(), [](const DicomSlice& slice) { return slice.problems.empty(); });
}

std::string series_text(std::size_t number, const Series& series) {
  const std::string text = std::to_string(number) + ": CT, " + count_text(series.size(), "slice");
  const DicomSlice& first = series.front();
  if (is_hopeless(series)) return text + ", which cannot be read (" + first.problems.front().code + ")";
  return text + " of " + std::to_string(first.size_px.x) + " x " + std::to_string(first.size_px.y) +
         (first.thickness_mm > 0.0 ? ", " + number_text(first.thickness_mm) + " mm thick" : "");
}

base::Result<Series> chosen_series(std::vector<Series> all, const std::optional<std::string>& wanted,
                                   std::vector<base::Problem>& warnings) {
  if (wanted)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (*wanted == std::to_string(i + 1) || *wanted == all[i].front().series_uid) return std::move(all[i]);
  std::size_t hopeful = 0, last = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_hopeless(all[i])) continue;
    ++hopeful;
    last = i;
  }
  if (!wanted && all.size() == 1) return std::move(all.front());
  if (!wanted && hopeful == 1) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i != last) warnings.push_back({"series_left_out", series_text(i + 1, all[i])});
    return std::move(all[last]);
  }
  base::Error error = wanted ? base::Error{"no_series", "there is no such CT series"}
                             : base::Error{"several_series", "there are " + std::to_string(all.size()) +
                                                                 " CT series: choose one with --series N"};
  for (std::size_t i = 0; i < all.size(); ++i) error.findings.push_back({"series", series_text(i + 1, all[i])});
  return error;
}

// A file that cannot be read may be a slice of the very series: refused. Anything else is left out and counted.
void judge_others(const Found& found, const Series& series, Problems& problems,
                  std::vector<base::Problem>& warnings) {
  std::string others;
  for (std::size_t i = 0; i < kReasons.size(); ++i) {
    const LeftOut& reason = kReasons[i];
    if (!found.left_out.contains(reason.kind)) continue;
    if (i < kMayBeSlices)
      problems.add(reason.code, left_out_text(found, reason) + ", beside the slices: may be one of them");
    else
      others += (others.empty() ? "" : "; ") + left_out_text(found, reason);
  }
  if (!others.empty()) warnings.push_back({"left_out", "left out: " + others});
  if (found.unreadable > 0)
    problems.add("not_readable", count_text(static_cast<std::size_t>(found.unreadable), "file") +
                                     " beside the slices cannot be read: it may be one of them");
  if (found.hollow > 0)
    problems.add("damaged", count_text(static_cast<std::size_t>(found.hollow), "file") +
                                " beside the slices, empty or of zeros: it may be a lost one of them");
  const std::string ending = ending_of(series.front().file);
  const auto alike =
      static_cast<std::size_t>(std::count(found.other_endings.begin(), found.other_endings.end(), ending));
  if (alike > 0 && !ending.empty())
    warnings.push_back({"not_dicom", "named like the slices, but not DICOM: " + count_text(alike, "file") +
                                         ". Were they slices, the series is not whole"});
}

base::Result<Source> read_found(Found found, const std::optional<std::string>& wanted) {
  if (found.slices.empty()) return nothing_found(found);
  std::vector<base::Problem> warnings;
  Problems problems;
  auto series = chosen_series(series_of(std::move(found.slices)), wanted, warnings);
  if (!series) return series.error();
  judge_others(found, *series, problems, warnings);
  return volume_of(std::move(*series), std::move(problems), std::move(warnings));
}

}  // namespace

base::Result<std::vector<std::filesystem::path>> files_of_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  std::set<fs::path> reached;
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, error);
  if (error) return base::Error{"not_readable", "the folder cannot be read"};
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    std::error_code ignored;
    const bool dangling = walk->is_symlink(ignored) && !fs::exists(walk->path(), ignored);
    if (walk.depth() >= kDeepestFolder && walk->is_directory(ignored) && !walk->is_symlink(ignored))
      return base::Error{"not_readable", "folders within the folder lie more than 16 deep: slices may be in them"};
    if (!walk->is_regular_file(ignored) && !dangling) continue;
    if (reached.insert(fs::weakly_canonical(walk->path(), ignored)).second) files.push_back(walk->path());
    if (files.size() > kMostFiles) return base::Error{"too_many_files", "the folder holds more than 50000 files"};
  }
  if (error)
    return base::Error{"not_readable", "a folder within the folder cannot be read, after " +
                                           count_text(files.size(), "file") + ": slices may be in it"};
  std::sort(files.begin(), files.end());
  return files;
}

base::Result<Source> read_dicom_files(const std::vector<std::filesystem::path>& files,
                                      const std::optional<std::string>& series) {
  auto found = look_through(files);
  if (!found) return found.error();
  return read_found(std::move(*found), series);
}

}  // namespace seldinger::casedb
