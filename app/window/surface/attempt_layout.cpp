#include "app/window/surface/attempt_layout.h"

#include <algorithm>

namespace seldinger::app {
namespace {

// Lengths are pixels of letters 16 pixels high.
constexpr float kSideShare = 0.28F, kLeastSide = 200.0F, kMostSide = 560.0F;
constexpr float kInsetShape = 0.65F;  // height of the inset to its width
constexpr float kLeastInset = 104.0F;
constexpr float kHands = 215.0F,
                kHandsNarrow = 250.0F;  // meters and the keys' line, which wraps in a narrow column
constexpr float kNarrow = 280.0F;
constexpr float kWide = 1100.0F, kHigh = 640.0F;  // from these on what is said stands beside the picture
constexpr float kMostActsShare = 0.5F;            // of the height, along the bottom

}  // namespace

AttemptLayout attempt_layout(float width, float height, float letters, float console_px, float acts_px) {
  AttemptLayout layout;
  const float gap = kBetweenPartsPx;
  const float side = std::clamp(kSideShare * width, kLeastSide * letters, kMostSide * letters);
  const float main = width - side - gap, beside = main + gap;
  const float hands = (side < kNarrow * letters ? kHandsNarrow : kHands) * letters;
  const bool wide = width >= kWide * letters && height >= kHigh * letters;
  if (wide) {
    const float inset = kInsetShape * side;
    const float acts = std::clamp(acts_px, 0.0F, height - inset - hands - 2.0F * gap);
    layout.inset = {beside, 0.0F, side, inset};
    layout.acts = {beside, inset + gap, side, acts};
    layout.hands = {beside, inset + acts + 2.0F * gap, side, height - inset - acts - 2.0F * gap};
  } else {
    const float acts = std::clamp(acts_px, 0.0F, kMostActsShare * height), above = height - acts - gap;
    const float inset = std::clamp(above - hands - gap, kLeastInset * letters, kInsetShape * side);
    layout.inset = {beside, 0.0F, side, inset};
    layout.acts = {0.0F, above + gap, width, acts};
    layout.hands = {beside, inset + gap, side, above - inset - gap};
  }
  const float column = wide ? height : layout.acts.top - gap;
  const float console = console_px > 0.0F ? console_px + gap : 0.0F;
  layout.main = {0.0F, 0.0F, main, column - console};
  layout.console = {0.0F, column - console_px, main, console_px};
  return layout;
}

}  // namespace seldinger::app
