#include "app/pictures/scene.h"

#include <algorithm>
#include <span>

#include "app/cli/file.h"
#include "app/cli/words.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/cases.h"
#include "casedb/import/import.h"
#include "sim/case/paint.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/imaging/ultrasound/view/portal_walls.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::app {

base::Result<Scene> read_scene(const std::filesystem::path& path, std::vector<std::string>& notes) {
  const auto text = read_text(path, 64U << 20U);
  if (!text) return text.error();
  std::vector<std::string> unused;
  auto scene = scene_from_json(*text, path.parent_path(), unused);
  std::sort(unused.begin(), unused.end());
  unused.erase(std::unique(unused.begin(), unused.end()), unused.end());
  for (const std::string& where : unused) notes.push_back(where + " is not used");
  return scene;
}

namespace {

base::Result<volume::Volume> volume_alone(const Scene& scene, const std::string& library) {
  if (const auto* analytic = std::get_if<volume::AnalyticVolume>(&scene.volume))
    return volume::rasterize(*analytic);
  if (const auto* built_in = std::get_if<volume::PhantomOptions>(&scene.volume))
    return volume::make_phantom(*built_in).volume;
  if (const auto* file = std::get_if<VolumeFile>(&scene.volume)) {
    auto source = casedb::read_source(file->path);
    if (!source) return error_of("the scene's volume", file->path.string(), source.error());
    return std::move(source->volume);
  }
  if (library.empty()) return base::Error{"no_library", "the scene names a case, but no --library is given"};
  auto opened = casedb::Library::open(library);
  if (!opened) return error_of("the library", library, opened.error());
  const auto row = casedb::find_case(*opened, std::get<VolumeOfCase>(scene.volume).case_id);
  if (!row) return error_of("the scene's case", std::get<VolumeOfCase>(scene.volume).case_id, row.error());
  return casedb::load_volume(*opened, *row);
}

// Classes of the volume, and the labels that tell of a portal vein.
base::Result<std::vector<volume::TissueClass>> classes_of(const Scene& scene, const volume::Volume& volume,
                                                          const std::string& library,
                                                          imaging::PortalLumen& portal) {
  volume::LabelMap labels;
  if (const auto* analytic = std::get_if<volume::AnalyticVolume>(&scene.volume)) {
    volume::rasterize(*analytic, labels);
  } else if (const auto* built_in = std::get_if<volume::PhantomOptions>(&scene.volume)) {
    labels = volume::make_phantom(*built_in).labels;
  } else if (std::holds_alternative<VolumeFile>(scene.volume)) {
    return volume::classes_with_organs(volume, nullptr);
  } else {
    auto opened = casedb::Library::open(library);
    if (!opened) return error_of("the library", library, opened.error());
    const auto row = casedb::find_case(*opened, std::get<VolumeOfCase>(scene.volume).case_id);
    if (!row) return error_of("the scene's case", std::get<VolumeOfCase>(scene.volume).case_id, row.error());
    const auto maps = casedb::load_label_maps(*opened, *row);
    if (!maps) return maps.error();
    for (const casedb::StoredLabels& map : *maps) portal.add(map.labels);
    return casedb::load_classes(*opened, *row);
  }
  portal.add(labels);
  return volume::tissue_classes(volume, &labels);
}

}  // namespace

base::Result<volume::Volume> volume_of(const Scene& scene, const std::string& library) {
  auto volume = volume_alone(scene, library);
  if (!volume) return volume.error();
  for (const DrawnStructure& one : scene.drawn)
    cases::paint(scene.structures[one.at].shape, {one.hu, false, 0.0}, *volume);
  return volume;
}

cases::SightLaw law_of_tissue(const Scene& scene) noexcept {
  const auto* view = scene.view ? std::get_if<UltrasoundSceneView>(&*scene.view) : nullptr;
  return view == nullptr ? cases::kNewestSightLaw : view->view.sight_law;
}

base::Result<SceneTissue> tissue_of(const Scene& scene, const volume::Volume& volume, const std::string& library) {
  imaging::PortalLumen portal(volume);
  auto classes = classes_of(scene, volume, library, portal);
  if (!classes) return classes.error();
  for (const DrawnStructure& one : scene.drawn) {
    const cases::Structure& drawn = scene.structures[one.at];
    cases::paint_class(drawn.shape, drawn.tissue, volume, *classes);
    portal.add(std::span(&drawn, 1));
  }
  SceneTissue tissue{std::move(*classes), {}};
  tissue.echogenicity = imaging::echogenicity(volume, tissue.classes);
  // As session/case/case_build.cpp has it.
  if (law_of_tissue(scene) != cases::SightLaw::half_slice)
    imaging::show_organs(volume, tissue.classes, tissue.echogenicity);
  if (imaging::draws_portal_walls(law_of_tissue(scene)))
    imaging::show_portal_walls(volume, tissue.classes, portal.voxels(), tissue.echogenicity);
  return tissue;
}

}  // namespace seldinger::app
