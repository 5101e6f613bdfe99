// What is typed into fields, given out frame by frame. Dear ImGui 1.86 takes a frame's letters for the field that
// has the focus when it begins, and needs two more until Tab has moved it: of who types faster than a slow window
// draws, letters after a Tab would be lost, a password's first ones. Pure.
#pragma once

#include <deque>
#include <optional>
#include <vector>

namespace seldinger::app {

class TypedQueue {
 public:
  struct Given {
    std::vector<unsigned int> letters;  // code points
    std::optional<int> key;             // pressed in this frame
  };

  // In the order in which they come. A key: only what moves the focus, and what is pressed while others wait.
  void letter(unsigned int code_point) { waiting_.push_back({code_point, 0}); }
  void key(int key) { waiting_.push_back({0, key}); }
  bool waits() const noexcept { return !waiting_.empty() || still_frames_ > 0; }
  // Of the frame that begins: letters up to the next key, or that key alone. After `moves_focus` nothing for
  // kStillFrames.
  Given next_frame(int moves_focus);

  static constexpr int kStillFrames = 2;

 private:
  struct Typed {
    unsigned int letter = 0;
    int key = 0;
  };
  std::deque<Typed> waiting_;
  int still_frames_ = 0;
};

}  // namespace seldinger::app
