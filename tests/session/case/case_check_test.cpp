// What a check tells of a case.
#include "session/case/case_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "casedb/cases/authoring.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/meshes.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

// Was: "Mr Quagmire's vessel lies within the volume", which researchers read as checks.json.
TEST(CaseCheckTest, TellsNothingThatSomebodyTyped) {
  casedb::Library library =
      std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("session") / "library").value());
  const std::string case_id = casedb::add_case(library, fixtures::new_ball());
  for (const char* name : {"Mr Quagmire's vessel", "Quagmire"}) {
    casedb::StructureRow one;
    one.case_id = case_id;
    one.name = name;
    one.tissue = volume::TissueClass::vessel;
    one.drawn = cases::Sphere{{0, 20, 0}, 8.0};
    ASSERT_TRUE(casedb::add_structure(library, one));
  }
  const CaseCheck checked = check_case(library, case_id).value();
  int structures = 0;
  for (const Check& one : checked.checks) {
    EXPECT_EQ(one.text.find("Quagmire"), std::string::npos) << one.name << ": " << one.text;
    if (one.name != "structure_in_volume") continue;
    EXPECT_EQ(one.text.substr(0, 11), "structure " + std::to_string(++structures));
  }
  EXPECT_EQ(structures, 2);
}

// 30 mm before and behind the target the CT ends within the patient; skin is as far off as `beside_mm`.
Check reachable(double beside_mm) {
  casedb::Library library =
      std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("session") / "library").value());
  casedb::NewCase made = fixtures::new_ball();
  made.skin = fixtures::box_mesh({-beside_mm, -beside_mm, -30}, {beside_mm, beside_mm, 30}, true);
  const std::string case_id = casedb::add_case(library, made);
  EXPECT_TRUE(casedb::add_lesion(library, case_id, cases::Lesion{{0, 0, 0}, 5.0}));
  const CaseCheck checked = check_case(library, case_id).value();
  const auto found = std::find_if(checked.checks.begin(), checked.checks.end(),
                                  [](const Check& one) { return one.name == "lesion_reachable"; });
  EXPECT_NE(found, checked.checks.end());
  return found == checked.checks.end() ? Check{} : *found;
}

TEST(CaseCheckTest, ATargetWithoutSkinWithinReachIsRefused) {
  const Check far = reachable(250.0);
  EXPECT_FALSE(far.holds);
  EXPECT_NE(far.text.find("there is no skin within the needle's reach"), std::string::npos) << far.text;
  const Check near = reachable(60.0);
  EXPECT_EQ(near.text.find("there is no skin"), std::string::npos) << near.text;
}

}  // namespace
}  // namespace seldinger::session
