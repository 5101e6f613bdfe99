// import, sample.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <iterator>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/cases/case_answers_json.h"
#include "app/cases/import_case.h"
#include "app/cases/label_file.h"
#include "app/cases/privacy_text.h"
#include "app/cases/tissue_text.h"
#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/cli/words.h"
#include "casedb/cases/classed_case.h"
#include "casedb/cases/permissions.h"
#include "casedb/cases/versions.h"
#include "casedb/import/ct_rules.h"
#include "sim/volume/organs/find_organs.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::app {

namespace {

// Told and not refused: the same CT may well carry two cases; whoever forgot it would do the work twice.
void tell_same_ct(casedb::Library& library, const casedb::CaseRow& row) {
  for (const casedb::CaseRow& other : casedb::list_case_heads(library))
    if (other.case_id != row.case_id && other.volume_sha256 == row.volume_sha256)
      std::fprintf(stderr, "note: the library already has this CT, in case %s, “%s”, version %d (%s)\n",
                   other.case_id.c_str(), other.title.c_str(), other.version, name_of(other.state).c_str());
}

// Its value is one of the table's names: the option lists them.
template <typename Value, std::size_t n>
Value named_option(const Arguments& arguments, const char* name, const base::Names<Value, n>& table) {
  return base::from_name(table, arguments.text(name)).value_or(table.front().value);
}

// The built-in patient that is asked for; nothing where a source is. A patient lay in the scanner as in the case.
std::optional<volume::PhantomOptions> built_in_of(const Arguments& arguments, cases::PatientPosition position) {
  const bool built_in = arguments.has("--built-in");
  if (built_in == (arguments.positionals() > 0)) throw UsageError("import takes either a SOURCE or --built-in");
  if (!built_in) {
    if (arguments.has("--body") || arguments.has("--calyces"))
      throw UsageError("--body and --calyces go with --built-in");
    return std::nullopt;
  }
  for (const char* of_a_source : {"--series", "--face", "--reason", "--large", "--no-burned-in-text"})
    if (arguments.has(of_a_source)) throw UsageError(std::string(of_a_source) + " needs a SOURCE");
  for (const casedb::PreparationRow& row : casedb::kPreparationRows)
    if (arguments.has(row.option)) throw UsageError(std::string(row.option) + " needs a SOURCE");
  volume::PhantomOptions options;
  options.region = named_option(arguments, "--built-in", volume::kRegionNames);
  options.body = named_option(arguments, "--body", volume::kBodyNames);
  options.calyces = named_option(arguments, "--calyces", volume::kCalycesNames);
  if (options.region != volume::Region::torso && arguments.has("--calyces"))
    throw UsageError("--calyces needs the torso");
  if (position == cases::PatientPosition::prone)
    options.posture = volume::Posture::prone;
  else if (position != cases::PatientPosition::supine)
    throw UsageError("a built-in patient can only lie supine or prone");
  return options;
}

casedb::Preparation preparation_of(const Arguments& arguments) {
  casedb::Preparation preparation;
  for (const casedb::PreparationRow& row : casedb::kPreparationRows)
    preparation.*row.value = arguments.number(row.option, preparation.*row.value);
  return preparation;
}

int run_import(const Arguments& arguments) {
  const std::filesystem::path folder = library_folder(arguments);
  const auto modality = casedb::modality_from(arguments.text("--modality", "mpr"));
  if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  const auto position = casedb::position_from(arguments.text("--position", "supine"));
  if (!position) throw UsageError("--position is supine, prone, lateral_left or lateral_right");
  const auto built_in = built_in_of(arguments, *position);
  const FaceWish face = face_of(arguments);
  if (face.choice == casedb::FaceChoice::overrule) {
    arguments.required("--by");
    if (const auto sound = casedb::check_note(face.overruled_because); !sound) return refuse(sound.error());
  }
  // Asked before the source is read: without a library nobody is known, and the operator makes one.
  std::optional<std::string> confirmed_by;
  std::optional<casedb::Library> library;
  if (arguments.has("--by") || std::filesystem::exists(folder / casedb::kDatabaseFile)) {
    auto opened = open_acting(arguments);
    if (!opened) return refuse(opened.error());
    library.emplace(std::move(*opened));
    if (arguments.has("--no-burned-in-text")) {
      const auto by = acting(*library, arguments, casedb::Action::confirm_no_burned_in_text);
      if (!by) return refuse(by.error());
      confirmed_by = *by;
    }
    if (face.choice == casedb::FaceChoice::overrule)
      if (const auto by = acting(*library, arguments, casedb::Action::overrule_face); !by)
        return refuse(by.error());
    if (const auto by = acting(*library, arguments, casedb::Action::add_case); !by) return refuse(by.error());
  }
  if (arguments.has("--title") && arguments.text("--title").empty())
    return refuse(casedb::check_case_title("").error());
  auto imported = built_in ? import_phantom(*built_in, arguments.text("--title"))
                           : import_case(arguments.positional(0), series_of(arguments), arguments.text("--title"),
                                         "import", face, arguments.has("--large"), preparation_of(arguments));
  if (!imported)
    return refuse(built_in ? imported.error() : error_of("SOURCE", arguments.positional(0), imported.error()));
  if (!built_in) imported->no_burned_in_text = arguments.has("--no-burned-in-text");
  imported->burned_in_checked_by = confirmed_by;
  imported->modality = *modality;
  if (*modality == cases::Modality::xray)
    if (auto thin = casedb::thin_slab(imported->volume)) imported->warnings.push_back(std::move(*thin));
  imported->position = *position;
  if (!library) {
    auto made = open_acting(arguments, WhereNone::create);
    if (!made) return refuse(made.error());
    library.emplace(std::move(*made));
  }
  const volume::MarkedClasses marked =
      volume::marked_classes(imported->volume, imported->labels ? &*imported->labels : nullptr);
  const std::string case_id = casedb::add_case(*library, *imported, marked.classes);
  if (!arguments.has("--json")) {  // at once: whoever ends the work that follows learns what there is by now
    std::printf("case %s\n", case_id.c_str());
    std::fflush(stdout);
  }
  const auto row = casedb::find_case(*library, case_id);
  if (!row) return refuse(row.error());
  tell_same_ct(*library, *row);
  const volume::TissueTold tissue = volume::tell_tissue(
      imported->volume, marked.classes, imported->labels.has_value(),
      marked.organs ? volume::level_of(*marked.organs, volume::FoundOrgan::aorta) : std::nullopt);
  if (arguments.has("--json")) {
    std::fputs(json_of_imported(casedb::load_parts(*library, *row), tissue, marked.organs).c_str(), stdout);
    return kDone;
  }
  std::printf("%s\n%d x %d x %d voxels, %.4g x %.4g x %.4g mm, HU %d to %d, %d slices\n", row->title.c_str(),
              row->size_voxels.x, row->size_voxels.y, row->size_voxels.z, row->spacing_mm.x, row->spacing_mm.y,
              row->spacing_mm.z, row->hu_min, row->hu_max, row->slices_used);
  for (const base::Problem& warning : row->warnings)
    std::printf("warning: %s: %s\n", warning.code.c_str(), warning.text.c_str());
  std::fputs(privacy_text(*row).c_str(), stdout);
  std::fputs(tissue_text(tissue).c_str(), stdout);
  if (marked.organs) std::fputs(organs_text(*marked.organs).c_str(), stdout);
  return kDone;
}

int run_sample(const Arguments& arguments) {
  arguments.required("--lps");
  std::vector<PointSample> samples;
  for (const std::string& text : arguments.all("--lps")) {
    samples.push_back({});
    samples.back().lps_mm = point_of("--lps", text);
  }
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto volume = casedb::load_volume(*library, *row);
  if (!volume) return refuse(volume.error());
  const auto maps = casedb::load_label_maps(*library, *row);
  if (!maps) return refuse(maps.error());
  const auto classes = casedb::load_classes(*library, *row);
  if (!classes) return refuse(classes.error());
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(*volume);
  std::optional<volume::Organs> organs;
  if (row->labels_sha256.empty())
    organs = volume::find_organs(*volume, *classes);  // the built-in patient knows them
  for (PointSample& sample : samples) {
    const glm::dvec3 index(voxel_from_lps * glm::dvec4(sample.lps_mm, 1.0));
    if (const auto hu = volume::sample_nearest(*volume, index)) sample.hu_nearest = *hu;
    sample.hu_trilinear = volume::sample_trilinear(*volume, index);
    if (!sample.hu_nearest) continue;
    const glm::ivec3 nearest =
        glm::clamp(glm::ivec3(glm::floor(index + 0.5)), glm::ivec3(0), volume->size_voxels - 1);
    const std::size_t at = volume->index(nearest.x, nearest.y, nearest.z);
    sample.tissue = volume::about((*classes)[at]).name;
    if (organs)
      if (const auto organ = volume::organ_at(*organs, sample.lps_mm)) {
        sample.organ = base::name_of(volume::kFoundOrganNames, organ->organ);
        sample.organ_confidence = organ->confidence;
      }
    for (const casedb::StoredLabels& map : *maps) {          // the last one wins
      if (!map.wins || map.labels.label[at] == 0) continue;  // a map that wins is as large as the classes
      const std::string& name = map.labels.names[map.labels.label[at]];
      if (is_unnamed(name)) continue;
      sample.organ = name;
      sample.organ_confidence = 1.0;
    }
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_samples(samples).c_str(), stdout);
    return kDone;
  }
  for (const PointSample& sample : samples) {
    std::string known = sample.organ ? ", " + *sample.organ : "";
    if (sample.organ && *sample.organ_confidence < 1.0)
      known += " (" + std::to_string(std::lround(100.0 * *sample.organ_confidence)) + " % sure)";
    std::printf("%.6g,%.6g,%.6g: ", sample.lps_mm.x, sample.lps_mm.y, sample.lps_mm.z);
    if (sample.hu_nearest)
      std::printf("nearest %.0f HU, trilinear %.2f HU, %s%s\n", *sample.hu_nearest, *sample.hu_trilinear,
                  sample.tissue->c_str(), known.c_str());
    else
      std::printf("outside the volume\n");
  }
  return kDone;
}

