#include "casedb/import/files/file_layout.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "casedb/import/jail/input.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

constexpr std::int64_t kMostVoxelsAlong = 4096, kMostVoxels = static_cast<std::int64_t>(volume::kMaxVoxels);
constexpr std::size_t kMostLines = 20'000;
constexpr std::uint64_t kLongestHeader = 1 << 20;  // segmentations of 3D Slicer write tags of each segment

}  // namespace

void check_layout(const FileLayout& layout, const UnpackingLimit& limit, Problems& problems) {
  std::int64_t voxels = 1;
  for (const std::int64_t count : layout.size_voxels) {
    if (count < 1 || count > kMostVoxelsAlong) {
      problems.add("bad_size", "the header's size is out of range (1 to 4096 along each axis)");
      return;
    }
    voxels *= count;
  }
  if (voxels > kMostVoxels) {
    problems.add("bad_size", "the header promises more voxels than can be held");
    return;
  }
  const std::uint64_t unpacked =
      layout.unpacked_skip +
      static_cast<std::uint64_t>(voxels) * static_cast<std::uint64_t>(bytes_of(layout.voxels.scalar));
  if (unpacked > limit.most_bytes)
    problems.add("too_large", "the voxels take more bytes than are read of one file");
  else if (layout.packing != Packing::none && problems.empty() &&
           unpacks_too_far(limit, std::min(file_size_bytes(layout.data_file), layout.packed_limit), unpacked))
    problems.add("too_large", "the voxels would be far larger than they are packed: no CT is");
}

std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name,
                                       Problems& problems) {
  const bool plain = !name.empty() && name != "." && name != ".." &&
                     name.find_first_of("/\\%") == std::string::npos && name.find('\0') == std::string::npos;
  if (!plain) {
    problems.add("bad_data_file", "the header names voxels that do not lie in one file beside it");
    return {};
  }
  const std::filesystem::path file = header.parent_path() / name;
  if (!InputFile(file, Links::refused)) {
    problems.add("no_data_file", "the file with the voxels is not beside the header");
    return {};
  }
  return file;
}

TextHeader read_text_header(const std::filesystem::path& file, const std::string& last_key) {
  TextHeader header;
  const auto bytes = read_bytes(file, 0, kLongestHeader);
  if (!bytes) return header;
  std::string line;
  for (std::size_t i = 0; i < bytes->size() && !header.ended && header.lines.size() < kMostLines; ++i) {
    const char c = static_cast<char>((*bytes)[i]);
    if (c != '\n') {
      line.push_back(c);
      continue;
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    header.ended = last_key.empty() ? line.empty() : line.starts_with(last_key);
    header.data_offset = i + 1;
    header.lines.push_back(std::move(line));
    line.clear();
  }
  if (!header.ended && bytes->size() < kLongestHeader) {  // a detached header may end with the file
    header.ended = last_key.empty() || line.starts_with(last_key);
    header.data_offset = bytes->size();
    header.lines.push_back(line);
  }
  return header;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    double value = 0.0;
    const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [stop, error] = std::from_chars(first, word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value)) return {};
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace seldinger::casedb
