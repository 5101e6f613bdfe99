#include "session/case/case_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "assessment/grading/contradictions.h"
#include "assessment/operators/plan.h"
#include "session/case/case_build.h"

namespace seldinger::session {
namespace {

constexpr double kMostBoneShare = 0.05;   // of a lesion's voxels: more is no biopsy with these needles
constexpr double kEntryNearSkinMm = 5.0;  // a mentor marks an entry on a slice, not on the mesh

std::string mm(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", value);
  return text;
}

void check_rule(const casedb::CaseRow& row, const assessment::Guidance& guidance, std::vector<Check>& checks) {
  if (row.rule.criteria.empty()) {
    checks.push_back({"rule_present", false, "there is no criterion to pass by"});
    return;
  }
  const std::size_t count = row.rule.criteria.size();
  checks.push_back({"rule_present", true, count == 1 ? "1 criterion" : std::to_string(count) + " criteria"});
  const auto problems = assessment::problems_of(row.rule, guidance);
  for (const base::Problem& problem : problems)
    checks.push_back({"rule_meaningful", false, problem.code + ": " + problem.text});
  if (problems.empty())
    checks.push_back({"rule_meaningful", true, "every metric is known and means something here"});
  const auto contradictions = assessment::contradictions_of(row.rule, guidance);
  for (const base::Problem& problem : contradictions)
    checks.push_back({"rule_possible", false, problem.code + ": " + problem.text});
  if (contradictions.empty()) checks.push_back({"rule_possible", true, "no criterion rules itself or another out"});
}

// Share of the lesion's voxels that are bone; of one smaller than a voxel, that voxel's.
double bone_share(const cases::Shape& shape, const glm::dvec3& center_lps_mm, const volume::Volume& volume,
                  const std::vector<volume::TissueClass>& classes) {
  const cases::Bounds bounds = cases::bounds_of(shape);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const double reach_mm = glm::length(bounds.high_lps_mm - bounds.low_lps_mm) / 2.0;
  const glm::dvec3 middle(voxel_from_lps * glm::dvec4((bounds.low_lps_mm + bounds.high_lps_mm) / 2.0, 1.0));
  const glm::dvec3 reach = reach_mm / volume.spacing_mm + 1.0;
  std::size_t all = 0, bone = 0;
  const glm::dvec3 last(volume.size_voxels - 1);
  const glm::ivec3 low(glm::clamp(glm::floor(middle - reach), glm::dvec3(0.0), last));
  const glm::ivec3 high(glm::clamp(glm::ceil(middle + reach), glm::dvec3(0.0), last));
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) {
        const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        if (cases::signed_distance_mm(shape, p, 0.01) > 0.0) continue;
        ++all;
        bone += classes[volume.index(i, j, k)] == volume::TissueClass::bone ? 1 : 0;
      }
  if (all > 0) return static_cast<double>(bone) / static_cast<double>(all);
  const glm::ivec3 at(glm::clamp(glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(center_lps_mm, 1.0)) + 0.5),
                                 glm::dvec3(0.0), last));
  return classes[volume.index(at.x, at.y, at.z)] == volume::TissueClass::bone ? 1.0 : 0.0;
}

// Whether any way to the target begins at skin: where the CT is cut all around it, none does.
bool skin_within_reach(const cases::Case& scene, const glm::dvec3& target_lps_mm) {
  if (scene.skin_index.empty()) return false;
  const cases::Closest near = scene.skin_index.closest_skin(target_lps_mm);
  return !scene.skin_index.cut(near.triangle) && std::abs(near.distance_mm) <= scene.instrument.length_mm;
}

