// Every row of the shelf's table, with whatever it is given.
#include "assessment/statistics/standards/standards_procedures.h"

#include "tests/assessment/statistics/standards/odd_standards.h"

namespace seldinger::assessment::statistics {
namespace {

TEST(StandardsProcedures, AnswerOddTablesWithNumbersOrAReason) {
  fixtures::expect_sound_standards(2000);
}

TEST(StandardsProcedures, NameTheOptionThatIsWrong) {
  for (const Procedure& procedure : standards_procedures()) {
    // A group's name is looked for in the table: cuts_test.cpp.
    if (std::string(procedure.name) == "contrasting_groups") continue;
    fixtures::expect_wrong_options_named({&procedure, 1}, fixtures::standards_options());
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
