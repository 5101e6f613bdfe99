// What a check tells of a case.
#include "session/case/case_check.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "casedb/cases/authoring.h"
#include "tests/fixtures/folders.h"
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

}  // namespace
}  // namespace seldinger::session
