// The eight regions that the thesis names (kidneys, groins, liver, neck; §4.1): a case of each by `demo --cases`,
// of a built-in patient, with a free way to its target and something that must not be met beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "app/demo/demo_case_parts.h"
#include "casedb/cases/authoring.h"
#include "casedb/database/library.h"
#include "session/case/case_check.h"
#include "sim/case/form/shape.h"
#include "tests/fixtures/folders.h"

namespace seldinger::app {
namespace {

struct Target {
  const char* region;
  const DemoCase* made;
  std::vector<const char*> avoid;  // labels of the patient
};

std::vector<Target> targets() {
  const std::vector<const char*> kidney = {"renal_sinus", "collecting_system", "colon", "lung", "pleural_recess"},
                                 neck = {"carotid_artery", "lung", "airway", "thyroid", "nerve"};
  const auto graded = [](int number) { return &demo_cases().at(static_cast<std::size_t>(number - 1)); };
  const auto access = [](int number) { return &access_cases().at(static_cast<std::size_t>(number - 1)); };
  return {
      {"liver, under the ribs", graded(1), {"gallbladder", "stomach", "colon", "small_bowel", "vena_cava"}},
      {"liver, between ribs", graded(2), {"lung", "pleural_recess", "intercostal_bundle", "colon", "gallbladder"}},
      // The calyx that is its target is urine itself: artery and pelvis beside it are drawn.
      {"right kidney", graded(5), {"colon", "lung", "pleural_recess"}},
      {"left kidney", graded(3), kidney},
      {"right groin", access(1), {"femoral_artery", "nerve", "small_bowel"}},
      {"left groin", access(2), {"femoral_vein", "nerve", "small_bowel"}},
      {"right neck", graded(4), neck},
      {"left neck", access(3), neck}};
}

double to_way_mm(const glm::dvec3& p, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double share = glm::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::length(p - from - share * way);
}

// From the straight way to the nearest voxel's middle of what must be avoided, or to what is drawn as that.
double nearest_mm(const casedb::NewCase& patient, const Target& target, const glm::dvec3& entry_lps_mm) {
  const volume::Volume& volume = patient.volume;
  std::vector<bool> avoid(patient.labels->names.size());
  for (std::size_t i = 0; i < avoid.size(); ++i)
    for (const char* name : target.avoid) avoid[i] = avoid[i] || patient.labels->names[i] == name;
  const glm::dvec3 to_lps_mm = target.made->lesions.front().center_lps_mm;
  double least_mm = 1e9;
  std::size_t at = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at)
        if (avoid[patient.labels->label[at]])
          least_mm = std::min(least_mm, to_way_mm(glm::dvec3(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)),
                                                  entry_lps_mm, to_lps_mm));
  for (const DemoStructure& one : target.made->structures)
    if (one.row.kind == casedb::StructureKind::drawn && one.row.rule == cases::StructureRule::critical)
      for (double at_share = 0.0; at_share <= 1.0; at_share += 0.005)
        least_mm = std::min(
            least_mm, cases::signed_distance_mm(one.row.drawn, glm::mix(entry_lps_mm, to_lps_mm, at_share), 30.0));
  return least_mm;
}

TEST(Regions, AllEightAreReachedPastSomethingThatMustBeAvoided) {
  auto library = casedb::Library::open_or_create(fixtures::fresh_folder("regions"));
  ASSERT_TRUE(library);
  std::map<DemoSource, casedb::NewCase> patients;
  for (const Target& target : targets()) {
    SCOPED_TRACE(target.region);
    const DemoSource source = target.made->source;
    if (!patients.contains(source)) {
      auto made = built_in(source);
      ASSERT_TRUE(made && *made);
      patients.emplace(source, std::move(**made));
    }
    casedb::NewCase patient = patients.at(source);
    const auto& names = patient.labels->names;
    for (const char* name : target.avoid)
      EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    static_cast<casedb::CaseSetting&>(patient) = target.made->setting;
    patient.title = target.region;
    const std::string case_id = casedb::add_case(*library, patient);
    const auto parts = add_parts(*library, *target.made, case_id);
    ASSERT_TRUE(parts) << parts.error().text;
    const auto checked = session::check_case(*library, case_id);
    ASSERT_TRUE(checked);
    int reached = 0;
    for (const session::Check& one : checked->checks) {
      EXPECT_TRUE(one.holds) << one.name << ": " << one.text;
      if (one.name != "lesion_reachable" || !one.holds) continue;
      const double past_mm = nearest_mm(patient, target, *one.place_lps_mm);
      RecordProperty(target.region, std::to_string(past_mm));
      EXPECT_GT(past_mm, 1.0);
      EXPECT_LT(past_mm, 25.0) << "nothing near the way makes it a case";
      ++reached;
    }
    EXPECT_EQ(reached, 1);
  }
}

}  // namespace
}  // namespace seldinger::app
