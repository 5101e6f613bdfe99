#include "sim/base/names.h"

#include <gtest/gtest.h>

namespace seldinger::base {
namespace {

enum class Colour { red, green, blue };
constexpr auto kColourNames =
    names<Colour>({{Colour::blue, "blue"}, {Colour::red, "red"}, {Colour::green, "green_leaf"}});

TEST(Names, GoBothWaysInAnyOrder) {
  static_assert(name_of(kColourNames, Colour::red) == "red");
  static_assert(from_name(kColourNames, "green_leaf") == Colour::green);
  for (const auto& [value, name] : kColourNames) {
    EXPECT_EQ(name_of(kColourNames, value), name);
    EXPECT_EQ(from_name(kColourNames, name), value);
  }
  for (const char* other : {"", "Red", "red ", "green"}) EXPECT_FALSE(from_name(kColourNames, other)) << other;
}

TEST(Names, AreListedForHelpAndForErrors) {
  EXPECT_STREQ(kAlternatives<kColourNames>, "blue|red|green_leaf");
  EXPECT_EQ(listed(kNamesOf<kColourNames>), "blue, red or green_leaf");
  const std::string_view two[] = {"still", "yields"};
  EXPECT_EQ(listed(two), "still or yields");
  EXPECT_EQ(listed(std::span(two).first(1)), "still");
}

TEST(NamesDeathTest, AValueWithoutANameIsAProgrammersMistake) {
  EXPECT_DEATH(static_cast<void>(name_of(kColourNames, static_cast<Colour>(7))), "names.h");
}

}  // namespace
}  // namespace seldinger::base
