// Where the parts of an attempt's window stand: the picture first. Pure.
#pragma once

namespace seldinger::app {

struct Part {
  float left = 0.0F, top = 0.0F, width = 0.0F, height = 0.0F;
  bool operator==(const Part&) const = default;
};

struct AttemptLayout {
  Part main;     // the guidance's picture, or the room where the trainee has swapped them
  Part inset;    // the other one
  Part console;  // below the main one; no height: it is folded
  Part acts;     // what is said
  Part hands;    // what the hands hold and feel
};

inline constexpr float kBetweenPartsPx = 8.0F;

// Of so many pixels. `letters`: 1 where a line's letters are 16 pixels high. `console_px`: how high the console is,
// 0 folded; `acts_px`: how high what is said wants to be in acts.width, of which it gets what there is. In wide
// windows what is said stands below the inset, in others along the bottom. No part lies over another.
AttemptLayout attempt_layout(float width, float height, float letters, float console_px, float acts_px);

}  // namespace seldinger::app
