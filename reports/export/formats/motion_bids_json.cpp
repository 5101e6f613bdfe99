#include "reports/export/formats/motion_bids_json.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

namespace seldinger::reports {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRoot = "motion-bids/";

// A column of *_motion.tsv, which has no header: its row in *_channels.tsv, and its cell.
struct Channel {
  const char *name, *component, *type, *units;
  double (*cell)(const cases::PoseSample&);
};
using Pose = cases::PoseSample;
constexpr Channel kChannels[] = {
    {"needle_tip_x", "x", "POS", "mm", [](const Pose& pose) { return pose.tip_lps_mm.x; }},
    {"needle_tip_y", "y", "POS", "mm", [](const Pose& pose) { return pose.tip_lps_mm.y; }},
    {"needle_tip_z", "z", "POS", "mm", [](const Pose& pose) { return pose.tip_lps_mm.z; }},
    {"needle_direction_x", "x", "MISC", "n/a", [](const Pose& pose) { return pose.needle_direction.x; }},
    {"needle_direction_y", "y", "MISC", "n/a", [](const Pose& pose) { return pose.needle_direction.y; }},
    {"needle_direction_z", "z", "MISC", "n/a", [](const Pose& pose) { return pose.needle_direction.z; }},
    {"latency", "n/a", "LATENCY", "s", [](const Pose& pose) { return pose.t_s; }},
};

std::string letters_and_digits(const std::string& text) {
  std::string label;
  for (const char c : text)
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) label += c;
  return label;
}

std::int64_t channels_of(std::string_view type) {
  return std::count_if(std::begin(kChannels), std::end(kChannels),
                       [&](const Channel& one) { return type == one.type; });
}

std::string rows_text(const cases::Recording& recording) {
  std::string text;
  for (const Pose& pose : recording.poses)
    for (const Channel& one : kChannels) {
      char digits[32];
      text.append(digits, std::to_chars(std::begin(digits), std::end(digits), one.cell(pose)).ptr);
      text += &one == std::end(kChannels) - 1 ? '\n' : '\t';
    }
  return text;
}

std::string channels_text() {
  std::string text = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  for (const Channel& one : kChannels)
    text += std::string(one.name) + "\t" + one.component + "\t" + one.type + "\tneedle\t" + one.units + "\t" +
            (std::string_view(one.type) == "LATENCY" ? "n/a" : "patient") + "\n";
  return text;
}

std::string motion_json() {
  const Json json = {{"TaskName", "puncture"},
                     {"TaskDescription", "An image-guided needle puncture of a virtual patient"},
                     {"SamplingFrequency", 100},
                     {"TrackingSystemName", "needle"},
                     {"Manufacturer", "Seldinger (a simulator)"},
                     {"TrackedPointsCount", 1},
                     {"MotionChannelCount", std::size(kChannels)},
                     {"POSChannelCount", channels_of("POS")},
                     {"MISCChannelCount", channels_of("MISC")},
                     {"LATENCYChannelCount", channels_of("LATENCY")}};
  return json.dump(2) + "\n";
}

std::string frames_json() {
  const Json json = {{"reference_frame",
                      {{"Levels",
                        {{"patient",
                          {{"SpatialAxes", "LBU"},
                           {"RotationRule", "n/a"},
                           {"RotationOrder", "n/a"},
                           {"Description",
                            "The patient's LPS in millimetres: x to the patient's left, y to the back, z to the "
                            "head. Directions are "
                            "unit vectors from hub to tip."}}}}}}}};
  return json.dump(2) + "\n";
}

}  // namespace

std::string bids_subject(const std::string& person) {
  return "sub-" + (person.empty() ? "simulated" : letters_and_digits(person));
}

std::vector<FormatFile> motion_bids_files(const std::string& person, const std::string& attempt,
                                          const cases::Recording& recording) {
  const std::string subject = bids_subject(person);
  const std::string name =
      kRoot + subject + "/motion/" + subject + "_task-puncture_tracksys-needle_acq-" + letters_and_digits(attempt);
  return {{name + "_motion.tsv", rows_text(recording)},
          {name + "_motion.json", motion_json()},
          {name + "_channels.tsv", channels_text()},
          {name + "_channels.json", frames_json()}};
}

std::vector<FormatFile> motion_bids_head(const std::vector<std::string>& subjects) {
  const Json description = {{"Name", "Attempts at simulated punctures"},
                            {"BIDSVersion", "1.9.0"},
                            {"DatasetType", "raw"},
                            {"GeneratedBy", {{{"Name", "Seldinger"}}}}};
  std::string participants = "participant_id\n";
  for (const std::string& one : std::set<std::string>(subjects.begin(), subjects.end())) participants += one + "\n";
  return {{std::string(kRoot) + "dataset_description.json", description.dump(2) + "\n"},
          {std::string(kRoot) + "participants.tsv", participants},
          {std::string(kRoot) + "README",
           "Attempts at simulated punctures. Training data: nothing here is about a patient's procedure. "
           "attempts.csv of the same export has each attempt's conditions and metrics; its names are those of this "
           "data set, without the hyphen.\n"}};
}

}  // namespace seldinger::reports
