#include "casedb/export/deidentify.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>
#include <system_error>

#include "casedb/database/disk.h"
#include "casedb/database/leftovers.h"
#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"
#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100000;
const base::Error kExists{"exists", "there is already something of that name, and it is not an empty folder"};

// Not whole, so that something might be missing from what is handed on without a word.
bool refuses_all(const std::string& code) {
  static constexpr const char* kCodes[] = {"not_readable", "truncated", "damaged",
                                           "too_deep",     "too_large", "unknown_syntax"};
  return std::any_of(std::begin(kCodes), std::end(kCodes), [&](const char* one) { return code == one; });
}

base::Result<std::vector<fs::path>> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, error);
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    std::error_code ignored;
    if (walk->is_regular_file(ignored)) files.push_back(walk->path());
    if (files.size() > kMostFiles) return base::Error{"too_many_files", "the folder holds more than 100000 files"};
  }
  if (error) return base::Error{"not_readable", "the folder cannot be read"};
  std::sort(files.begin(), files.end());
  return files;
}

// What a run that was killed leaves: its new files.
bool is_of_a_run(const std::string& name) {
  const std::string file = name.substr(0, name.find(".dcm"));
  return (file.starts_with("new_image_") || file.starts_with("image_")) &&
         (name == file + ".dcm" || is_temporary_name(name));
}

std::string numbered_name(std::size_t number) {
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "image_%06zu.dcm", number);
  return name.data();
}

constexpr std::uint64_t kTimesInMemory = 3;  // as read, and as it is written anew
// A file is worth so many more bytes of work: it is opened, its elements are gone through one by one.
constexpr std::uint64_t kWorkOfAFile = 64 * 1024;

JailInputs inputs_of(const std::vector<fs::path>& files) {
  JailInputs inputs;
  inputs.files.insert(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (!error && size <= kLargestDicomFile)
      inputs.bytes = std::max<std::uint64_t>(inputs.bytes, kTimesInMemory * size);
    inputs.work_bytes += kWorkOfAFile + (error ? 0 : std::min<std::uint64_t>(size, kLargestDicomFile));
  }
  return inputs;
}

void put_clean(Outlet& out, const base::Result<CleanFile>& clean) {
  out.put(clean.has_value());
  if (!clean) return out.put_error(clean.error());
  out.put<std::uint64_t>(clean->counts.size());
  for (const auto& [what, count] : clean->counts) {
    out.put_text(what);
    out.put(count);
  }
  out.put_text(clean->sop_instance_uid);
  out.put<std::uint64_t>(clean->bytes.size());
  out.put_bytes(std::as_bytes(std::span(clean->bytes)));
}

base::Result<CleanFile> take_clean(Inlet& in, const fs::path& file) {
  constexpr std::size_t kMostCounts = 100, kLongestText = 100;
  if (!in.take_flag()) return in.take_error();
  CleanFile clean;
  for (std::size_t count = in.take_count(kMostCounts); count > 0; --count) {
    const std::string what = in.take_text(kLongestText);
    clean.counts[what] = in.take<std::int64_t>();
  }
  clean.sop_instance_uid = in.take_text(kLongestText);
  std::error_code error;
  const auto size = fs::file_size(file, error);
  // What is put in: an element each for what is said of it, and delimiters of 16 bytes for lengths of 8.
  clean.bytes.resize(in.take_count(most_unpacked(kDicomDataSet, error ? 0 : size) * 3));
  in.take_bytes(std::as_writable_bytes(std::span(clean.bytes)));
  return clean;
}

// All files are read in one jail, one after the other, and come out as they are done.
base::Result<Deidentified> into(const fs::path& in, const std::vector<fs::path>& files, const fs::path& out,
                                Inlet& inlet) {
  const bool one_file = !fs::is_directory(in);
  NewFolders parents(fs::absolute(out).lexically_normal().parent_path());
  NewFolder made(out);
  const fs::path& unfinished = made.unfinished();
  remove_leftover_folders(unfinished.parent_path(), &is_of_a_run);
  Deidentified done;
  std::vector<std::pair<std::string, fs::path>> written;  // by new UID, which is as good as shuffled
  std::map<std::string, base::Problem> refusals;
  std::optional<base::Error> refused;
  for (const fs::path& file : files) {
    auto clean = take_clean(inlet, file);
    if (!clean) {
      if (one_file) refused = clean.error();
      ++done.left_out[clean.error().code];
      if (refuses_all(clean.error().code))
        refusals.try_emplace(clean.error().code, base::Problem{clean.error().code, clean.error().text});
      continue;
    }
    if (!refusals.empty()) continue;
    for (const auto& [what, count] : clean->counts) done.counts[what] += count;
    const fs::path path = unfinished / numbered_name(written.size() + 1).insert(0, "new_");
    write_durably(path, std::as_bytes(std::span(clean->bytes)), FileAccess::as_umask);
    written.emplace_back(std::move(clean->sop_instance_uid), path);
  }
  inlet.end();
  if (refused) return *refused;
  if (!refusals.empty()) {
    base::Error error{refusals.begin()->second.code, refusals.begin()->second.text};
    for (const auto& [code, problem] : refusals)
      error.findings.push_back({code, std::to_string(done.left_out[code]) + " of " + std::to_string(files.size()) +
                                          " files: " + problem.text});
    return error;
  }
  if (written.empty()) {
    base::Error error{"nothing_left", "no file can be handed on"};
    for (const auto& [code, count] : done.left_out)
      error.findings.push_back({code, std::to_string(count) + (count == 1 ? " file" : " files")});
    return error;
  }
  std::sort(written.begin(), written.end());
  done.files = static_cast<int>(written.size());
  for (std::size_t i = 0; i < written.size(); ++i) fs::rename(written[i].second, unfinished / numbered_name(i + 1));
  if (one_file && out.extension() == ".dcm") {
    fs::rename(unfinished / numbered_name(1), out);
  } else if (!made.keep()) {
    return kExists;
  }
  parents.keep();
  return done;
}

}  // namespace

base::Result<Deidentified> deidentify(const fs::path& in, const fs::path& out, const HashKey& key) {
  try {
    if (!fs::exists(in)) return base::Error{"not_found", "there is no such file or folder"};
    if (fs::exists(out) && !(fs::is_directory(out) && fs::is_empty(out))) return kExists;
    std::vector<fs::path> files{in};
    if (fs::is_directory(in)) {
      auto found = files_below(in);
      if (!found) return found.error();
      files = std::move(*found);
    }
    base::Result<Deidentified> result = base::Error{};
    const auto read = read_in_jail(
        inputs_of(files),
        [&](Outlet& outlet) {
          for (const fs::path& file : files) put_clean(outlet, deidentify_file(file, key));
        },
        [&](Inlet& inlet) { result = into(in, files, out, inlet); });
    if (!read) return read.error();
    return result;
  } catch (const fs::filesystem_error& error) {  // its text holds paths
    throw base::Failure("disk", "the files cannot be written: " + error.code().message());
  }
}

}  // namespace seldinger::casedb
