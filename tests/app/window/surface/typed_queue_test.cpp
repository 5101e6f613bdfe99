// Tests of app/window/surface/typed_queue: what is typed in one frame comes in order, and none while the focus
// moves.
#include "app/window/surface/typed_queue.h"

#include <gmock/gmock.h>

#include <string>

namespace seldinger::app {
namespace {

constexpr int kTabKey = 258, kEnterKey = 257;

std::string text(const TypedQueue::Given& given) {
  return {given.letters.begin(), given.letters.end()};
}
void type(TypedQueue& queue, const std::string& words) {
  for (const char letter : words) queue.letter(static_cast<unsigned int>(letter));
}

TEST(TypedQueue, NameTabPasswordAndEnterInOneFrame) {
  TypedQueue queue;
  type(queue, "mona");
  queue.key(kTabKey);
  type(queue, "secret");
  queue.key(kEnterKey);
  std::vector<std::string> frames;
  for (int frame = 0; queue.waits(); ++frame) {
    ASSERT_LT(frame, 20);
    const auto given = queue.next_frame(kTabKey);
    EXPECT_TRUE(given.letters.empty() || !given.key) << "a key has a frame of its own";
    frames.push_back(given.key == kTabKey ? "TAB" : given.key == kEnterKey ? "ENTER" : text(given));
  }
  EXPECT_THAT(frames, testing::ElementsAre("mona", "TAB", "", "", "secret", "ENTER"));
}

TEST(TypedQueue, NothingWaitsAtFirstAndATabAloneIsStillForTwoFrames) {
  TypedQueue queue;
  EXPECT_FALSE(queue.waits());
  queue.key(kTabKey);
  EXPECT_EQ(queue.next_frame(kTabKey).key, kTabKey);
  type(queue, "a");
  for (int frame = 0; frame < TypedQueue::kStillFrames; ++frame) {
    EXPECT_TRUE(queue.waits());
    EXPECT_TRUE(queue.next_frame(kTabKey).letters.empty());
  }
  EXPECT_EQ(text(queue.next_frame(kTabKey)), "a");
  EXPECT_FALSE(queue.waits());
}

}  // namespace
}  // namespace seldinger::app
