#include "sim/devices/arms/haply_json.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "sim/base/vectors.h"

namespace seldinger::devices {
namespace {

using Json = nlohmann::ordered_json;

// Beyond a metre no desktop arm reaches; ids are short words; no station has more devices.
constexpr double kMostReachM = 1.0;
constexpr std::size_t kMostIdChars = 64, kMostDevices = 8;
constexpr const char* kButtons[] = {"a", "b", "c"};

const Json* member(const Json& json, const char* name) {
  if (!json.is_object()) return nullptr;
  const auto at = json.find(name);
  return at == json.end() ? nullptr : &*at;
}

std::optional<double> number(const Json& json, const char* name) {
  const Json* const value = member(json, name);
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const double d = value->get<double>();
  return std::isfinite(d) ? std::optional(d) : std::nullopt;
}

std::string word(const Json& json, const char* name) {
  const Json* const value = member(json, name);
  if (value == nullptr || !value->is_string()) return {};
  const auto& text = value->get_ref<const std::string&>();
  return text.size() <= kMostIdChars ? text : std::string();
}

std::optional<glm::dvec3> vector(const Json* json) {
  if (json == nullptr) return std::nullopt;
  const auto x = number(*json, "x"), y = number(*json, "y"), z = number(*json, "z");
  if (!x || !y || !z) return std::nullopt;
  return glm::dvec3(*x, *y, *z);
}

std::optional<glm::dmat3> rotation(const Json* json) {
  const auto v = vector(json);
  const auto w = json == nullptr ? std::nullopt : number(*json, "w");
  if (!v || !w) return std::nullopt;
  const double length2 = glm::dot(*v, *v) + *w * *w;
  if (!(length2 > 0.25 && length2 < 4.0)) return std::nullopt;
  const double s = 1.0 / std::sqrt(length2), x = v->x * s, y = v->y * s, z = v->z * s, c = *w * s;
  return glm::dmat3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * c), 2.0 * (x * z - y * c),  //
                    2.0 * (x * y - z * c), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * c),  //
                    2.0 * (x * z + y * c), 2.0 * (y * z - x * c), 1.0 - 2.0 * (x * x + y * y));
}

Json quaternion(const glm::dmat3& m) {
  // Of the four, the greatest first: no root of little (Shepperd, J. Guidance and Control 1, 1978).
  const double trace = m[0][0] + m[1][1] + m[2][2];
  double q[4];  // x, y, z, w
  int best = 3;
  double most = trace;
  for (int i = 0; i < 3; ++i)
    if (m[i][i] > most) {
      most = m[i][i];
      best = i;
    }
  if (best == 3) {
    const double s = 2.0 * std::sqrt(1.0 + trace);
    q[3] = 0.25 * s;
    q[0] = (m[1][2] - m[2][1]) / s;
    q[1] = (m[2][0] - m[0][2]) / s;
    q[2] = (m[0][1] - m[1][0]) / s;
  } else {
    const int i = best, j = (i + 1) % 3, k = (i + 2) % 3;
    const double s = 2.0 * std::sqrt(1.0 + m[i][i] - m[j][j] - m[k][k]);
    q[i] = 0.25 * s;
    q[3] = (m[j][k] - m[k][j]) / s;
    q[j] = (m[i][j] + m[j][i]) / s;
    q[k] = (m[i][k] + m[k][i]) / s;
  }
  return {{"x", q[0]}, {"y", q[1]}, {"z", q[2]}, {"w", q[3]}};
}

Json numbers(const glm::dvec3& v) {
  return {{"x", v.x}, {"y", v.y}, {"z", v.z}};
}

std::optional<Json> parsed(std::string_view text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_object() ? std::optional(std::move(json)) : std::nullopt;
}

template <class Each>
void each_device(const Json& json, const char* kind, Each each) {
  const Json* const list = member(json, kind);
  if (list == nullptr || !list->is_array()) return;
  std::size_t count = 0;
  for (const Json& device : *list) {
    if (++count > kMostDevices) return;
    const std::string id = word(device, "device_id");
    if (!id.empty()) each(device, id);
  }
}

}  // namespace

std::optional<HaplyMessage> haply_message(std::string_view text) {
  const auto json = parsed(text);
  if (!json) return std::nullopt;
  HaplyMessage message;
  each_device(*json, "inverse3", [&](const Json& device, const std::string& id) {
    HaplyMessage::Arm arm{id, {}, {}};
    if (const Json* const config = member(device, "config")) arm.handedness = word(*config, "handedness");
    if (const Json* const state = member(device, "state"))
      arm.position_m = vector(member(*state, "cursor_position"));
    if (arm.position_m && !(glm::length(*arm.position_m) <= kMostReachM)) arm.position_m.reset();
    message.arms.push_back(std::move(arm));
  });
  // A grip with a cable says the same under another name.
  for (const char* const kind : {"wireless_verse_grip", "verse_grip"})
    each_device(*json, kind, [&](const Json& device, const std::string& id) {
      HaplyMessage::Grip grip{id, {}, {}};
      if (const Json* const state = member(device, "state")) {
        grip.orientation = rotation(member(*state, "orientation"));
        if (const Json* const buttons = member(*state, "buttons"))
          for (std::size_t i = 0; i < std::size(kButtons); ++i) {
            const Json* const button = member(*buttons, kButtons[i]);
            grip.buttons[i] = button != nullptr && button->is_boolean() && button->get<bool>();
          }
      }
      message.grips.push_back(std::move(grip));
    });
  return message;
}

std::string text_of(const HaplyMessage& message) {
  Json arms = Json::array(), grips = Json::array();
  for (const HaplyMessage::Arm& arm : message.arms) {
    Json device{{"device_id", arm.id}};
    if (!arm.handedness.empty()) device["config"] = {{"handedness", arm.handedness}};
    if (arm.position_m) device["state"] = {{"cursor_position", numbers(*arm.position_m)}};
    arms.push_back(std::move(device));
  }
  for (const HaplyMessage::Grip& grip : message.grips) {
    Json buttons = Json::object();
    for (std::size_t i = 0; i < std::size(kButtons); ++i) buttons[kButtons[i]] = bool{grip.buttons[i]};
    Json state{{"buttons", std::move(buttons)}};
    if (grip.orientation) state["orientation"] = quaternion(*grip.orientation);
    grips.push_back({{"device_id", grip.id}, {"state", std::move(state)}});
  }
  return Json{{"inverse3", std::move(arms)}, {"wireless_verse_grip", std::move(grips)}}.dump();
}

std::string text_of(const std::vector<HaplyForce>& forces) {
  Json arms = Json::array();
  for (const HaplyForce& force : forces)
    arms.push_back(
        {{"device_id", force.id}, {"commands", {{"set_cursor_force", {{"values", numbers(force.force_n)}}}}}});
  return Json{{"inverse3", std::move(arms)}}.dump();
}

std::optional<std::vector<HaplyForce>> haply_forces(std::string_view text) {
  const auto json = parsed(text);
  if (!json || member(*json, "inverse3") == nullptr) return std::nullopt;
  std::vector<HaplyForce> forces;
  each_device(*json, "inverse3", [&](const Json& device, const std::string& id) {
    const Json* const commands = member(device, "commands");
    const Json* const force = commands == nullptr ? nullptr : member(*commands, "set_cursor_force");
    const auto values = force == nullptr ? std::nullopt : vector(member(*force, "values"));
    if (values) forces.push_back({id, *values});
  });
  return forces;
}

}  // namespace seldinger::devices
