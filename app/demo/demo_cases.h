// The drills and graded cases that the program brings along (docs/clinical.md, "First hour" and "Cases to ship
// first"): one table, no code of their own. Training only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "casedb/cases/authoring.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {

class Arguments;

// What a case is made of.
enum class DemoSource {
  gel_plane,
  gel_tip,
  gel_across,
  torso,
  torso_dilated,
  torso_opacified,
  torso_prone,
  neck,
  neck_obese,
  groin_child,
  groin_lean,
  contrast_liver,
  abdomen_pelvis,
  thorax_inlet
};

struct DemoStructure {
  casedb::StructureRow row;  // without its ids
  std::string label;         // kind label: its name
};

struct DemoCase {
  int number;
  std::string title;
  DemoSource source;
  casedb::CaseSetting setting;
  std::vector<cases::LesionForm> lesions;
  std::vector<DemoStructure> structures;
};

// In the order of their numbers, each from 1: what comes before patients, and what then is graded; all built in.
const std::vector<DemoCase>& drills();
const std::vector<DemoCase>& demo_cases();
// Beside them: access to vessels of groins and neck, so that no region and no body of the built-in patients is
// without.
const std::vector<DemoCase>& access_cases();
// Of a CT of a patient: what takes the place of those with the same number where that CT is at hand.
const std::vector<DemoCase>& demo_cases_of_ct();

// A CT is known by what lies where: mean HU of 7 × 7 mm at points that its readers named.
struct Landmark {
  glm::dvec3 at_lps_mm;
  double low_hu, high_hu;
};
std::span<const Landmark> landmarks_of(DemoSource source);  // none: built in
// Which of the sources a volume is; nothing when none fits.
std::optional<DemoSource> source_of(const volume::Volume& volume);
// Made here; nothing for those that need a CT.
std::optional<base::Result<casedb::NewCase>> built_in(DemoSource source);

int run_demo_cases(const Arguments& arguments);

struct DemoCaseAnswer {
  int number = 0;
  std::string title, case_id;
  casedb::CaseState state = casedb::CaseState::draft;
  bool defer = false;      // the right decision; nothing to hit
  std::string attempt_id;  // the expert's that hit and passed
  std::uint64_t seed = 0;
  std::vector<base::Problem> warnings;  // of import
};
struct DemoCurriculum {
  std::string title, curriculum_id;
  std::size_t items = 0;
};
struct DemoCasesAnswer {
  std::vector<DemoCaseAnswer> drills, cases, access;
  std::vector<base::Error> left_out;  // of the CTs that were given: why nothing is made of them
  std::vector<DemoCurriculum> curricula;
  std::vector<std::pair<std::string, std::string>> passwords;
};
std::string json_of_demo_cases(const DemoCasesAnswer& answer);

}  // namespace seldinger::app
