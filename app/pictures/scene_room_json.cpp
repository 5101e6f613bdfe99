#include "app/pictures/scene_fields_json.h"

namespace seldinger::app {
namespace {

template <typename Names>
std::vector<std::string> words(const Names& names) {
  return {names.begin(), names.end()};
}

HeldProbe read_held_probe(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view.probe", error);
  std::vector<std::string> names;
  for (const imaging::Probe& probe : imaging::kProbes) names.emplace_back(probe.name);
  HeldProbe probe;
  probe.name = reader.choice("name", names, "C5-2v");
  probe.origin_lps_mm = reader.point("origin_mm");
  probe.axial = reader.unit("axial");
  probe.lateral = reader.unit_across("lateral", probe.axial);
  probe.press_mm = reader.number("press_mm", 0.0, 30.0, 0.0);
  reader.unused(unused);
  return probe;
}

cases::CArm read_arm(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view.arm", error);
  cases::CArm arm;
  arm.lao_deg = reader.number("lao_deg", -180.0, 180.0, 0.0);
  arm.cranial_deg = reader.number("cranial_deg", -90.0, 90.0, 0.0);
  arm.sid_mm = reader.number("sid_mm", 900.0, 1200.0, arm.sid_mm);
  reader.unused(unused);
  return arm;
}

}  // namespace

RoomSceneView read_room(const Json& json, base::Error& error, std::vector<std::string>& unused) {
  SceneReader reader(json, "view", error);
  reader.has("kind");
  RoomSceneView view;
  view.from = *imaging::room_view_named(reader.choice("from", words(imaging::kRoomViewNames), "operator_side"));
  if (reader.has("orbit_right_deg") || reader.has("orbit_up_deg"))
    view.orbit_deg = {reader.number("orbit_right_deg", -360.0, 360.0, 0.0),
                      reader.number("orbit_up_deg", -180.0, 180.0, 0.0)};
  view.zoom = reader.number("zoom", 0.1, 10.0, 1.0);
  if (reader.has("size_px")) {
    const auto size = reader.wholes<2>("size_px", kMaxPixels);
    view.width_px = size[0];
    view.height_px = size[1];
  }
  view.stereo = reader.flag("stereo");
  if (view.stereo && view.width_px < 2) reader.bad("size_px", "is too narrow for two eyes");
  view.mentor = reader.flag("mentor");
  view.help = reader.whole("help", 0, 3, 0);
  if (reader.has("quality")) view.fine = reader.choice("quality", {"fine", "fast"}, nullptr) == "fine";
  if (reader.has("position")) {
    const auto names = words(base::kNamesOf<cases::kPatientPositionNames>);
    const std::string position = reader.choice("position", names, nullptr);
    view.position = *base::from_name(cases::kPatientPositionNames, position);
  }
  if (reader.has("nick_mm")) view.nick_lps_mm = reader.point("nick_mm");
  if (reader.has("probe")) view.probe = read_held_probe(reader["probe"], error, unused);
  if (reader.has("arm")) view.arm = read_arm(reader["arm"], error, unused);
  if (view.probe && view.arm) reader.bad("arm", "stands beside probe");
  reader.unused(unused);
  return view;
}

}  // namespace seldinger::app
