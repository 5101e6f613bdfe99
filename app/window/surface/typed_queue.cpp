#include "app/window/surface/typed_queue.h"

namespace seldinger::app {

TypedQueue::Given TypedQueue::next_frame(int moves_focus) {
  Given given;
  if (still_frames_ > 0) {
    --still_frames_;
    return given;
  }
  for (; !waiting_.empty() && waiting_.front().key == 0; waiting_.pop_front())
    given.letters.push_back(waiting_.front().letter);
  if (!given.letters.empty() || waiting_.empty()) return given;
  given.key = waiting_.front().key;
  waiting_.pop_front();
  if (given.key == moves_focus) still_frames_ = kStillFrames;
  return given;
}

}  // namespace seldinger::app
