// Every row of the shelf's table, with whatever it is given.
#include "assessment/statistics/reliability/reliability_procedures.h"

#include "tests/assessment/statistics/reliability/odd_reliability.h"

namespace seldinger::assessment::statistics {
namespace {

TEST(ReliabilityProcedures, AnswerOddTablesWithNumbersOrAReason) {
  fixtures::expect_sound_reliability(2000);
}

TEST(ReliabilityProcedures, NameTheOptionThatIsWrong) {
  for (const Procedure& procedure : reliability_procedures()) {
    if (std::string(procedure.name) == "alpha" || std::string(procedure.name) == "omega") continue;
    fixtures::expect_wrong_options_named({&procedure, 1}, fixtures::reliability_options());
  }
}

TEST(ReliabilityProcedures, NameTheItemOptionThatIsWrong) {
  DataTable items;
  items.rows = 5;
  items.values = {{"a", {1, 2, 3, 4, 5}}, {"b", {2, 1, 4, 3, 5}}, {"c", {1, 3, 2, 5, 4}}};
  for (const Procedure& procedure : reliability_procedures()) {
    if (std::string(procedure.name) != "alpha" && std::string(procedure.name) != "omega") continue;
    for (const ProcedureOption& option : procedure.options) {
      const Answer answer =
          procedure.run(items, ProcedureOptions(fixtures::OptionTexts{{option.name, "nonsense"}}));
      EXPECT_EQ(answer.reason, "bad_value") << procedure.name << " " << option.name;
      ASSERT_FALSE(answer.notes.empty());
      EXPECT_NE(answer.notes.front().find(option.name), std::string::npos) << answer.notes.front();
    }
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
