#include "session/case/case_build.h"

#include <charconv>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "casedb/cases/authoring.h"
#include "session/case/classed_build.h"
#include "sim/case/paint.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/imaging/ultrasound/view/portal_walls.h"
#include "sim/imaging/ultrasound/view/tissue.h"
#include "sim/volume/organs/organ_classes.h"

namespace seldinger::session {
namespace {

using Classes = std::vector<volume::TissueClass>;

// What a structure of a label or a class is, in voxels, before anything is painted.
class Voxels {
 public:
  Voxels(casedb::Library& library, const casedb::CaseRow& row, const volume::Volume& volume,
         std::optional<Classes>& classes)
      : library_(library), row_(row), volume_(volume), classes_(classes) {}

  base::Result<cases::Shape> of(const casedb::StructureRow& structure) {
    if (structure.kind == casedb::StructureKind::tissue_class) {
      if (!classes_) {
        auto loaded = casedb::load_classes(library_, row_);
        if (!loaded) return loaded.error();
        classes_ = std::move(*loaded);
      }
      std::vector<std::uint8_t> bytes(classes_->size());
      for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>((*classes_)[i]);
      return cases::Shape{cases::voxels_with(volume_, bytes, static_cast<std::uint8_t>(structure.tissue))};
    }
    if (const auto loaded = load_maps(); !loaded) return loaded.error();
    for (const casedb::StoredLabels& map : *maps_) {
      if (map.sha256 != structure.labels_sha256) continue;
      if (map.labels.label.size() != volume_.hu.size()) break;
      return cases::Shape{
          cases::voxels_with(volume_, map.labels.label, static_cast<std::uint8_t>(structure.label))};
    }
    return base::Error{"damaged", "the stored labels are not the volume's"};
  }

  base::Result<void> find_portal(imaging::PortalLumen& portal) {
    if (const auto loaded = load_maps(); !loaded) return loaded.error();
    for (const casedb::StoredLabels& map : *maps_) portal.add(map.labels);
    return {};
  }

 private:
  base::Result<void> load_maps() {
    if (maps_) return {};
    auto loaded = casedb::load_label_maps(library_, row_);
    if (!loaded) return loaded.error();
    maps_ = std::move(*loaded);
    return {};
  }

  casedb::Library& library_;
  const casedb::CaseRow& row_;
  const volume::Volume& volume_;
  std::optional<Classes>& classes_;
  std::optional<std::vector<casedb::StoredLabels>> maps_;
};

void take_setting(const casedb::CaseSetting& setting, cases::Case& scene) {
  scene.instrument = setting.instrument;
  scene.touch = setting.touch;
  scene.approach = setting.approach;
  scene.probe_is_chosen = setting.probe_is_chosen;
  scene.subject = setting.subject;
  scene.position = setting.position;
  scene.planned_entry_lps_mm = setting.planned_entry_lps_mm;
  if (setting.subject == cases::Subject::patient) scene.defer_is_right = setting.clinic.defer;
  scene.breathing = setting.motion.breathing();
  scene.yields = setting.motion.yields;
  scene.sight_law = setting.sight_law;
}

// Of the CT's scanner, as the file said.
std::optional<double> tube_kv_of(const std::vector<std::pair<std::string, std::string>>& attributes) {
  for (const auto& [name, value] : attributes) {
    double kv = 0.0;
    if (name == "tube_voltage_kv" &&
        std::from_chars(value.data(), value.data() + value.size(), kv).ec == std::errc())
      return kv;
  }
  return std::nullopt;
}

bool shows_portal_walls(Needs needs, const cases::Case& scene) {
  return needs == Needs::ultrasound && imaging::draws_portal_walls(scene.sight_law);
}

// Of all that was painted.
void finish(Needs needs, const imaging::PortalLumen& portal, cases::Case& scene) {
  if (needs == Needs::ultrasound) {
    scene.echogenicity = imaging::echogenicity(scene.volume, scene.classes);
    // Cases of before decision 0061 keep the levels that their classes have.
    if (scene.sight_law != cases::SightLaw::half_slice)
      imaging::show_organs(scene.volume, scene.classes, scene.echogenicity);
    imaging::show_portal_walls(scene.volume, scene.classes, portal.voxels(), scene.echogenicity);
    imaging::settle_lesions(scene.volume, scene.classes, scene.echogenicity, scene.lesions, scene.sight_law);
  }
  // The table is set so that the machine turns about the middle of what there is.
  const glm::dvec4 middle(glm::dvec3(scene.volume.size_voxels - 1) / 2.0, 1.0);
  scene.fluoroscope.start.isocentre_lps_mm = glm::dvec3(scene.volume.lps_from_voxel * middle);
}

}  // namespace

void add_lesion(const cases::LesionForm& form, cases::Case& scene) {
  cases::Lesion lesion = cases::lesion_of(form);
  if (lesion.in_volume()) {
    const cases::Painted painted = cases::paint(*lesion.shape, {form.hu, form.adds, form.edge_mm}, scene.volume);
    if (painted.voxels > 0) {
      lesion.hu = painted.hu;
      lesion.around_hu = painted.before_hu;
    }
    if (!scene.classes.empty())
      cases::paint_class(*lesion.shape, cases::tissue_of_lesion(lesion.hu), scene.volume, scene.classes);
  }
  scene.lesions.push_back(std::move(lesion));
}

base::Result<CaseAssets> load_assets(casedb::Library& library, const casedb::CaseRow& row, Needs needs) {
  CaseAssets assets;
  auto volume = casedb::load_volume(library, row);
  if (!volume) return volume.error();
  assets.volume = std::move(*volume);
  auto skin = casedb::load_skin(library, row);
  if (!skin) return skin.error();
  assets.skin = std::move(*skin);
  assets.skin_index = cases::MeshIndex(assets.skin);
  if (needs == Needs::metrics) return assets;
  auto classes = casedb::load_classes(library, row);
  if (!classes) return classes.error();
  if (classes->size() != assets.volume.hu.size())
    return base::Error{"damaged", "the stored classes are not the volume's"};
  assets.classes = std::move(*classes);
  return assets;
}

base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row,
                                     const std::optional<cases::LesionForm>& target, const cases::Picture& picture,
                                     Needs needs) {
  auto assets = load_assets(library, row, needs);
  if (!assets) return assets.error();
  return build_case(library, row, std::move(*assets), target, picture, needs);
}

