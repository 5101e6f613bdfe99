// The eight regions that the thesis names (kidneys, groins, liver, neck; §4.1): each of a built-in patient, with a
// free way to its target and something that must not be met beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "app/cases/import_case.h"
#include "app/demo/demo_case_parts.h"
#include "casedb/cases/authoring.h"
#include "casedb/database/library.h"
#include "session/case/case_check.h"
#include "tests/fixtures/folders.h"

namespace seldinger::app {
namespace {

struct Target {
  const char* region;
  volume::Region scan;
  cases::PatientPosition position;
  glm::dvec3 at_lps_mm;
  double radius_mm;
  std::vector<const char*> avoid;  // labels
};

constexpr auto kSupine = cases::PatientPosition::supine, kProne = cases::PatientPosition::prone;

std::vector<Target> targets() {
  const std::vector<const char*> kidney = {"renal_sinus", "collecting_system", "colon", "lung", "pleural_recess"},
                                 neck = {"carotid_artery", "lung", "airway", "thyroid", "nerve"},
                                 groin = {"femoral_vein", "nerve", "small_bowel"};
  return {
      {"liver, under the ribs",
       volume::Region::torso,
       kSupine,
       {-80.0, -34.0, 0.0},
       12.5,
       {"gallbladder", "stomach", "colon", "small_bowel", "vena_cava"}},
      {"liver, between ribs",
       volume::Region::torso,
       kSupine,
       {-102.0, -22.0, 26.0},
       7.5,
       {"lung", "pleural_recess", "intercostal_bundle", "colon", "gallbladder"}},
      {"right kidney", volume::Region::torso, kProne, {-70.0, 53.0, -58.0}, 7.0, kidney},
      {"left kidney", volume::Region::torso, kProne, {70.0, 53.0, -42.0}, 7.0, kidney},
      {"right groin", volume::Region::groin, kSupine, {-75.0, -48.0, -240.0}, 4.0, groin},
      {"left groin", volume::Region::groin, kSupine, {75.0, -48.0, -240.0}, 4.0, groin},
      {"right neck", volume::Region::neck, kSupine, {-32.6, -19.7, 335.0}, 6.0, neck},
      {"left neck", volume::Region::neck, kSupine, {32.6, -19.7, 335.0}, 5.0, neck},
  };
}

double to_way_mm(const glm::dvec3& p, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double share = glm::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::length(p - from - share * way);
}

// From the straight way to the nearest voxel's middle of what must be avoided.
double nearest_mm(const casedb::NewCase& patient, const Target& target, const glm::dvec3& entry_lps_mm) {
  const volume::Volume& volume = patient.volume;
  std::vector<bool> avoid(patient.labels->names.size());
  for (std::size_t i = 0; i < avoid.size(); ++i)
    for (const char* name : target.avoid) avoid[i] = avoid[i] || patient.labels->names[i] == name;
  double least_mm = 1e9;
  std::size_t at = 0;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at)
        if (avoid[patient.labels->label[at]])
          least_mm = std::min(least_mm, to_way_mm(glm::dvec3(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0)),
                                                  entry_lps_mm, target.at_lps_mm));
  return least_mm;
}

TEST(Regions, AllEightAreReachedPastSomethingThatMustBeAvoided) {
  auto library = casedb::Library::open_or_create(fixtures::fresh_folder("regions"));
  ASSERT_TRUE(library);
  std::map<std::pair<volume::Region, bool>, casedb::NewCase> patients;
  for (const Target& target : targets()) {
    SCOPED_TRACE(target.region);
    const bool prone = target.position == kProne;
    const auto key = std::pair(target.scan, prone);
    if (!patients.contains(key)) {
      auto made = import_phantom(
          {.region = target.scan, .posture = prone ? volume::Posture::prone : volume::Posture::supine});
      ASSERT_TRUE(made);
      patients.emplace(key, std::move(*made));
    }
    casedb::NewCase& patient = patients.at(key);
    patient.title = target.region;
    patient.modality = cases::Modality::ultrasound;
    patient.position = target.position;
    patient.instrument = access_needle(18);
    patient.rule = rule_of({"hit >= 1"}, {"nogo_length_critical <= 0"});
    const std::string case_id = casedb::add_case(*library, patient);
    const auto row = casedb::find_case(*library, case_id);
    ASSERT_TRUE(row);
    const auto maps = casedb::load_label_maps(*library, *row);
    ASSERT_TRUE(maps && maps->size() == 1);
    for (const char* name : target.avoid) {
      const auto& names = maps->front().labels.names;
      const auto found = std::find(names.begin(), names.end(), name);
      ASSERT_NE(found, names.end()) << name;
      casedb::StructureRow structure = labelled(name, cases::StructureRule::critical).row;
      structure.case_id = case_id;
      structure.labels_sha256 = maps->front().sha256;
      structure.label = static_cast<int>(found - names.begin());
      ASSERT_TRUE(casedb::add_structure(*library, structure));
    }
    ASSERT_TRUE(casedb::add_lesion(*library, case_id, sphere_form(target.at_lps_mm, target.radius_mm, 40.0)));
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
