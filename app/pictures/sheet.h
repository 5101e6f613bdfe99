// A sheet: scenes side by side. A sheet file names scenes as rows and changes to them as columns:
// {"title": "…", "columns": [{"name": "…", "set": {…}}, …], "rows": [{"name": "…", "scene": "FILE.json", "set":
// {…}}, …]} where `set` is merged into the scene (RFC 7396), the row's before the column's. With a "minus" (of the
// row or the column, merged last) the picture is how far apart in grey the scene and the one with it are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/pictures/scene.h"

namespace seldinger::app {

struct SheetPicture {
  Scene scene;                   // with a view
  std::string volume_told;       // two pictures that tell the same show the same volume
  std::optional<Scene> minus{};  // with a view of the same kind and size
};
struct Sheet {
  struct Row {
    std::string name;
    std::vector<SheetPicture> pictures;  // one a column
  };
  std::string title;
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

// Refused as `bad_sheet` (what is missing or of the wrong kind), as reading a file, and as each scene is.
base::Result<Sheet> read_sheet(const std::filesystem::path& path);

}  // namespace seldinger::app
