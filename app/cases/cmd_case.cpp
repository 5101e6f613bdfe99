// case list, case show, case lesion.
#include <cstdio>
#include <unordered_map>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/cases/privacy_text.h"
#include "app/cli/command.h"
#include "casedb/cases/authoring.h"
#include "casedb/grading/dependability.h"
#include "reports/words/case_words.h"
#include "reports/words/dependability_words.h"

namespace seldinger::app {
namespace {

int run_case_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  std::vector<casedb::CaseParts> cases;  // no more of each than the list shows
  std::unordered_map<std::string, std::vector<casedb::LesionRow>> lesions_of;
  for (casedb::LesionRow& lesion : casedb::list_lesions(*library))
    lesions_of[lesion.case_id].push_back(std::move(lesion));
  for (casedb::CaseRow& row : casedb::list_case_heads(*library)) {
    auto lesions = std::move(lesions_of[row.case_id]);
    cases.push_back({std::move(row), std::move(lesions), {}, {}});
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_cases(cases).c_str(), stdout);
    return kDone;
  }
  if (cases.empty()) std::puts("There are no cases yet; `seldinger import` makes one.");
  for (const casedb::CaseParts& one : cases)
    std::printf("%s  %-9s v%d  %zu lesion%s  %s\n", one.row.case_id.c_str(), casedb::name_of(one.row.state).c_str(),
                one.row.version, one.lesions.size(), one.lesions.size() == 1 ? " " : "s", one.row.title.c_str());
  return kDone;
}

int run_case_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto parts = casedb::load_parts(*library, arguments.positional(0));
  if (!parts) return refuse(parts.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_case(*parts).c_str(), stdout);
    return kDone;
  }
  const casedb::CaseRow& row = parts->row;
  std::printf(
      "case     %s\ntitle    %s\nstate    %s, version %d%s\nguidance %s\nvoxels   %d x %d x %d, "
      "%.4g x %.4g x %.4g mm\nHU       %d to %d\n",
      row.case_id.c_str(), row.title.c_str(), casedb::name_of(row.state).c_str(), row.version,
      row.own_cohort_only ? ", unreviewed, own cohort only" : "", reports::guidance_text(row).c_str(),
      row.size_voxels.x, row.size_voxels.y, row.size_voxels.z, row.spacing_mm.x, row.spacing_mm.y, row.spacing_mm.z,
      row.hu_min, row.hu_max);
  const cases::Instrument& needle = row.instrument;
  std::printf("needle   %s, %.0f mm long, %.2f mm across\n", casedb::name_of(needle.kind).c_str(), needle.length_mm,
              2.0 * needle.radius_mm);
  for (const reports::SettingFact& one : reports::setting_facts(row))
    std::printf("setting  %s: %s\n", one.words, one.value.c_str());
  for (const auto& [name, value] : row.attributes) std::printf("%s: %s\n", name.c_str(), value.c_str());
  for (const base::Problem& warning : row.warnings)
    std::printf("warning: %s: %s\n", warning.code.c_str(), warning.text.c_str());
  std::fputs(privacy_text(row).c_str(), stdout);
  const std::string prepared = parts->preparation ? casedb::text_of(*parts->preparation) : "";
  if (!prepared.empty()) std::printf("prepared %s\n", prepared.c_str());
  if (parts->received) std::fputs(received_text(*parts->received).c_str(), stdout);
  for (const casedb::LesionRow& lesion : parts->lesions) {
    const cases::LesionForm& form = lesion.form;
    std::printf("lesion   %s at %.1f,%.1f,%.1f mm, %s, %s, radius %.1f mm, %s%.0f HU\n", lesion.lesion_id.c_str(),
                form.center_lps_mm.x, form.center_lps_mm.y, form.center_lps_mm.z, cases::about(form.kind).words,
                base::name_of(cases::kLesionOutlineNames, form.outline).data(), lesion.lesion.radius_mm,
                form.adds ? "tissue + " : "", form.hu);
  }
  for (const casedb::StructureRow& one : parts->structures)
    std::printf("%-10s %s: %s, %s\n", cases::name_of(one.rule).data(), one.name.c_str(),
                volume::about(one.tissue).name, casedb::name_of(one.kind).c_str());
  for (const assessment::Criterion& one : row.rule.criteria)
    std::printf("%s %s\n", one.critical ? "critical  " : "pass      ", assessment::text_of(one).c_str());
  if (!row.rule.criteria.empty()) {
    const auto dependability = casedb::dependability(casedb::learning_attempts(*library, casedb::Learners::people));
    std::printf("shows      %s\n", reports::dependability_text(dependability, casedb::Learners::people).c_str());
  }
  for (const casedb::Decision& one : parts->decisions)
    std::printf("%s by %s%s%s\n", casedb::name_of(one.kind).c_str(), one.who().c_str(),
                one.note.empty() ? "" : ": ", one.note.c_str());
  return kDone;
}

