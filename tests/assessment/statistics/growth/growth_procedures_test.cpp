// Every row of the shelf's table, with whatever it is given.
#include "assessment/statistics/growth/growth_procedures.h"

#include <gtest/gtest.h>

#include "tests/assessment/statistics/growth/odd_growth.h"

namespace seldinger::assessment::statistics {
namespace {

TEST(GrowthProcedures, AnswerOddTablesWithNumbersOrAReason) {
  fixtures::expect_sound_growth(2000);
}

TEST(GrowthProcedures, NameTheOptionThatIsWrong) {
  fixtures::expect_wrong_options_named(growth_procedures(), {});
}

}  // namespace
}  // namespace seldinger::assessment::statistics
