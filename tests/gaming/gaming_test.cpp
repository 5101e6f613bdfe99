// Nobody passes a case that the program brings along by parking, freezing, creeping, starting again, talking, or
// firing anywhere else: those of gel and of the built-in patients.
#include "tests/gaming/all_players.h"

namespace seldinger::gaming {
namespace {

TEST(Gaming, PassesNoDrillAndNoCaseOfBuiltInPatients) {
  const fixtures::CommandLibrary made(fixtures::fresh_folder("gaming"));
  const auto demo = made.demo("--cases");
  ASSERT_EQ(demo.at("cases").size(), 8U);
  ASSERT_EQ(demo.at("access").size(), 3U);
  auto library = casedb::Library::open(made.path());
  ASSERT_TRUE(library.has_value()) << library.error().text;
  const auto all = all_played(*library);
  EXPECT_EQ(all.size(), 14U * (1 + gaming_players().size()));
  expect_only_honest_passes(all);
}

}  // namespace
}  // namespace seldinger::gaming
