// render.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/answers_json.h"
#include "app/command.h"
#include "app/file.h"
#include "app/frame_truth.h"
#include "app/meta_image.h"
#include "app/png.h"
#include "app/scene.h"
#include "casedb/disk.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

constexpr double kWindowCenterHu = 40.0, kWindowWidthHu = 400.0;  // the usual soft-tissue window

imaging::HuImage render(const volume::Volume& volume, const Scene& scene, std::string& backend) {
  if (backend == "reference") return imaging::mpr_reference(volume, *scene.view, scene.inserted);
  if (backend == "cpu") return imaging::mpr_cpu(volume, *scene.view, scene.inserted);
  const bool asked = backend == "gpu";
  try {
    gpu::Context context;
    // On software GL the CPU's own code is faster.
    if (!asked && context.software()) {
      backend = "cpu";
      return imaging::mpr_cpu(volume, *scene.view, scene.inserted);
    }
    imaging::HuImage picture = imaging::MprGpu(context, volume).render(*scene.view, scene.inserted);
    backend = "gpu";
    return picture;
  } catch (const base::Failure& failure) {
    if (asked || failure.code() != "gl") throw;
    std::fputs("note: no GL 4.3 here; the CPU renders\n", stderr);
    backend = "cpu";
    return imaging::mpr_cpu(volume, *scene.view, scene.inserted);
  }
}

}  // namespace

int run_render(const Arguments& arguments) {
  const std::filesystem::path out = arguments.required("--out");
  if (out.extension() != ".mha" && out.extension() != ".png") throw UsageError("--out must end in .mha or .png");
  std::string backend = arguments.text("--backend");
  if (!backend.empty() && backend != "gpu" && backend != "cpu" && backend != "reference")
    throw UsageError("--backend is gpu, cpu or reference");
  std::vector<std::string> notes;
  const auto scene = read_scene(arguments.positional(0), notes);
  if (!scene) return refuse(scene.error());
  if (!scene->view) return refuse({"bad_scene", "scene.view is missing"});
  const auto volume = volume_of(*scene, arguments.text("--library"));
  if (!volume) return refuse(volume.error());
  const imaging::HuImage picture = render(*volume, *scene, backend);
  const imaging::MprView& view = *scene->view;
  if (out.extension() == ".mha")
    write_file(out, meta_image(picture, view));
  else
    casedb::write_durably(out, png_from_grey(imaging::grey_from_hu(picture, kWindowCenterHu, kWindowWidthHu),
                                             view.width_px, view.height_px));
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const imaging::Visible visible =
      imaging::mpr_visible(view, scene->inserted.needle, target_of(scene->inserted.lesions));
  const auto [min, max] = std::minmax_element(picture.begin(), picture.end());
  if (arguments.has("--json"))
    std::fputs(json_of_picture(backend, view.width_px, view.height_px, visible, *min, *max).c_str(), stdout);
  else
    std::printf("%d x %d pixels by %s, %.1f to %.1f HU\n", view.width_px, view.height_px, backend.c_str(),
                static_cast<double>(*min), static_cast<double>(*max));
  return kDone;
}

}  // namespace seldinger::app
