#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/file.h"
#include "app/hands/station.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kFormat = 1;
// The board's points and the box's; more is no calibration of ours.
constexpr std::size_t kMostPoints = 6;

Json numbers(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json json_of(const StationDevice& device) {
  const devices::Calibration& calibration = device.calibration;
  Json rotation = Json::array(), points = Json::array();
  const devices::Placement& placement = calibration.template_from_device;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation.push_back(placement.rotation[column][row]);
  for (const devices::Calibration::Point& point : calibration.points)
    points.push_back({{"point", point.taken.name},
                      {"device_mm", numbers(point.taken.device_mm)},
                      {"residual_mm", point.residual_mm}});
  Json json = {
      {"template_from_device",
       {{"scale", placement.scale}, {"rotation", rotation}, {"translation_mm", numbers(placement.translation_mm)}}},
      {"residual_rms_mm", calibration.residual_rms_mm},
      {"residual_max_mm", calibration.residual_max_mm},
      {"points", points}};
  if (!device.ids.arm.empty()) json["device_id"] = device.ids.arm;
  if (!device.ids.grip.empty()) json["grip_id"] = device.ids.grip;
  if (device.gains != devices::DeviceGains{})
    json["gains"] = {{"motion_scale", device.gains.motion_scale},
                     {"force_share", device.gains.force_share},
                     {"most_force_n", device.gains.most_force_n}};
  return json;
}

// Throws Json::exception where a field is missing or of another kind.
glm::dvec3 vector_of(const Json& json) {
  const auto values = json.get<std::array<double, 3>>();
  return {values[0], values[1], values[2]};
}

bool is_rotation(const glm::dmat3& m) {
  constexpr double kRounding = 1e-9;
  const glm::dmat3 square = glm::transpose(m) * m;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(square[column][row] - (row == column ? 1.0 : 0.0)) <= kRounding)) return false;
  return glm::determinant(m) > 0.0;
}

devices::Calibration calibration_of(const Json& json, bool& sound) {
  devices::Calibration calibration;
  const Json& placement = json.at("template_from_device");
  const auto rotation = placement.at("rotation").get<std::array<double, 9>>();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      calibration.template_from_device.rotation[column][row] = rotation[static_cast<std::size_t>(3 * row + column)];
  calibration.template_from_device.scale = placement.at("scale").get<double>();
  calibration.template_from_device.translation_mm = vector_of(placement.at("translation_mm"));
  calibration.residual_rms_mm = json.at("residual_rms_mm").get<double>();
  calibration.residual_max_mm = json.at("residual_max_mm").get<double>();
  sound = sound && json.at("points").is_array() && json.at("points").size() <= kMostPoints;
  for (const Json& point : json.at("points"))
    calibration.points.push_back({{point.at("point").get<std::string>(), vector_of(point.at("device_mm"))},
                                  point.at("residual_mm").get<double>()});
  const double scale = calibration.template_from_device.scale;
  sound = sound && is_rotation(calibration.template_from_device.rotation) && scale >= devices::kLeastScale &&
          scale <= devices::kMostScale && calibration.residual_max_mm <= devices::kMostResidualMm;
  return calibration;
}

devices::DeviceGains gains_of(const Json& device, bool& sound) {
  devices::DeviceGains gains;
  if (!device.contains("gains")) return gains;
  const Json& json = device.at("gains");
  gains.motion_scale = json.at("motion_scale").get<double>();
  gains.force_share = json.at("force_share").get<double>();
  gains.most_force_n = json.at("most_force_n").get<double>();
  sound = sound && devices::is_sound(gains);
  return gains;
}

}  // namespace

base::Result<Station> read_station(const std::filesystem::path& path) {
  const base::Error bad{"bad_station", "the station file is not one of this program's", {}};
  const auto text = read_text(path, 1U << 20U);
  if (!text) return text.error();
  Station station;
  bool sound = true;
  try {
    const Json json = Json::parse(*text);
    sound = json.at("format") == kFormat;
    for (const auto& [name, device] : json.at("devices").items()) {
      sound = sound && (name == "left" || name == "right");
      station[name] = {calibration_of(device, sound),
                       {device.value("device_id", ""), device.value("grip_id", "")},
                       gains_of(device, sound)};
    }
  } catch (const Json::exception&) {
    return bad;
  }
  if (!sound) return bad;
  return station;
}

std::string json_of_station(const Station& station) {
  Json devices = Json::object();
  for (const auto& [name, device] : station) devices[name] = json_of(device);
  return Json{{"format", kFormat}, {"devices", devices}}.dump(2) + "\n";
}

}  // namespace seldinger::app
