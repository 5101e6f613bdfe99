// Tests of Result: it holds a value or an error, and looking at the wrong one ends the program.
#include "sim/base/result.h"

#include <gtest/gtest.h>

#include <memory>

#include "sim/base/failure.h"

namespace seldinger::base {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{"odd", "the number is odd", {{"more", "and so is its square"}}};
  return number / 2;
}

Result<void> check_even(int number) {
  if (const auto result = half(number); !result) return result.error();
  return {};
}

TEST(Result, a_value_is_held_and_can_be_changed_and_moved_out) {
  auto result = half(8);
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(*result, 4);
  *result = 5;
  EXPECT_EQ(result.value(), 5);
  Result<std::unique_ptr<int>> owner(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(owner.value());
  EXPECT_EQ(*taken, 3);
  Result<std::string> text(std::string("four"));
  EXPECT_EQ(text->size(), 4U);
}

TEST(Result, an_error_is_held_with_its_findings) {
  const auto result = half(7);
  ASSERT_FALSE(result.has_value());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error().code, "odd");
  ASSERT_EQ(result.error().findings.size(), 1U);
  EXPECT_EQ(result.error().findings[0].code, "more");
}

TEST(Result, without_a_value_it_is_success_or_an_error) {
  EXPECT_TRUE(check_even(2).has_value());
  const auto refused = check_even(3);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, "odd");
}

TEST(Result, an_error_and_a_value_of_the_same_type_as_a_string_are_told_apart) {
  const Result<std::string> value(std::string("odd"));
  const Result<std::string> error(Error{"odd", ""});
  EXPECT_TRUE(value.has_value());
  EXPECT_FALSE(error.has_value());
}

TEST(ResultDeathTest, looking_at_the_wrong_side_ends_the_program) {
  EXPECT_DEATH((void)half(7).value(), "CHECK failed");
  EXPECT_DEATH((void)*half(7), "CHECK failed");
  EXPECT_DEATH((void)half(8).error(), "CHECK failed");
  EXPECT_DEATH((void)check_even(2).error(), "CHECK failed");
}

TEST(Failure, carries_its_code_and_text) {
  try {
    throw Failure("disk", "the disk is full");
  } catch (const std::exception& caught) {
    EXPECT_STREQ(caught.what(), "the disk is full");
    EXPECT_EQ(dynamic_cast<const Failure&>(caught).code(), "disk");
  }
}

}  // namespace
}  // namespace seldinger::base