cases::LesionKind lesion_kind_of(const std::string& name) {
  if (const auto kind = base::from_name(cases::kLesionKindNames, name)) return *kind;
  std::string all;
  for (const cases::LesionKindRow& row : cases::lesion_kinds())
    all += (all.empty() ? "" : ", ") + std::string(base::name_of(cases::kLesionKindNames, row.kind));
  throw UsageError("--kind is one of " + all);
}

int run_case_lesion(const Arguments& arguments) {
  if (arguments.has("--remove")) {
    auto library = open_acting(arguments);
    if (!library) return refuse(library.error());
    if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
    const auto removed = casedb::remove_lesion(*library, arguments.positional(0), arguments.text("--remove"));
    return removed ? kDone : refuse(removed.error());
  }
  const glm::dvec3 center = point_of("--center-mm", arguments.required("--center-mm"));
  cases::LesionForm form;
  form.center_lps_mm = center;
  if (arguments.has("--radii-mm")) {
    if (arguments.has("--radius-mm") || arguments.has("--irregular"))
      throw UsageError("--radii-mm cannot be combined with another radius");
    form.outline = cases::LesionOutline::ellipsoid;
    form.radii_mm = point_of("--radii-mm", arguments.text("--radii-mm"));
  } else {
    arguments.required("--radius-mm");
    form.radii_mm = glm::dvec3(arguments.number("--radius-mm", 0.0));
  }
  if (arguments.has("--irregular")) {
    form.outline = cases::LesionOutline::irregular;
    form.roughness = arguments.number("--irregular", 0.0);
    form.seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 9'007'199'254'740'992));
  }
  if (arguments.has("--kind")) form.kind = lesion_kind_of(arguments.text("--kind"));
  form.adds = arguments.has("--contrast-hu");
  if (form.adds && arguments.has("--hu")) throw UsageError("either --hu or --contrast-hu");
  if (form.kind != cases::LesionKind::by_hu && !form.adds && !arguments.has("--hu")) {
    const cases::LesionHu& ct = cases::about(form.kind).ct;
    form.hu = ct.hu;
    form.adds = ct.adds;
  } else {
    arguments.required(form.adds ? "--contrast-hu" : "--hu");
    form.hu = arguments.number(form.adds ? "--contrast-hu" : "--hu", 0.0);
  }
  form.edge_mm = arguments.number("--edge-mm", 0.0);
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
  const auto lesion_id = casedb::add_lesion(*library, arguments.positional(0), form);
  if (!lesion_id) return refuse(lesion_id.error());
  if (arguments.has("--json"))
    std::fputs(json_of_lesion(*lesion_id).c_str(), stdout);
  else
    std::printf("lesion %s\n", lesion_id->c_str());
  return kDone;
}

constexpr Option kLesionOptions[] = {
    kLibrary,
    {"--center-mm", "X,Y,Z", "centre, LPS"},
    {"--radius-mm", "R", "radius of a sphere, or mean radius of an irregular lesion"},
    {"--radii-mm", "A,B,C", "radii of an ellipsoid, along LPS"},
    {"--irregular", "SHARE", "standard deviation of the radius, as a share of it: 0 to 0.3"},
    {"--seed", "N", "which irregular shape; default 1"},
    {"--kind", "KIND",
     "what it is: cyst, hcc, metastasis, haemangioma, abscess, node or isoechoic; default by_hu, the tissue that "
     "fits its HU"},
    {"--hu", "H", "its HU; default the kind's"},
    {"--contrast-hu", "D", "in place of --hu: HU added to those of the tissue there"},
    {"--edge-mm", "W", "width of its edge, over which it fades to nothing; default 0"},
    {"--remove", "LESION", "removes one again"},
    kJson};

}  // namespace

Command case_list_command() {
  return {.name = "case list",
          .options = kLibraryJson,
          .summary = "Lists the cases, oldest first.",
          .run = &run_case_list};
}

Command case_show_command() {
  return {.name = "case show",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .summary = "Shows one case.",
          .run = &run_case_show};
}

Command case_lesion_command() {
  return {.name = "case lesion",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLesionOptions,
          .acts = true,
          .summary = "Places a lesion in a case.",
          .run = &run_case_lesion};
}

}  // namespace seldinger::app
