#include "web/json/replay_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoses = 1'200;

Json vector_json(const glm::dvec3& vector, double per_unit) {
  // A whole number over a power of ten prints as few digits as it has.
  Json json = Json::array();
  for (int i = 0; i < 3; ++i) json.push_back(std::round(vector[i] * per_unit) / per_unit);
  return json;
}

bool is_finite(const cases::PoseSample& pose) {
  for (const glm::dvec3& vector : {pose.tip_at_rest_lps_mm(), pose.needle_direction, pose.probe_origin_lps_mm,
                                   pose.probe_axial, pose.probe_lateral})
    if (!std::isfinite(vector.x) || !std::isfinite(vector.y) || !std::isfinite(vector.z)) return false;
  return std::isfinite(pose.t_s);
}

// Of the poses that can be drawn, every k-th, the last, and the one in which it fired.
std::vector<const cases::PoseSample*> thinned(const cases::Recording& recording) {
  std::vector<const cases::PoseSample*> all;
  for (const cases::PoseSample& pose : recording.poses)
    if (is_finite(pose)) all.push_back(&pose);
  const std::size_t each = std::max<std::size_t>(1, (all.size() + kMostPoses - 3) / (kMostPoses - 2));
  const double fired_s = recording.endpoint ? recording.endpoint->t_s : -1.0;
  std::vector<const cases::PoseSample*> some;
  bool fired = fired_s < 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool fires = !fired && all[i]->t_s >= fired_s;
    fired = fired || fires;
    if (i % each == 0 || fires || i + 1 == all.size()) some.push_back(all[i]);
  }
  return some;
}

}  // namespace

std::string replay_json(const casedb::AttemptRow& row, const cases::Recording& recording) {
  Json json;
  json["attempt_id"] = row.attempt_id;
  json["target"] = {{"center_mm", vector_json(row.lesion.center_lps_mm, 10.0)},
                    {"radius_mm", row.lesion.radius_mm}};
  json["needle_mm"] = row.instrument.length_mm;
  // A fluoroscope's picture lies in no plane under a probe.
  json["picture_mm"] =
      row.picture.modality == cases::Modality::xray ? Json() : Json{row.picture.width_mm, row.picture.depth_mm};
  json["fired_s"] = recording.endpoint ? Json(recording.endpoint->t_s) : Json();
  for (const char* key :
       {"t_s", "tip_mm", "needle_direction", "probe_mm", "probe_axial", "probe_lateral", "tip_seen"})
    json[key] = Json::array();
  std::size_t frame = 0;
  bool seen = false;
  for (const cases::PoseSample* pose : thinned(recording)) {
    for (; frame < recording.frames.size() && recording.frames[frame].t_s <= pose->t_s; ++frame)
      seen = recording.frames[frame].live && recording.frames[frame].needle_tip;
    json["t_s"].push_back(std::round(pose->t_s * 100.0) / 100.0);
    json["tip_mm"].push_back(vector_json(pose->tip_at_rest_lps_mm(), 10.0));
    json["needle_direction"].push_back(vector_json(pose->needle_direction, 1'000.0));
    json["probe_mm"].push_back(vector_json(pose->probe_origin_lps_mm, 10.0));
    json["probe_axial"].push_back(vector_json(pose->probe_axial, 1'000.0));
    json["probe_lateral"].push_back(vector_json(pose->probe_lateral, 1'000.0));
    json["tip_seen"].push_back(seen);
  }
  return json.dump() + "\n";
}

}  // namespace seldinger::web
