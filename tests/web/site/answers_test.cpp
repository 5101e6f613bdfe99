// Heavy answers: made once, one at a time, kept within a bound.
#include "web/site/answers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/fixtures/until.h"

namespace seldinger::web {
namespace {

Answers::Make making(std::string text, std::atomic<int>& made) {
  return [text = std::move(text), &made]() -> base::Result<Answers::Made> {
    ++made;
    return Answers::Made{text, true};
  };
}

// Was: each of 60 requests at once loaded the case for itself, 85 MB each.
TEST(Answers, SixtyAtOnceMakeOneAndNeverTwoAtATime) {
  Answers answers;
  std::atomic<int> made = 0, inside = 0, most = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 60; ++i)
    threads.emplace_back([&, i] {
      const auto text = answers.get(i % 2 == 0 ? "a" : "b", [&]() -> base::Result<Answers::Made> {
        ++made;
        most = std::max(most.load(), ++inside);
        fixtures::let_pass(0.02);  // as long as others need to come
        --inside;
        return Answers::Made{"text", true};
      });
      EXPECT_EQ(text.value()->text, "text");
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made.load(), 2);
  EXPECT_EQ(most.load(), 1);
}

TEST(Answers, WhatHasChangedMeanwhileAndWhatIsRefusedIsNotKept) {
  Answers answers;
  int made = 0;
  const Answers::Make changing = [&]() -> base::Result<Answers::Made> {
    return Answers::Made{std::to_string(++made), false};
  };
  EXPECT_EQ(answers.get("a", changing).value()->text, "1");
  EXPECT_EQ(answers.get("a", changing).value()->text, "2");
  const Answers::Make refusing = []() -> base::Result<Answers::Made> {
    return base::Error{"damaged", "is damaged"};
  };
  EXPECT_EQ(answers.get("a", refusing).error().code, "damaged");
  EXPECT_EQ(answers.get("a", changing).value()->text, "3");
}

TEST(Answers, TheLongestUnusedMakeRoom) {
  Answers answers(3500);
  std::atomic<int> made = 0;
  const std::string large(1000, 'x');
  for (const char* key : {"a", "b", "a", "c", "d", "a"})
    EXPECT_EQ(answers.get(key, making(large, made)).value()->text, large);
  EXPECT_EQ(made.load(), 4) << "a was used in between and kept";
  EXPECT_TRUE(answers.get("b", making(large, made)).has_value());
  EXPECT_EQ(made.load(), 5) << "b had gone";
  const std::string too_large(5000, 'x');
  EXPECT_EQ(answers.get("e", making(too_large, made)).value()->text, too_large);
}

}  // namespace
}  // namespace seldinger::web
