// sheet: scenes side by side on one page.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "app/pictures/scene_picture.h"
#include "app/pictures/sheet.h"
#include "reports/sheets/picture_sheet.h"

namespace seldinger::app {
namespace {

int run_sheet(const Arguments& arguments) {
  const std::filesystem::path from = arguments.positional(0),
                              out = file_of("--out", arguments.required("--out"), {".html"});
  const std::string library = library_folder_if_any(arguments).string();
  const auto sheet = read_sheet(from);
  if (!sheet) return refuse(error_of("SHEET.json", arguments.positional(0), sheet.error()));

  std::vector<reports::SheetRow> pictures;
  std::string volume_told;
  std::optional<ScenePainter> painter;
  for (const Sheet::Row& row : sheet->rows) {
    pictures.push_back({row.name, {}, {}});
    for (const auto& [scene, told, minus] : row.pictures) {
      if (!painter || told != volume_told) {
        auto made = ScenePainter::of(scene, library);
        if (!made) return refuse(made.error());
        painter = std::move(*made);
        volume_told = told;
      }
      auto picture = painter->paint(scene, arguments.text("--backend"));
      if (!picture) return refuse(picture.error());
      if (minus) {
        const auto other = painter->paint(*minus, arguments.text("--backend"));
        if (!other) return refuse(other.error());
        if (other->grey.size() != picture->grey.size())
          return refuse({"bad_sheet", "a picture and its minus differ in size", {}});
        for (std::size_t i = 0; i < picture->grey.size(); ++i)
          picture->grey[i] = static_cast<unsigned char>(std::abs(int{picture->grey[i]} - int{other->grey[i]}));
      }
      if (minus) picture->rgb.clear();
      pictures.back().png.push_back(png_of(*picture));
      pictures.back().captions.push_back(picture->backend);
      std::fprintf(stderr, "%s, %s\n", row.name.c_str(), sheet->columns[pictures.back().png.size() - 1].c_str());
    }
  }
  write_file(out, reports::picture_sheet(sheet->title, sheet->columns, pictures));
  std::printf("%zu pictures in %s\n", sheet->columns.size() * pictures.size(), out.string().c_str());
  return kDone;
}

constexpr Option kSheetOptions[] = {
    {"--out", "FILE.html", "the page"}, {"--backend", "gpu|cpu|reference", "as for `seldinger render`"}, kLibrary};

}  // namespace

Command sheet_command() {
  return {.name = "sheet",
          .positionals = "SHEET.json",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kSheetOptions,
          .summary = "Renders scenes side by side into one page of pictures.",
          .run = &run_sheet};
}

}  // namespace seldinger::app