int run_case_confirm(const Arguments& arguments) {
  if (!arguments.has("--no-burned-in-text"))
    throw UsageError("--no-burned-in-text is missing: it says what is confirmed");
  arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::confirm_no_burned_in_text);
  if (!by) return refuse(by.error());
  const auto kept = casedb::confirm_no_burned_in_text(*library, arguments.positional(0), *by);
  if (!kept) return refuse(kept.error());
  std::puts("confirmed");
  return kDone;
}

constexpr Option kBeforePreparation[] = {
    kLibrary,
    {"--built-in", "torso|groin|neck",
     "in place of SOURCE: the built-in patient, made by formulas, not from a person's CT"},
    {"--body", "adult|lean|obese|child", "the built-in patient's build; default adult"},
    {"--calyces", "normal|dilated|opacified", "the built-in torso's calyces; default normal"},
    {"--title", "TEXT", "the case's title; never taken from the source"},
    kSeries,
    {"--modality", "mpr|xray|ultrasound", "what the case is practised with; default mpr"},
    {"--position", "supine|prone|lateral_left|lateral_right", "how the patient lies; default supine"},
    kFaceOrOverrule,
    kReason,
};
constexpr Option kAfterPreparation[] = {
    {"--large", nullptr, "accepts a file whose voxels are more than 4 GiB unpacked, up to 8"},
    {"--no-burned-in-text", nullptr, "you looked through the slices and saw no text in them"},
    kJson};
