#include "casedb/cases/structure_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLeastRadiusMm = 0.1, kMostRadiusMm = 500.0;  // a capillary is nothing to hit, no body is larger
constexpr double kFarthestMm = 2e6;                            // no volume that import takes reaches there
constexpr std::size_t kMostPoints = 1000;
const base::Error kBad{
    "bad_geometry",
    "a drawn structure is a sphere, an ellipsoid or a tube with coordinates within 2 km and radii from "
    "0.1 to 500 mm"};

Json json_of(const glm::dvec3& p) {
  return Json::array({p.x, p.y, p.z});
}

std::optional<glm::dvec3> point_of(const Json& json) {
  if (!json.is_array() || json.size() != 3) return std::nullopt;
  glm::dvec3 p;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!json[axis].is_number()) return std::nullopt;
    p[static_cast<int>(axis)] = json[axis].get<double>();
  }
  return p;
}

bool near(const glm::dvec3& p) {
  return std::abs(p.x) <= kFarthestMm && std::abs(p.y) <= kFarthestMm && std::abs(p.z) <= kFarthestMm;
}
bool sound(double radius_mm) {
  return radius_mm >= kLeastRadiusMm && radius_mm <= kMostRadiusMm;
}

bool sound(const cases::Sphere& sphere) {
  return near(sphere.center_lps_mm) && sound(sphere.radius_mm);
}
bool sound(const cases::Ellipsoid& one) {
  return near(one.center_lps_mm) && sound(one.radii_mm.x) && sound(one.radii_mm.y) && sound(one.radii_mm.z);
}
bool sound(const cases::Tube& tube) {
  if (tube.points_lps_mm.empty() || tube.points_lps_mm.size() > kMostPoints || !sound(tube.radius_mm)) return false;
  for (const glm::dvec3& point : tube.points_lps_mm)
    if (!near(point)) return false;
  return true;
}
bool sound(const cases::VoxelSet&) {
  return false;  // not drawn
}

}  // namespace

base::Result<void> check_drawn(const cases::Shape& shape) {
  if (!std::visit([](const auto& one) { return sound(one); }, shape)) return kBad;
  return {};
}

std::string json_of_shape(const cases::Shape& shape) {
  Json json;
  if (const auto* sphere = std::get_if<cases::Sphere>(&shape)) {
    json = {{"kind", "sphere"}, {"center_mm", json_of(sphere->center_lps_mm)}, {"radius_mm", sphere->radius_mm}};
  } else if (const auto* ellipsoid = std::get_if<cases::Ellipsoid>(&shape)) {
    json = {{"kind", "ellipsoid"},
            {"center_mm", json_of(ellipsoid->center_lps_mm)},
            {"radii_mm", json_of(ellipsoid->radii_mm)}};
  } else {
    const auto* tube = std::get_if<cases::Tube>(&shape);
    CHECK(tube != nullptr);
    Json points = Json::array();
    for (const glm::dvec3& point : tube->points_lps_mm) points.push_back(json_of(point));
    json = {{"kind", "tube"}, {"points_mm", points}, {"radius_mm", tube->radius_mm}};
  }
  return json.dump();
}

base::Result<cases::Shape> shape_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return kBad;
  const Json none;
  const auto field = [&](const char* name) -> const Json& { return json.contains(name) ? json.at(name) : none; };
  const Json& kind = field("kind");
  const double radius_mm = field("radius_mm").is_number() ? field("radius_mm").get<double>() : 0.0;
  cases::Shape shape;
  if (kind == "sphere" || kind == "ellipsoid") {
    const auto center = point_of(field("center_mm"));
    if (!center) return kBad;
    if (kind == "sphere") {
      shape = cases::Sphere{*center, radius_mm};
    } else {
      const auto radii = point_of(field("radii_mm"));
      if (!radii) return kBad;
      shape = cases::Ellipsoid{*center, *radii};
    }
  } else if (kind == "tube") {
    cases::Tube tube{{}, radius_mm};
    if (!field("points_mm").is_array()) return kBad;
    for (const Json& one : field("points_mm")) {
      const auto point = point_of(one);
      if (!point) return kBad;
      tube.points_lps_mm.push_back(*point);
    }
    shape = std::move(tube);
  } else {
    return kBad;
  }
  if (const auto fit = check_drawn(shape); !fit) return fit.error();
  return shape;
}

}  // namespace seldinger::casedb
