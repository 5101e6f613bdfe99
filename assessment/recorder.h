// Records an attempt while it runs. The servo hands over its ticks without waiting: they go through a bounded queue
// to a thread of the recorder, which makes a chunk of each two seconds and gives it to be stored. What was handed
// over before a crash is lost only as far as its chunk was not stored.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "sim/base/result.h"
#include "sim/case/record/recorded_tick.h"
#include "sim/case/record/recording.h"

namespace seldinger::assessment {

// What of a recording was stored by a recorder that is gone.
struct RecordedBefore {
  std::uint64_t ticks = 0;
  std::uint32_t chunks = 0;
};

class Recorder {
 public:
  // Called by the recorder's thread, chunk after chunk. After the first error it is called no more.
  using Store = std::function<base::Result<void>(const cases::RecordingChunk&)>;

  // dt_s > 0 (CHECKed).
  Recorder(std::uint32_t step_version, double dt_s, Store store, RecordedBefore before = {});
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();  // as finish

  // By the servo only. Allocates and locks nothing. False, from then on: the queue was full (kQueueTicks behind),
  // and the recording ends with the tick before.
  bool tick(const cases::RecordedTick& tick) noexcept;
  // What a picture showed, by rising time; by any thread but the servo's.
  void frame(const cases::FrameTruth& frame);

  // What was noted (cases::EventInfo::noted) after the last tick; by any thread once no tick comes any more.
  void note(const cases::Event& event);

  // Stores what is left. How many chunks there are, at least one; the first error of `store`. Again: the same.
  base::Result<std::uint32_t> finish();

  // Whether ticks were turned away, or a chunk could not be stored: the attempt cannot go on as it should.
  bool failed() const noexcept { return full_.load() || broken_.load(); }
  bool fell_behind() const noexcept { return full_.load(); }

  static constexpr std::size_t kQueueTicks = 8192;

 private:
  void run();
  void take(std::size_t ticks);
  void store_piece(double end_s);

  std::uint32_t step_version_;
  double dt_s_;
  Store store_;
  std::vector<cases::RecordedTick> queue_;
  alignas(64) std::atomic<std::uint64_t> pushed_{0};
  alignas(64) std::atomic<std::uint64_t> taken_{0};
  std::atomic<bool> full_{false}, broken_{false}, stopping_{false};

  std::mutex frames_mutex_;
  std::vector<cases::FrameTruth> frames_;  // not yet in a chunk
  std::vector<cases::Event> noted_;        // for the last; frames_mutex_'s, too

  cases::Recording piece_;  // from here on: the recorder's thread only
  std::uint64_t ticks_ = 0;
  std::uint32_t chunks_ = 0;
  std::optional<base::Error> error_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::assessment
