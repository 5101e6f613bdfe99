#include "app/pictures/render_json.h"

#include "casedb/database/values_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {
namespace {

using casedb::text;

}  // namespace

std::string json_of_room(const ColourPicture& picture) {
  return text({{"backend", "gpu"},
               {"renderer", picture.renderer},
               {"size_px", nlohmann::ordered_json::array({picture.width_px, picture.height_px})},
               {"triangles", picture.triangles}});
}

std::string json_of_picture(const ScenePicture& picture, double min, double max) {
  nlohmann::ordered_json json = {
      {"backend", picture.backend},
      {"size_px", nlohmann::ordered_json::array({picture.plane.width_px, picture.plane.height_px})},
      {"min", min},
      {"max", max},
      {"unit", picture.unit},
      {"visible", nullptr}};
  if (picture.frame_rate_hz) json["frame_rate_hz"] = *picture.frame_rate_hz;
  if (picture.colour_mm_s) json["colour_scale_cm_s"] = 0.1 * *picture.colour_mm_s;
  if (const auto& visible = picture.visible)
    json["visible"] = {{"needle_tip", visible->needle_tip},
                       {"needle_length_mm", visible->needle_length_mm},
                       {"target", visible->target},
                       {"joint", visible->joint}};
  return text(json);
}

}  // namespace seldinger::app
