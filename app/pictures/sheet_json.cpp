#include <nlohmann/json.hpp>

#include "app/cli/file.h"
#include "app/pictures/sheet.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::json;
constexpr std::size_t kMostPictures = 400;

struct Place {
  std::string name;
  std::filesystem::path scene;  // rows only
  Json set, minus;              // minus: null where there is none
};

base::Error bad(const std::string& what) {
  return {"bad_sheet", what, {}};
}

base::Result<std::vector<Place>> places(const Json& sheet, const char* field, bool with_scene,
                                        const std::filesystem::path& folder) {
  if (!sheet.contains(field) || !sheet[field].is_array() || sheet[field].empty())
    return bad(std::string("the sheet has no list of ") + field);
  std::vector<Place> list;
  for (const Json& one : sheet[field]) {
    const Json set = one.is_object() && one.contains("set") ? one["set"] : Json::object();
    if (!one.is_object() || !one.contains("name") || !one["name"].is_string() || !set.is_object() ||
        (with_scene && (!one.contains("scene") || !one["scene"].is_string())))
      return bad(std::string("an item of ") + field + (with_scene ? " has no name and scene" : " has no name"));
    const std::filesystem::path scene = with_scene ? one["scene"].get<std::string>() : std::string();
    const Json minus = one.contains("minus") ? one["minus"] : Json();
    if (!minus.is_null() && !minus.is_object()) return bad("a minus is not an object");
    list.push_back({one["name"], scene.is_absolute() ? scene : folder / scene, set, minus});
  }
  return list;
}

base::Result<Json> object_in(const std::filesystem::path& path, const char* code) {
  const auto text = read_text(path);
  if (!text) return text.error();
  Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) return base::Error{code, path.filename().string() + " is not a JSON object", {}};
  return json;
}

// Of a scene's structures those that are drawn into its volume.
Json drawn_of(const Json& scene) {
  Json drawn = Json::array();
  if (scene.contains("structures"))
    for (const Json& one : scene["structures"])
      if (one.contains("tissue")) drawn.push_back(one);
  return drawn;
}

}  // namespace

base::Result<Sheet> read_sheet(const std::filesystem::path& path) {
  const auto json = object_in(path, "bad_sheet");
  if (!json) return json.error();
  const auto columns = places(*json, "columns", false, path.parent_path()),
             rows = places(*json, "rows", true, path.parent_path());
  if (!columns) return columns.error();
  if (!rows) return rows.error();
  if (columns->size() * rows->size() > kMostPictures) return bad("the sheet has too many pictures");

  Sheet sheet;
  sheet.title = json->contains("title") && (*json)["title"].is_string() ? (*json)["title"] : Json("Pictures");
  for (const Place& column : *columns) sheet.columns.push_back(column.name);
  for (const Place& row : *rows) {
    auto of_row = object_in(row.scene, "bad_scene");
    if (!of_row) return of_row.error();
    of_row->merge_patch(row.set);
    sheet.rows.push_back({row.name, {}});
    for (const Place& column : *columns) {
      Json merged = *of_row;
      merged.merge_patch(column.set);
      const auto read = [&row](const Json& told) -> base::Result<Scene> {
        std::vector<std::string> unused;
        auto scene = scene_from_json(told.dump(), row.scene.parent_path(), unused);
        if (scene && !scene->view) return base::Error{"bad_scene", "scene.view is missing", {}};
        return scene;
      };
      auto scene = read(merged);
      if (!scene) return scene.error();
      const auto told = [&row](const Json& of) {
        return row.scene.parent_path().string() + of["volume"].dump() + drawn_of(of).dump();
      };
      const std::string volume_told = told(merged);
      sheet.rows.back().pictures.push_back({std::move(*scene), volume_told, std::nullopt});
      if (row.minus.is_null() && column.minus.is_null()) continue;
      if (!row.minus.is_null()) merged.merge_patch(row.minus);
      if (!column.minus.is_null()) merged.merge_patch(column.minus);
      auto minus = read(merged);
      if (!minus) return minus.error();
      if (told(merged) != volume_told) return bad("a picture and its minus differ in their volume");
      sheet.rows.back().pictures.back().minus = std::move(*minus);
    }
  }
  return sheet;
}

}  // namespace seldinger::app
