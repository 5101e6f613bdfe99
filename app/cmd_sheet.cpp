// sheet: scenes side by side. A sheet file names scenes as rows and changes to them as columns:
// {"title": "…", "columns": [{"name": "…", "set": {…}}, …], "rows": [{"name": "…", "scene": "FILE.json", "set":
// {…}}, …]} where `set` is merged into the scene (RFC 7396), the row's before the column's.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/file.h"
#include "app/png.h"
#include "app/scene_picture.h"
#include "reports/picture_sheet.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::json;
constexpr std::size_t kMostPictures = 400;

struct Place {
  std::string name;
  std::filesystem::path scene;  // rows only
  Json set;
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
    list.push_back({one["name"], scene.is_absolute() ? scene : folder / scene, set});
  }
  return list;
}

}  // namespace

int run_sheet(const Arguments& arguments) {
  const std::filesystem::path from = arguments.positional(0), out = arguments.required("--out");
  if (out.extension() != ".html") throw UsageError("--out must end in .html");
  const std::string library = arguments.text("--library");
  const auto text = read_text(from);
  if (!text) return refuse(text.error());
  const Json sheet = Json::parse(*text, nullptr, false);
  if (!sheet.is_object()) return refuse(bad("the sheet is not a JSON object"));
  const auto columns = places(sheet, "columns", false, from.parent_path()),
             rows = places(sheet, "rows", true, from.parent_path());
  if (!columns) return refuse(columns.error());
  if (!rows) return refuse(rows.error());
  if (columns->size() * rows->size() > kMostPictures) return refuse(bad("the sheet has too many pictures"));

  std::vector<std::string> names;
  for (const Place& column : *columns) names.push_back(column.name);
  std::vector<reports::SheetRow> pictures;
  std::string volume_told;
  std::optional<volume::Volume> volume;
  for (const Place& row : *rows) {
    const auto scene_text = read_text(row.scene);
    if (!scene_text) return refuse(scene_text.error());
    Json of_row = Json::parse(*scene_text, nullptr, false);
    if (!of_row.is_object()) return refuse({"bad_scene", "the scene of " + row.name + " is not a JSON object", {}});
    of_row.merge_patch(row.set);
    pictures.push_back({row.name, {}, {}});
    for (const Place& column : *columns) {
      Json json = of_row;
      json.merge_patch(column.set);
      std::vector<std::string> unused;
      const auto scene = scene_from_json(json.dump(), row.scene.parent_path(), unused);
      if (!scene) return refuse(scene.error());
      if (!scene->view) return refuse({"bad_scene", "scene.view is missing", {}});
      const std::string told = row.scene.parent_path().string() + json["volume"].dump();
      if (!volume || told != volume_told) {
        auto read = volume_of(*scene, library);
        if (!read) return refuse(read.error());
        volume = std::move(*read);
        volume_told = told;
      }
      const auto picture = render_scene(*volume, *scene, library, arguments.text("--backend"));
      if (!picture) return refuse(picture.error());
      pictures.back().png.push_back(
          png_from_grey(picture->grey, picture->plane.width_px, picture->plane.height_px));
      pictures.back().captions.push_back(picture->backend);
      std::fprintf(stderr, "%s, %s\n", row.name.c_str(), column.name.c_str());
    }
  }
  const std::string title =
      sheet.contains("title") && sheet["title"].is_string() ? sheet["title"] : Json("Pictures");
  write_file(out, reports::picture_sheet(title, names, pictures));
  std::printf("%zu pictures in %s\n", names.size() * pictures.size(), out.string().c_str());
  return kDone;
}

}  // namespace seldinger::app