base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row, CaseAssets assets,
                                     const std::optional<cases::LesionForm>& target, const cases::Picture& picture,
                                     Needs needs) {
  cases::Case scene;
  scene.volume = std::move(assets.volume);
  scene.skin = std::move(assets.skin);
  scene.skin_index = std::move(assets.skin_index);
  scene.picture = picture;
  take_setting(row, scene);
  scene.ct_tube_kv = tube_kv_of(row.attributes);

  const std::vector<casedb::StructureRow> structures = casedb::list_structures(library, row.case_id);
  Voxels voxels(library, row, scene.volume, assets.classes);
  for (const casedb::StructureRow& one : structures) {
    cases::Shape shape = one.drawn;
    if (one.kind != casedb::StructureKind::drawn) {
      auto found = voxels.of(one);
      if (!found) return found.error();
      shape = std::move(*found);
    }
    scene.structures.push_back({one.name, one.tissue, one.rule, std::move(shape)});
  }
  if (needs != Needs::metrics) scene.classes = std::move(assets.classes).value();
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const cases::Structure& made = scene.structures[i];
    if (structures[i].hu) cases::paint(made.shape, {*structures[i].hu, false, 0.0}, scene.volume);
    if (!scene.classes.empty() && structures[i].kind != casedb::StructureKind::tissue_class)
      cases::paint_class(made.shape, made.tissue, scene.volume, scene.classes);
  }
  if (target) add_lesion(*target, scene);
  imaging::PortalLumen portal(scene.volume);
  if (shows_portal_walls(needs, scene)) {
    if (const auto found = voxels.find_portal(portal); !found) return found.error();
    portal.add(scene.structures);
  }
  finish(needs, portal, scene);
  return scene;
}

cases::Case build_case(const casedb::NewCase& made, const cases::Picture& picture, Needs needs) {
  std::vector<volume::TissueClass> classes;
  if (needs != Needs::metrics)
    classes = volume::classes_with_organs(made.volume, made.labels ? &*made.labels : nullptr);
  return build_case(made, picture, needs, std::move(classes));
}

cases::Case build_case(const casedb::NewCase& made, const cases::Picture& picture, Needs needs,
                       std::vector<volume::TissueClass> classes) {
  cases::Case scene;
  scene.volume = made.volume;
  scene.skin = made.skin;
  scene.skin_index = cases::MeshIndex(scene.skin);
  scene.picture = picture;
  take_setting(made, scene);
  scene.ct_tube_kv = tube_kv_of(made.attributes);
  if (needs != Needs::metrics) scene.classes = std::move(classes);
  imaging::PortalLumen portal(scene.volume);
  if (shows_portal_walls(needs, scene) && made.labels) portal.add(*made.labels);
  finish(needs, portal, scene);
  return scene;
}

base::Result<cases::Case> build_case_of(casedb::Library& library, const casedb::AttemptRow& attempt, Needs needs) {
  const auto row = casedb::find_case(library, attempt.case_id);
  if (!row) return row.error();
  std::optional<cases::LesionForm> target;
  for (const casedb::LesionRow& lesion : casedb::list_lesions(library, attempt.case_id))
    if (lesion.lesion_id == attempt.lesion_id) target = lesion.form;
  auto scene = build_case(library, *row, target, attempt.picture, needs);
  if (!scene) return scene.error();
  scene->instrument = attempt.instrument;
  scene->approach = attempt.approach;
  return scene;
}

}  // namespace seldinger::session
