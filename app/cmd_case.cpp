// case list, case show, case lesion.
#include <cstdio>
#include <unordered_map>

#include "app/answers_json.h"
#include "app/command.h"

namespace seldinger::app {

int run_case_list(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  std::vector<std::pair<casedb::CaseRow, std::vector<casedb::LesionRow>>> cases;
  std::unordered_map<std::string, std::vector<casedb::LesionRow>> lesions_of;
  for (casedb::LesionRow& lesion : casedb::list_lesions(*library))
    lesions_of[lesion.case_id].push_back(std::move(lesion));
  for (casedb::CaseRow& row : casedb::list_cases(*library)) {
    auto lesions = std::move(lesions_of[row.case_id]);
    cases.emplace_back(std::move(row), std::move(lesions));
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_cases(cases).c_str(), stdout);
    return kDone;
  }
  if (cases.empty()) std::puts("There is no case yet; `seldinger import` makes one.");
  for (const auto& [row, lesions] : cases)
    std::printf("%s  %-9s %zu lesion%s  %s\n", row.case_id.c_str(), row.state.c_str(), lesions.size(),
                lesions.size() == 1 ? " " : "s", row.title.c_str());
  return kDone;
}

int run_case_show(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto lesions = casedb::list_lesions(*library, row->case_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_case(*row, lesions).c_str(), stdout);
    return kDone;
  }
  std::printf(
      "case     %s\ntitle    %s\nstate    %s\nguidance %s, patient %s\nvoxels   %d x %d x %d, %.4g x %.4g x %.4g "
      "mm\nHU       %d to %d\n",
      row->case_id.c_str(), row->title.c_str(), row->state.c_str(), casedb::name_of(row->modality).c_str(),
      casedb::name_of(row->position).c_str(), row->size_voxels.x, row->size_voxels.y, row->size_voxels.z,
      row->spacing_mm.x, row->spacing_mm.y, row->spacing_mm.z, row->hu_min, row->hu_max);
  for (const auto& [name, value] : row->attributes) std::printf("%s: %s\n", name.c_str(), value.c_str());
  for (const base::Problem& warning : row->warnings)
    std::printf("warning: %s: %s\n", warning.code.c_str(), warning.text.c_str());
  for (const casedb::LesionRow& lesion : lesions)
    std::printf("lesion   %s at %.1f,%.1f,%.1f mm, radius %.1f mm, %.0f HU\n", lesion.lesion_id.c_str(),
                lesion.lesion.center_lps_mm.x, lesion.lesion.center_lps_mm.y, lesion.lesion.center_lps_mm.z,
                lesion.lesion.radius_mm, lesion.lesion.hu);
  return kDone;
}

int run_case_lesion(const Arguments& arguments) {
  const std::string folder = arguments.required("--library");
  const auto center = parse_point(arguments.required("--center-mm"));
  if (!center) throw UsageError("--center-mm needs X,Y,Z in mm");
  arguments.required("--radius-mm");
  arguments.required("--hu");
  cases::Lesion lesion;
  lesion.center_lps_mm = *center;
  lesion.radius_mm = arguments.number("--radius-mm", 0.0);
  lesion.hu = arguments.number("--hu", 0.0);
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const auto lesion_id = casedb::add_lesion(*library, arguments.positional(0), lesion);
  if (!lesion_id) return refuse(lesion_id.error());
  if (arguments.has("--json"))
    std::fputs(json_of_lesion(*lesion_id).c_str(), stdout);
  else
    std::printf("lesion %s\n", lesion_id->c_str());
  return kDone;
}

}  // namespace seldinger::app
