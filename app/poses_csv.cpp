#include "app/poses_csv.h"

#include <array>
#include <string_view>
#include <vector>

#include "app/arguments.h"

namespace seldinger::app {
namespace {

constexpr std::array<const char*, 17> kColumns = {"t_s",
                                                  "needle_tip_x_mm",
                                                  "needle_tip_y_mm",
                                                  "needle_tip_z_mm",
                                                  "needle_dir_x",
                                                  "needle_dir_y",
                                                  "needle_dir_z",
                                                  "probe_origin_x_mm",
                                                  "probe_origin_y_mm",
                                                  "probe_origin_z_mm",
                                                  "probe_axial_x",
                                                  "probe_axial_y",
                                                  "probe_axial_z",
                                                  "probe_lateral_x",
                                                  "probe_lateral_y",
                                                  "probe_lateral_z",
                                                  "fire"};
constexpr std::size_t kMaxProblems = 10;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '"'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r' || text.back() == '"'))
    text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

base::Result<cases::Recording> recording_from_csv(const std::string& text) {
  base::Error error{"bad_csv", "", {}};
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xef\xbb\xbf") rest.remove_prefix(3);
  const auto next_line = [&rest]() {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return line;
  };
  const auto header = split(next_line());
  std::array<std::size_t, kColumns.size()> place{};
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == kColumns[c]) {
        place[c] = i;
        ++found;
      }
    if (found != 1)
      error.findings.push_back(
          {"bad_csv", std::string("column ") + kColumns[c] + (found == 0 ? " is missing" : " stands twice")});
  }
  cases::Recording recording;
  std::size_t row = 0;
  while (!rest.empty() && error.findings.size() < kMaxProblems) {
    const std::string_view line = next_line();
    if (trimmed(line).empty()) continue;
    ++row;
    const auto cells = split(line);
    if (cells.size() != header.size()) {
      error.findings.push_back(
          {"bad_csv", "row " + std::to_string(row) + " has another number of cells than the header"});
      continue;
    }
    if (!error.findings.empty()) continue;
    std::array<double, kColumns.size()> value{};
    for (std::size_t c = 0; c < kColumns.size() && error.findings.size() < kMaxProblems; ++c) {
      const auto number = parse_number(std::string(cells[place[c]]));
      if (!number)
        error.findings.push_back(
            {"bad_csv", "row " + std::to_string(row) + ", " + kColumns[c] + " is not a number"});
      else
        value[c] = *number;
    }
    cases::PoseSample pose;
    pose.t_s = value[0];
    pose.tip_lps_mm = {value[1], value[2], value[3]};
    pose.needle_direction = {value[4], value[5], value[6]};
    pose.probe_origin_lps_mm = {value[7], value[8], value[9]};
    pose.probe_axial = {value[10], value[11], value[12]};
    pose.probe_lateral = {value[13], value[14], value[15]};
    recording.poses.push_back(pose);
    if (value[16] != 0.0 && !recording.endpoint)
      recording.endpoint = cases::Endpoint{pose.t_s, pose.tip_lps_mm, pose.needle_direction};
  }
  if (error.findings.empty() && recording.poses.empty()) error.findings.push_back({"bad_csv", "there is no row"});
  if (error.findings.empty()) return recording;
  error.text = error.findings.front().text;
  error.findings.erase(error.findings.begin());
  return error;
}

}  // namespace seldinger::app
