#include "casedb/attempts/condition_table.h"

#include <cmath>
#include <limits>

namespace seldinger::casedb {
namespace {

// From a field, at the end of a path of members, to a value and back, by the field's type.
template <auto... path>
ConditionValue read(const Conditions& from) {
  const auto& field = (from.*....*path);
  if (!field) return std::monostate{};
  using Held = std::remove_cvref_t<decltype(*field)>;
  if constexpr (std::is_same_v<Held, cases::HandKind>)
    return std::string(base::name_of(cases::kHandKindNames, *field));
  else if constexpr (std::is_same_v<Held, Handedness>)
    return std::string(base::name_of(kHandednessNames, *field));
  else if constexpr (std::is_same_v<Held, int>)
    return static_cast<double>(*field);
  else
    return *field;
}

template <auto... path>
bool write(Conditions& to, const ConditionValue& value) {
  auto& field = (to.*....*path);
  using Held = std::remove_cvref_t<decltype(*field)>;
  if (std::holds_alternative<std::monostate>(value)) {
    field.reset();
    return true;
  }
  const auto take = [&field](auto found) {
    if (found) field = *found;
    return found.has_value();
  };
  if constexpr (std::is_same_v<Held, cases::HandKind> || std::is_same_v<Held, Handedness>) {
    const std::string* name = std::get_if<std::string>(&value);
    if (name == nullptr) return false;
    if constexpr (std::is_same_v<Held, Handedness>)
      return take(base::from_name(kHandednessNames, *name));
    else
      return take(base::from_name(cases::kHandKindNames, *name));
  } else if constexpr (std::is_same_v<Held, int>) {
    const double* number = std::get_if<double>(&value);
    if (number == nullptr || std::abs(*number) > std::numeric_limits<int>::max() || std::trunc(*number) != *number)
      return false;
    field = static_cast<int>(*number);
    return true;
  } else {
    const Held* held = std::get_if<Held>(&value);
    if (held == nullptr) return false;
    if constexpr (std::is_same_v<Held, double>)
      if (!std::isfinite(*held)) return false;
    field = *held;
    return true;
  }
}

template <typename Held>
constexpr ConditionKind kind_of() {
  if constexpr (std::is_same_v<Held, bool>)
    return ConditionKind::flag;
  else if constexpr (std::is_same_v<Held, int>)
    return ConditionKind::whole;
  else if constexpr (std::is_same_v<Held, double>)
    return ConditionKind::number;
  else
    return ConditionKind::text;
}

struct About {
  const char* about;
  const char* missing = "not recorded";
};

template <auto... path>
constexpr ConditionRow row(const char* id, const char* words, const char* unit, About about) {
  using Held = std::remove_cvref_t<decltype(*(std::declval<const Conditions&>().*....*path))>;
  return {id, words, kind_of<Held>(), unit, about.about, about.missing, &read<path...>, &write<path...>};
}

constexpr const char* kHands =
    "by which hand it was led at first: mouse (with keys), gamepad, space_mouse (a 3-D mouse), arm (with force "
    "feedback) or simulated; changes are events";
constexpr const char* kArm = "no arm led it, or not recorded";
constexpr const char* kOfWindow = "a simulated operator's attempt, or not recorded";
constexpr const char* kNoPlan = "no path was planned before the room, or not recorded";
constexpr const char* kNotByPictures = "a simulated operator's attempt, no live picture was shown, or not recorded";

constexpr ConditionRow kRows[] = {
    row<&Conditions::needle_hand>("needle_hand", "Needle", "", {kHands}),
    row<&Conditions::probe_hand>("probe_hand", "Probe", "", {kHands}),
    row<&Conditions::hand_changes>("hand_changes", "Changes of hand", "count",
                                   {"how often another hand took up needle or probe during the attempt"}),
    row<&Conditions::needle_arm>("needle_arm", "Needle's arm", "",
                                 {"model of the arm that was set up for the needle", kArm}),
    row<&Conditions::probe_arm>("probe_arm", "Probe's arm", "",
                                {"model of the arm that was set up for the probe", kArm}),
    row<&Conditions::handedness>(
        "handedness", "Needle hand", "",
        {"the hand for the needle, as the workstation was set up: left or right", kOfWindow}),
    row<&Conditions::guide_used>("guide_used", "Needle guide used", "",
                                 {"1: the needle guide was taken up, however briefly"}),
    row<&Conditions::guide_share>("guide_share", "Time with the guide", "share",
                                  {"of the recorded time, with the needle guide taken up"}),
    row<&Conditions::help_level>("help_level", "Help in the room", "",
                                 {"2: the needle's line, the picture's plane and whether tip and target are in the "
                                  "picture are shown, in drills "
                                  "with hints; 1: without the needle's line, hints without numbers; 0: none",
                                  kOfWindow}),
    row<&Conditions::pauses>("pauses", "Pauses", "count", {"how often the attempt was paused"}),
    row<&Conditions::paused_s>(
        "paused_s", "Paused for", "s",
        {"all pauses together by the wall's clock; duration_s and every time of the attempt are without"}),
    row<&Conditions::begun_again>(
        "begun_again", "Stopped to begin again", "",
        {"1: it was stopped in order to begin the case again", "it was interrupted, or not recorded"}),
    row<&Conditions::expert_replays>(
        "expert_replays", "Expert replays watched before", "count",
        {"how often the person had watched somebody else's attempt at any version of the case before", kOfWindow}),
    row<&Conditions::own_replays>("own_replays", "Own replays watched before", "count",
                                  {"the same of the person's own attempts", kOfWindow}),
    row<&Conditions::planned_entry, &LpsPlace::x_mm>(
        "planned_entry_x_mm", "Planned entry, x", "mm",
        {"of the place on the skin where the trainee planned to go in, in the patient's LPS", kNoPlan}),
    row<&Conditions::planned_entry, &LpsPlace::y_mm>("planned_entry_y_mm", "Planned entry, y", "mm",
                                                     {"the same, y", kNoPlan}),
    row<&Conditions::planned_entry, &LpsPlace::z_mm>("planned_entry_z_mm", "Planned entry, z", "mm",
                                                     {"the same, z", kNoPlan}),
    row<&Conditions::planned_tip, &LpsPlace::x_mm>(
        "planned_tip_x_mm", "Planned tip, x", "mm",
        {"of where the trainee planned the tip to be when the needle is fired or said to be there, in LPS",
         kNoPlan}),
    row<&Conditions::planned_tip, &LpsPlace::y_mm>("planned_tip_y_mm", "Planned tip, y", "mm",
                                                   {"the same, y", kNoPlan}),
    row<&Conditions::planned_tip, &LpsPlace::z_mm>("planned_tip_z_mm", "Planned tip, z", "mm",
                                                   {"the same, z", kNoPlan}),
    row<&Conditions::picture_method>(
        "picture_method", "Pictures by", "",
        {"how the guidance's pictures were made, at last: \"scatterers, GPU\"", kOfWindow}),
    row<&Conditions::speckle_fallback>(
        "speckle_fallback", "Simplified speckle", "",
        {"1: the machine was too slow for the ultrasound's scatterers, and a lattice took their place",
         "another modality, or not recorded"}),
    row<&Conditions::picture_rate_hz>(
        "picture_rate_hz_shown", "Pictures shown", "Hz",
        {"the guidance's pictures that were shown, a second of the wall's clock without pauses", kOfWindow}),
    row<&Conditions::window_rate_hz>(
        "window_rate_hz", "Window's frames", "Hz",
        {"frames of the window, a second of the wall's clock without pauses", kOfWindow}),
    row<&Conditions::force_lag, &LagQuantiles::p50_ms>(
        "force_lag_p50_ms", "Hand to servo, median", "ms",
        {"from the window's reading of mouse, keys and their like to the tick that took it in, median", kOfWindow}),
    row<&Conditions::force_lag, &LagQuantiles::p95_ms>("force_lag_p95_ms", "Hand to servo, 95 %", "ms",
                                                       {"the same, 95th percentile", kOfWindow}),
    row<&Conditions::force_lag, &LagQuantiles::most_ms>("force_lag_max_ms", "Hand to servo, longest", "ms",
                                                        {"the same, the longest", kOfWindow}),
    row<&Conditions::room_lag, &LagQuantiles::p50_ms>(
        "room_lag_p50_ms", "Hand to room, median", "ms",
        {"from that reading to the room's frame on the screen, median", kOfWindow}),
    row<&Conditions::room_lag, &LagQuantiles::p95_ms>("room_lag_p95_ms", "Hand to room, 95 %", "ms",
                                                      {"the same, 95th percentile", kOfWindow}),
    row<&Conditions::room_lag, &LagQuantiles::most_ms>("room_lag_max_ms", "Hand to room, longest", "ms",
                                                       {"the same, the longest", kOfWindow}),
    row<&Conditions::picture_lag, &LagQuantiles::p50_ms>(
        "picture_lag_p50_ms", "Hand to picture, median", "ms",
        {"from that reading to the guidance's live picture on the screen, median", kNotByPictures}),
    row<&Conditions::picture_lag, &LagQuantiles::p95_ms>("picture_lag_p95_ms", "Hand to picture, 95 %", "ms",
                                                         {"the same, 95th percentile", kNotByPictures}),
    row<&Conditions::picture_lag, &LagQuantiles::most_ms>("picture_lag_max_ms", "Hand to picture, longest", "ms",
                                                          {"the same, the longest", kNotByPictures}),
    row<&Conditions::sound>("sound", "Sound", "",
                            {"1: at some time of the attempt sounds could be heard", kOfWindow}),
    row<&Conditions::stereo>("stereo", "Room in stereo", "",
                             {"1: at some time of the attempt the room was drawn for two eyes", kOfWindow}),
    row<&Conditions::window_width_px>("window_width_px", "Window's width", "px",
                                      {"of the window, at last", kOfWindow}),
    row<&Conditions::window_height_px>("window_height_px", "Window's height", "px",
                                       {"of the window, at last", kOfWindow}),
    row<&Conditions::station>(
        "station", "Station", "",
        {"the workstation, by the name that it was given (train --station-name); exports call "
         "it W- and a number",
         "a simulated operator's attempt, or not recorded"}),
};

}  // namespace

std::span<const ConditionRow> condition_rows() {
  return kRows;
}

const ConditionRow* find_condition(std::string_view id) {
  for (const ConditionRow& row : kRows)
    if (row.id == id) return &row;
  return nullptr;
}

}  // namespace seldinger::casedb
