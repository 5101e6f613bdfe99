#include "app/demo/demo_case.h"

#include "app/cases/import_case.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "assessment/operators/lesion_site.h"
#include "casedb/cases/classed_case.h"
#include "casedb/database/credentials.h"
#include "casedb/import/ct_rules.h"
#include "session/case/case_build.h"
#include "session/case/classed_build.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/tissue/find_tissue.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::app {
namespace {

volume::Calyces calyces_of(const Arguments& arguments) {
  const auto calyces = base::from_name(volume::kCalycesNames, arguments.text("--calyces", "normal"));
  if (!calyces) throw UsageError("--calyces is normal, dilated or opacified");
  return *calyces;
}

cases::Modality modality_of(const Arguments& arguments) {
  const auto modality = casedb::modality_from(arguments.text("--modality", "ultrasound"));
  if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  return *modality;
}

// Organs: those of a CT without labels.
base::Result<cases::Lesion> lesion_in(const cases::Case& scene, const std::optional<volume::Organs>& organs) {
  const cases::Modality modality = scene.picture.modality;
  assessment::LesionRule rule = assessment::lesion_rule(modality, scene.position);
  if (organs) rule.organs = &*organs;
  rule.classes = scene.classes;
  if (modality == cases::Modality::ultrasound) {
    rule.looks_from = [&](const assessment::PuncturePlan& plan, const assessment::WorthTaking& worth,
                          const cases::Lesion& target) {
      return session::UltrasoundSight(scene).looks_from(plan, worth, target);
    };
  }
  const auto site = assessment::find_lesion_site(scene.volume, scene.skin_index, rule);
  if (!site) return site.error();
  return site->lesion;
}

cases::Picture picture_of(cases::Modality modality) {
  cases::Picture picture;
  picture.modality = modality;
  return picture;
}

base::Result<DemoCaseFound> with_lesion(casedb::Library& library, casedb::CaseRow row) {
  auto lesions = casedb::list_lesions(library, row.case_id);
  if (lesions.empty()) {
    const auto scene =
        session::build_case(library, row, std::nullopt, picture_of(row.modality), session::needs_of(row.modality));
    if (!scene) return scene.error();
    std::optional<volume::Organs> organs;
    if (row.labels_sha256.empty())
      organs = volume::find_organs(scene->volume,
                                   scene->classes.empty() ? volume::tissue_classes(scene->volume) : scene->classes);
    const auto lesion = lesion_in(*scene, organs);
    if (!lesion) return lesion.error();
    if (const auto added = casedb::add_lesion(library, row.case_id, *lesion); !added) return added.error();
    lesions = casedb::list_lesions(library, row.case_id);
  }
  return DemoCaseFound{std::move(row), std::move(lesions.front())};
}

// With what import noticed: it may be why.
base::Error with_warnings(base::Error refused, const std::vector<base::Problem>& warnings) {
  refused.findings.insert(refused.findings.end(), warnings.begin(), warnings.end());
  return refused;
}

bool is_case_of(const casedb::CaseRow& row, const std::string& origin, const std::string& volume_sha256,
                cases::Modality modality) {
  return row.modality == modality &&
         (volume_sha256.empty() ? row.origin == origin : row.volume_sha256 == volume_sha256);
}

}  // namespace

base::Result<DemoCaseFound> demo_case(std::optional<casedb::Library>& library, MadeFolder& folder,
                                      const Arguments& arguments) {
  const bool own = arguments.has("--ct");
  const volume::Calyces calyces = calyces_of(arguments);
  const cases::Modality modality = modality_of(arguments);
  if (own && arguments.has("--calyces")) throw UsageError("--calyces needs the built-in case, not a CT");
  std::optional<casedb::NewCase> made;
  std::string volume_sha256;
  if (own) {
    auto read = import_case(arguments.text("--ct"), series_of(arguments), "Demo CT", "import", face_of(arguments));
    if (!read) return error_of("--ct", arguments.text("--ct"), read.error());
    made.emplace(std::move(*read));
    volume_sha256 = casedb::sha256_hex(volume::bytes_from_volume(made->volume));
  }
  if (folder.holds_a_library()) {
    auto opened = casedb::Library::open(folder.path());
    if (!opened) return error_of_library(arguments, opened.error());
    library.emplace(std::move(*opened));
    for (casedb::CaseRow& row : casedb::list_cases(*library))
      if (is_case_of(row, phantom_origin({.calyces = calyces}), volume_sha256, modality)) {
        auto found = with_lesion(*library, std::move(row));
        if (!found && made) return with_warnings(found.error(), made->warnings);
        return found;
      }
  }
  if (!made) {
    auto read = import_phantom({.calyces = calyces});
    if (!read) return read.error();
    made.emplace(std::move(*read));
  }
  made->modality = modality;
  if (modality == cases::Modality::xray) {
    made->title += ", fluoroscopy";
    if (auto thin = casedb::thin_slab(made->volume)) made->warnings.push_back(std::move(*thin));
  }
  if (modality == cases::Modality::mpr) made->title += ", CT slices";
  const volume::MarkedClasses marked =
      volume::marked_classes(made->volume, made->labels ? &*made->labels : nullptr);
  const auto lesion = lesion_in(
      session::build_case(*made, picture_of(modality), session::needs_of(modality), marked.classes), marked.organs);
  if (!lesion) return with_warnings(lesion.error(), made->warnings);
  if (!library) {
    auto created = casedb::Library::open_or_create(folder.path());
    if (!created) return error_of_library(arguments, created.error());
    library.emplace(std::move(*created));
  }
  const std::string case_id = casedb::add_case(*library, *made, marked.classes);
  if (const auto added = casedb::add_lesion(*library, case_id, *lesion); !added) return added.error();
  auto row = casedb::find_case(*library, case_id);
  if (!row) return row.error();
  return with_lesion(*library, std::move(*row));
}

}  // namespace seldinger::app
