#include "reports/export/formats/slicer_json.h"

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include "sim/case/skin_passage.h"

namespace seldinger::reports {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(const std::string& id, const std::string& label, const glm::dvec3& at) {
  return {{"id", id},       {"label", label},     {"position", {at.x, at.y, at.z}}, {"selected", true},
          {"locked", true}, {"visibility", true}, {"positionStatus", "defined"}};
}

std::string markup_text(const char* type, const std::string& name, bool synthetic, const Json& points) {
  const Json markup = {{"type", type},
                       {"name", synthetic ? name + ", simulated" : name},
                       {"synthetic", synthetic},
                       {"coordinateSystem", "LPS"},
                       {"coordinateUnits", "mm"},
                       {"locked", true},
                       {"controlPoints", points}};
  const Json all = {{"@schema",
                     "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
                     "Schema/markups-schema-v1.0.3.json#"},
                    {"markups", {markup}}};
  return all.dump(1) + "\n";
}

std::vector<glm::dvec3> entries_of(const cases::Recording& recording, const cases::MeshIndex& skin) {
  std::vector<glm::dvec3> entries;
  cases::SkinPassage passage;
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    const cases::PoseSample& pose = recording.poses[i];
    const bool was_in = i > 0 && passage.in_body;
    if (i == 0)
      passage = cases::start_passage(skin, pose.tip_at_rest_lps_mm(), pose.needle_direction);
    else
      cases::advance_passage(skin, pose.tip_at_rest_lps_mm(), passage);
    if (passage.in_body && !was_in) entries.push_back(passage.entry_lps_mm);
  }
  return entries;
}

Json way_json(const cases::Recording& recording) {
  Json points = Json::array();
  glm::dvec3 last{0.0};
  for (std::size_t i = 0; i < recording.poses.size(); ++i) {
    const glm::dvec3& tip = recording.poses[i].tip_at_rest_lps_mm();
    if (i > 0 && i + 1 < recording.poses.size() && glm::distance(tip, last) < kSlicerStepMm) continue;
    last = tip;
    points.push_back(point_json(std::to_string(points.size() + 1), "", tip));
  }
  return points;
}

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(std::begin(text), std::end(text), value + 0.0).ptr};
}

// Turned about its own axis in some way: that is not recorded.
std::string transform_text(const glm::dvec3& tip, const glm::dvec3& direction, bool synthetic) {
  const glm::dvec3 z = glm::normalize(direction);
  const glm::dvec3 across = std::abs(z.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 y = glm::normalize(glm::cross(z, across)), x = glm::cross(y, z);
  std::string text = "#Insight Transform File V1.0\n#Transform 0\n";
  if (synthetic) text += "# SIMULATED: a simulated operator moved the hands\n";
  text += "Transform: AffineTransform_double_3_3\nParameters:";
  for (const glm::dvec3& row : {x, y, z})
    for (int i = 0; i < 3; ++i) text += " " + shortest(row[i]);
  for (const glm::dvec3& row : {x, y, z}) text += " " + shortest(-glm::dot(row, tip));
  return text + "\nFixedParameters: 0 0 0\n";
}

}  // namespace

std::vector<FormatFile> slicer_files(const std::string& attempt, bool synthetic, const cases::Recording& recording,
                                     const glm::dvec3& target_lps_mm, const cases::MeshIndex& skin) {
  if (recording.poses.empty()) return {};
  const cases::PoseSample& last = recording.poses.back();
  const auto& endpoint = recording.endpoint;
  const glm::dvec3 tip = endpoint ? endpoint->tip_at_rest_lps_mm() : last.tip_at_rest_lps_mm();
  Json points = Json::array({point_json("1", "target", target_lps_mm)});
  for (const glm::dvec3& entry : entries_of(recording, skin))
    points.push_back(point_json(std::to_string(points.size() + 1), "entry", entry));
  points.push_back(point_json(std::to_string(points.size() + 1), endpoint ? "endpoint" : "last tip", tip));
  const std::string name = "slicer/" + attempt;
  return {{name + "_points.mrk.json", markup_text("Fiducial", attempt + " points", synthetic, points)},
          {name + "_path.mrk.json", markup_text("Curve", attempt + " path", synthetic, way_json(recording))},
          {name + "_needle.tfm",
           transform_text(tip, endpoint ? endpoint->direction : last.needle_direction, synthetic)}};
}

}  // namespace seldinger::reports
