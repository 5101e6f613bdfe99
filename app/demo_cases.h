// The graded cases that the program brings along (clinical.md, "Cases to ship first"): one table, no code of their
// own. Training only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "casedb/authoring.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {

class Arguments;

// What a case is made of.
enum class DemoSource { torso, torso_dilated, torso_opacified, contrast_liver, abdomen_pelvis, thorax_inlet };

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

// In the order of their numbers.
const std::vector<DemoCase>& demo_cases();

// A CT is known by what lies where: mean HU of 7 × 7 mm at points that its readers named.
struct Landmark {
  glm::dvec3 at_lps_mm;
  double low_hu, high_hu;
};
std::span<const Landmark> landmarks_of(DemoSource source);  // none: built in
// Which of the sources a volume is; nothing when none fits.
std::optional<DemoSource> source_of(const volume::Volume& volume);

int run_demo_cases(const Arguments& arguments);

struct DemoCaseAnswer {
  int number = 0;
  std::string title, case_id, state;
  bool defer = false;      // the right decision; nothing to hit
  std::string attempt_id;  // the expert's that hit
  std::uint64_t seed = 0;
};
std::string json_of_demo_cases(const std::vector<DemoCaseAnswer>& made, const std::vector<int>& not_made,
                               const std::vector<std::pair<std::string, std::string>>& passwords);

}  // namespace seldinger::app
