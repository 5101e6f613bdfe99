#include "app/window/surface/attempt_layout.h"

#include <gtest/gtest.h>

#include <array>

namespace seldinger::app {
namespace {

struct Screen {
  float width, height, letters;
};
// Windows, with a frame of 24 × 44 pixels about the parts.
constexpr std::array<Screen, 7> kScreens = {{{800, 600, 0.875F},
                                             {800, 600, 1.0F},
                                             {960, 640, 1.0F},
                                             {1280, 800, 1.0F},
                                             {1280, 800, 1.6F},
                                             {1920, 1080, 1.0F},
                                             {1920, 1080, 1.6F}}};
constexpr float kFrameX = 24.0F, kFrameY = 44.0F;

bool apart(const Part& a, const Part& b) {
  return a.left + a.width <= b.left || b.left + b.width <= a.left || a.top + a.height <= b.top ||
         b.top + b.height <= a.top;
}

TEST(AttemptLayoutTest, PartsLieInTheWindowAndNotOverEachOther) {
  for (const Screen& screen : kScreens)
    for (const float console_px : {0.0F, 140.0F})
      for (const float acts_px : {0.0F, 90.0F, 400.0F, 5000.0F}) {
        const float width = screen.width - kFrameX, height = screen.height - kFrameY;
        const AttemptLayout layout = attempt_layout(width, height, screen.letters, console_px, acts_px);
        const std::array<Part, 5> parts = {layout.main, layout.inset, layout.console, layout.acts, layout.hands};
        for (std::size_t i = 0; i < parts.size(); ++i) {
          SCOPED_TRACE(testing::Message() << screen.width << " × " << screen.height << ", letters "
                                          << screen.letters << ", acts " << acts_px << ", part " << i);
          EXPECT_GE(parts[i].left, 0.0F);
          EXPECT_GE(parts[i].top, 0.0F);
          EXPECT_GE(parts[i].width, 0.0F);
          EXPECT_GE(parts[i].height, 0.0F);
          EXPECT_LE(parts[i].left + parts[i].width, width + 0.01F);
          EXPECT_LE(parts[i].top + parts[i].height, height + 0.01F);
          for (std::size_t j = 0; j < i; ++j) EXPECT_TRUE(apart(parts[i], parts[j])) << "over part " << j;
        }
        EXPECT_GE(layout.inset.height, 100.0F * screen.letters);
      }
}

TEST(AttemptLayoutTest, ThePictureHasHalfOfTheWindow) {
  for (const Screen& screen : kScreens) {
    if (screen.letters > 1.0F && screen.width < 1900.0F) continue;  // large letters in a small window take more
    const AttemptLayout layout = attempt_layout(screen.width - kFrameX, screen.height - kFrameY, screen.letters,
                                                0.0F, 96.0F * screen.letters);
    EXPECT_GE(layout.main.width * layout.main.height, 0.5F * screen.width * screen.height)
        << screen.width << " × " << screen.height << ", letters " << screen.letters;
  }
}

TEST(AttemptLayoutTest, TheConsoleTakesFromThePictureAlone) {
  const AttemptLayout folded = attempt_layout(1256.0F, 756.0F, 1.0F, 0.0F, 200.0F),
                      open = attempt_layout(1256.0F, 756.0F, 1.0F, 70.0F, 200.0F);
  EXPECT_EQ(folded.inset, open.inset);
  EXPECT_EQ(folded.acts, open.acts);
  EXPECT_EQ(folded.hands, open.hands);
  EXPECT_EQ(open.main.height, folded.main.height - 70.0F - kBetweenPartsPx);
}

}  // namespace
}  // namespace seldinger::app