void check_lesion(const cases::Case& scene, const casedb::CaseRow& row, const casedb::LesionRow& lesion,
                  const std::string& which, std::vector<Check>& checks) {
  const double depth_mm = -scene.skin_index.closest(lesion.lesion.center_lps_mm).distance_mm;
  const bool inside = depth_mm >= lesion.lesion.radius_mm;
  checks.push_back(
      {"lesion_inside_body", inside,
       which + (depth_mm < 0.0 ? ": its centre lies outside the body"
                : inside       ? ": its centre lies " + mm(depth_mm) + " within its surface"
                         : ": it sticks out of the body, its centre only " + mm(depth_mm) + " below the surface"),
       lesion.form.center_lps_mm});
  const double bone =
      bone_share(cases::shape_of(lesion.form), lesion.form.center_lps_mm, scene.volume, scene.classes);
  char share[64];
  std::snprintf(share, sizeof share, ": %.0f %% of it is bone", 100.0 * bone);
  checks.push_back({"lesion_not_in_bone", bone <= kMostBoneShare, which + share, lesion.form.center_lps_mm});
  if (row.clinic.defer) {
    checks.push_back({"lesion_reachable", true, which + ": not asked, the right decision is to defer"});
    return;
  }
  if (!skin_within_reach(scene, lesion.lesion.center_lps_mm)) {
    checks.push_back(
        {"lesion_reachable", false,
         which + ": there is no skin within the needle's reach; around it the CT ends within the patient",
         lesion.form.center_lps_mm});
    return;
  }
  assessment::PathLimits limits = assessment::path_limits(scene);
  limits.needs_probe = false;
  limits.max_depth_mm = scene.instrument.length_mm;
  const auto plan = assessment::plan_puncture(scene.volume, scene.skin_index, lesion.lesion.center_lps_mm, limits);
  checks.push_back({"lesion_reachable", plan.has_value(),
                    which + ": " + (plan ? "a free path of " + mm(plan->depth_mm) : plan.error().text),
                    plan ? plan->entry_lps_mm : lesion.form.center_lps_mm});
}

}  // namespace

base::Result<CaseCheck> check_case(casedb::Library& library, const std::string& case_id) {
  std::string mark = casedb::content_mark(library, case_id);
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  cases::Picture picture;
  picture.modality = row->modality;
  // Tissue: whether something is bone is a matter of class.
  const auto scene = build_case(library, *row, std::nullopt, picture, Needs::touch);
  if (!scene) return scene.error();
  return check_loaded_case(std::move(mark), *scene, *row, casedb::list_lesions(library, case_id),
                           casedb::list_structures(library, case_id));
}

CaseCheck check_loaded_case(std::string content_mark, const cases::Case& scene, const casedb::CaseRow& row,
                            const std::vector<casedb::LesionRow>& lesions,
                            const std::vector<casedb::StructureRow>& structures) {
  CaseCheck checked;
  checked.content_mark = std::move(content_mark);
  std::vector<Check>& checks = checked.checks;
  checks.push_back({"lesion_present", !lesions.empty(),
                    lesions.empty() ? "there is no lesion" : std::to_string(lesions.size()) + " placed"});
  for (std::size_t i = 0; i < lesions.size(); ++i)
    check_lesion(scene, row, lesions[i], "lesion " + std::to_string(i + 1), checks);
  if (row.planned_entry_lps_mm) {
    const auto near = scene.skin_index.closest_skin(*row.planned_entry_lps_mm);
    const double off_mm = std::abs(near.distance_mm);
    checks.push_back({"entry_on_skin", off_mm <= kEntryNearSkinMm,
                      "the planned entry is " + mm(off_mm) + " from it", row.planned_entry_lps_mm});
  }
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(scene.volume);
  const auto inside = [&](const glm::dvec3& p) {
    return volume::inside(scene.volume, glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)));
  };
  // By number, as lesions are: a name is what somebody typed, and what was found is told to researchers, too.
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const casedb::StructureRow& one = structures[i];
    if (one.kind != casedb::StructureKind::drawn) continue;
    bool within = true;
    std::optional<glm::dvec3> where;
    if (const auto* tube = std::get_if<cases::Tube>(&one.drawn)) {
      const auto out = std::find_if_not(tube->points_lps_mm.begin(), tube->points_lps_mm.end(), inside);
      within = out == tube->points_lps_mm.end();
      where = within ? tube->points_lps_mm.front() : *out;
    } else {
      const cases::Bounds bounds = cases::bounds_of(one.drawn);
      where = (bounds.low_lps_mm + bounds.high_lps_mm) / 2.0;
      within = inside(*where);
    }
    checks.push_back(
        {"structure_in_volume", within,
         "structure " + std::to_string(i + 1) + (within ? " lies within the volume" : " reaches out of the volume"),
         where});
  }
  assessment::Guidance guidance{
      casedb::manner_of(row),
      assessment::absent_needs(scene.structures, row.planned_entry_lps_mm.has_value(), row.subject)};
  if (!row.probe_is_chosen) guidance.absent |= assessment::kProbeChosen;
  if (row.instrument.kind == cases::InstrumentKind::core) guidance.notch_mm = row.instrument.notch_mm;
  guidance.defer_is_right = row.clinic.defer;
  guidance.sight_law = row.sight_law;
  check_rule(row, guidance, checks);
  checked.rule_may_name = assessment::meaningful_metrics(guidance);
  return checked;
}

}  // namespace seldinger::session
