// case explain: what a case's CT shows, what its scene holds, what moves its tissue, and what that costs.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cases/case_answers_json.h"
#include "app/cases/tissue_sheet.h"
#include "app/cases/tissue_text.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/replay/png.h"
#include "casedb/cases/authoring.h"
#include "casedb/import/ct_rules.h"
#include "session/case/case_build.h"
#include "sim/volume/organs/find_organs.h"

namespace seldinger::app {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& one : names) words += (words.empty() ? "" : ", ") + one;
  return words.empty() ? "no vessel" : words;
}

// What its pictures hold by that law, and at what cost where it has one (docs/benchmarks/README.md).
const char* law_text(cases::Modality modality, cases::SightLaw law) {
  if (modality == cases::Modality::xray)
    return law >= cases::SightLaw::material
               ? ": pictures include scatter from the patient (a narrower field is clearer), and the CT's contrast "
                 "medium is iodine, not bone"
           : law >= cases::SightLaw::scatter
               ? ": pictures include scatter from the patient; a narrower field is clearer"
               : ": pictures leave out scatter from the patient";
  if (modality != cases::Modality::ultrasound) return "";
  return law >= cases::SightLaw::clutter   ? ": pictures have artefacts and clutter, a tenth of a picture's time"
         : law >= cases::SightLaw::scatter ? ": pictures have artefacts of sound, no clutter"
                                           : ": pictures have no artefacts of sound and no clutter";
}

int run_case_explain(const Arguments& arguments) {
  std::optional<std::filesystem::path> sheet;
  if (arguments.has("--sheet")) sheet = file_of("--sheet", arguments.required("--sheet"), {".png"});
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto row = casedb::find_case(*library, case_id);
  if (!row) return refuse(row.error());
  std::optional<cases::LesionForm> target;
  for (const casedb::LesionRow& lesion : casedb::list_lesions(*library, case_id))
    if (!target) target = lesion.form;
  cases::Picture picture;
  picture.modality = row->modality;
  const auto scene = session::build_case(*library, *row, target, picture, session::needs_of(row->modality));
  if (!scene) return refuse(scene.error());
  const session::CaseNeeds needs = session::needs_of_case(*scene);
  const auto volume = casedb::load_volume(*library, *row);
  if (!volume) return refuse(volume.error());
  const auto classes = casedb::load_classes(*library, *row);
  if (!classes) return refuse(classes.error());
  std::optional<volume::Organs> organs;
  const bool looked_for = row->labels_sha256.empty() && row->subject != cases::Subject::phantom;
  if (sheet || looked_for) organs = volume::find_organs(*volume, *classes);
  if (sheet) {
    const Canvas drawn = tissue_sheet(*volume, *classes, *organs);
    const std::vector<std::byte> png = png_from_rgb(drawn.rgb(), drawn.width_px(), drawn.height_px());
    write_file(*sheet, std::string(reinterpret_cast<const char*>(png.data()), png.size()));
  }
  const volume::TissueTold tissue =
      volume::tell_tissue(*volume, *classes, !row->labels_sha256.empty(),
                          looked_for ? volume::level_of(*organs, volume::FoundOrgan::aorta) : std::nullopt);
  if (arguments.has("--json")) {
    std::fputs(json_of_needs(case_id, row->sight_law, needs, tissue, looked_for ? organs : std::nullopt).c_str(),
               stdout);
    return kDone;
  }
  std::fputs(tissue_text(tissue).c_str(), stdout);
  if (looked_for) std::fputs(organs_text(*organs).c_str(), stdout);
  std::printf("law of sight     %s%s\n", base::name_of(cases::kSightLawNames, row->sight_law).data(),
              law_text(row->modality, row->sight_law));
  if (row->modality == cases::Modality::xray)
    if (const auto thin = casedb::thin_slab(*volume)) std::printf("%-16s %s\n", "field", thin->text.c_str());
  for (const session::CaseNeed& one : needs.held) std::printf("%-16s %12zu bytes\n", one.what.c_str(), one.bytes);
  if (row->modality == cases::Modality::ultrasound)
    std::printf("colour Doppler   flow in %s%s\n", listed(needs.flowing).c_str(),
                needs.unknown_flow.empty() ? "" : ("; unknown in " + listed(needs.unknown_flow)).c_str());
  if (needs.displacement_bytes == 0) {
    std::puts("moving tissue    none: nothing moves it");
    return kDone;
  }
  std::printf("moving tissue    %12zu bytes, %zu of at most %d sources\n", needs.displacement_bytes,
              needs.sources.size(), session::kMostMotionSources);
  for (const session::MotionSource& one : needs.sources)
    std::printf("  %-14s %12zu bytes  %s\n", one.kind.c_str(), one.bytes, one.name.c_str());
  std::printf("  a point, all at work: %.0f ns, back to rest %.0f ns\n", needs.there_ns, needs.back_ns);
  return kDone;
}

constexpr Option kExplainOptions[] = {
    kLibrary, {"--sheet", "FILE.png", "draws the CT slice by slice, tinted by tissue class and organ"}, kJson};

}  // namespace

Command case_explain_command() {
  return {.name = "case explain",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kExplainOptions,
          .summary =
              "Lists what a case's CT shows, what its scene holds in memory, what can move its tissue, and what "
              "that costs.",
          .run = &run_case_explain};
}

}  // namespace seldinger::app
