// Words after a command's name: options, their values, and what ends them.
#include "app/cli/arguments.h"

#include <gtest/gtest.h>

#include "app/cli/command.h"

namespace seldinger::app {
namespace {

constexpr Option kOptions[] = {{"--title", "TEXT", ""}, {"--flag", nullptr, ""}};
const Command kCommand{.name = "try",
                       .positionals = "A [B]",
                       .min_positionals = 1,
                       .max_positionals = 2,
                       .options = kOptions,
                       .summary = "",
                       .run = nullptr};

TEST(Arguments, TwoDashesEndTheOptions) {
  const Arguments one(kCommand, {"--flag", "--", "--title"});
  EXPECT_TRUE(one.has("--flag"));
  EXPECT_FALSE(one.has("--title"));
  ASSERT_EQ(one.positionals(), 1U);
  EXPECT_EQ(one.positional(0), "--title");
  const Arguments two(kCommand, {"--", "--", "-x"});  // the second is a word
  ASSERT_EQ(two.positionals(), 2U);
  EXPECT_EQ(two.positional(0), "--");
  EXPECT_THROW(Arguments(kCommand, {"--"}), UsageError) << "it is no word itself";
  EXPECT_THROW(Arguments(kCommand, {"a", "--unknown"}), UsageError);
}

TEST(Arguments, AValueMayBeginWithADashOrBeTwo) {
  EXPECT_EQ(Arguments(kCommand, {"a", "--title", "-5"}).text("--title"), "-5");
  EXPECT_EQ(Arguments(kCommand, {"a", "--title", "--"}).text("--title"), "--");
}

}  // namespace
}  // namespace seldinger::app
