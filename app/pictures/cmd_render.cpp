// render.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "app/pictures/meta_image.h"
#include "app/pictures/render_json.h"
#include "app/pictures/scene_picture.h"
#include "app/replay/png.h"

namespace seldinger::app {
namespace {

int run_render(const Arguments& arguments) {
  const std::filesystem::path out = file_of("--out", arguments.required("--out"), {".mha", ".png"});
  const std::string backend = arguments.text("--backend");
  if (!backend.empty() && backend != "gpu" && backend != "cpu" && backend != "reference")
    throw UsageError("--backend is gpu, cpu or reference");
  std::vector<std::string> notes;
  const auto scene = read_scene(arguments.positional(0), notes);
  if (!scene) return refuse(error_of("SCENE.json", arguments.positional(0), scene.error()));
  if (scene->room) {
    file_of("--out of a room", arguments.text("--out"), {".png"});
    if (backend == "cpu" || backend == "reference") throw UsageError("a room can only be drawn with --backend gpu");
    const auto room = paint_room(*scene, library_folder_if_any(arguments).string());
    if (!room) return refuse(room.error());
    write_file(out, png_from_rgb(room->rgb, room->width_px, room->height_px));
    for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
    if (arguments.has("--json"))
      std::fputs(json_of_room(*room).c_str(), stdout);
    else
      std::printf("%d x %d pixels, %zu triangles, by %s\n", room->width_px, room->height_px, room->triangles,
                  room->renderer.c_str());
    return kDone;
  }
  if (!scene->view) return refuse({"bad_scene", "scene.view is missing"});
  auto painter = ScenePainter::of(*scene, library_folder_if_any(arguments).string());
  if (!painter) return refuse(painter.error());
  const auto rendered = painter->paint(*scene, backend);
  if (!rendered) return refuse(rendered.error());
  const ScenePicture& picture = *rendered;
  if (out.extension() == ".mha")
    write_file(out, meta_image(picture.values, picture.plane));
  else
    write_file(out, png_of(picture));
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const auto [min, max] = std::minmax_element(picture.values.begin(), picture.values.end());
  if (arguments.has("--json"))
    std::fputs(json_of_picture(picture, *min, *max).c_str(), stdout);
  else
    std::printf("%d x %d pixels by %s, %.6g to %.6g %s\n", picture.plane.width_px, picture.plane.height_px,
                picture.backend.c_str(), static_cast<double>(*min), static_cast<double>(*max), picture.unit);
  return kDone;
}

constexpr Option kRenderOptions[] = {
    {"--out", "FILE", ".mha: float32 in the picture's unit (HU, line integral, …); .png: what a person sees"},
    {"--backend", "gpu|cpu|reference", "default gpu where GL 4.3 has hardware, else cpu"},
    kLibrary,
    kJson};

}  // namespace

Command render_command() {
  return {.name = "render",
          .positionals = "SCENE.json",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kRenderOptions,
          .summary = "Renders a view of a scene (mpr, xray, ultrasound, room).",
          .run = &run_render};
}

}  // namespace seldinger::app