constexpr auto kImportOptions = [] {
  std::array<Option, std::size(kBeforePreparation) + casedb::kPreparationRows.size() + std::size(kAfterPreparation)>
      options{};
  auto next = std::copy(std::begin(kBeforePreparation), std::end(kBeforePreparation), options.begin());
  for (const casedb::PreparationRow& row : casedb::kPreparationRows) *next++ = {row.option, row.what, row.help};
  std::copy(std::begin(kAfterPreparation), std::end(kAfterPreparation), next);
  return options;
}();

constexpr Option kConfirmOptions[] = {
    kLibrary, {"--no-burned-in-text", nullptr, "you looked through the slices and saw no text in them"}};

constexpr Option kSampleOptions[] = {
    kLibrary, {"--lps", "X,Y,Z", "a point in mm, LPS; may be given many times", true}, kJson};

}  // namespace

Command import_command() {
  return {.name = "import",
          .positionals = "[SOURCE]",
          .min_positionals = 0,
          .max_positionals = 1,
          .options = kImportOptions,
          .acts = true,
          .summary =
              "Reads a CT (DICOM folder or file, .nii .nii.gz .nrrd .nhdr .mha .mhd) into the library as a case, "
              "or makes "
              "the built-in patient.",
          .run = &run_import};
}

Command sample_command() {
  return {.name = "sample",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kSampleOptions,
          .summary = "Prints the HU, tissue and organ at points of a case.",
          .run = &run_sample};
}

Command case_confirm_command() {
  return {
      .name = "case confirm",
      .positionals = "CASE",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kConfirmOptions,
      .acts = true,
      .named = true,
      .summary =
          "Records that somebody looked through a case's slices and saw no burned-in text: publishing needs it.",
      .run = &run_case_confirm};
}

}  // namespace seldinger::app
