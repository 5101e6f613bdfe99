#include "assessment/recorder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "sim/base/check.h"

namespace seldinger::assessment {
namespace {

// A tenth of a chunk is the most that waits in the queue for no reason.
constexpr std::chrono::milliseconds kNap{20};

}  // namespace

Recorder::Recorder(std::uint32_t step_version, double dt_s, Store store, RecordedBefore before)
    : step_version_(step_version),
      dt_s_(dt_s),
      store_(std::move(store)),
      queue_(kQueueTicks),
      ticks_(before.ticks),
      chunks_(before.chunks) {
  CHECK(dt_s > 0.0);
  piece_.events.emplace();
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  static_cast<void>(finish());
}

bool Recorder::tick(const cases::RecordedTick& tick) noexcept {
  if (full_.load(std::memory_order_relaxed)) return false;
  const std::uint64_t at = pushed_.load(std::memory_order_relaxed);
  if (at - taken_.load(std::memory_order_acquire) >= kQueueTicks) {
    full_.store(true);
    return false;
  }
  queue_[at % kQueueTicks] = tick;
  pushed_.store(at + 1, std::memory_order_release);
  return true;
}

void Recorder::frame(const cases::FrameTruth& frame) {
  const std::lock_guard lock(frames_mutex_);
  frames_.push_back(frame);
}

void Recorder::note(const cases::Event& event) {
  const std::lock_guard lock(frames_mutex_);
  noted_.push_back(event);
}

base::Result<std::uint32_t> Recorder::finish() {
  stopping_.store(true);
  if (thread_.joinable()) thread_.join();
  if (error_) return *error_;
  return chunks_;
}

void Recorder::run() {
  const auto ticks_per_chunk = static_cast<std::uint64_t>(std::ceil(cases::kChunkSeconds / dt_s_));
  for (bool last = false; !last;) {
    last = stopping_.load();  // before looking: what was handed over until then is seen below
    std::uint64_t waiting = pushed_.load(std::memory_order_acquire) - taken_.load(std::memory_order_relaxed);
    while (waiting > 0) {
      const std::uint64_t room = ticks_per_chunk - piece_.inputs.size();
      const std::uint64_t now = std::min(waiting, room);
      take(static_cast<std::size_t>(now));
      waiting -= now;
      if (now == room) store_piece(static_cast<double>(ticks_) * dt_s_);
    }
    if (!last) std::this_thread::sleep_for(kNap);
  }
  const bool rows_left = [&] {
    const std::lock_guard lock(frames_mutex_);
    piece_.events->insert(piece_.events->end(), noted_.begin(), noted_.end());
    return !frames_.empty() || !noted_.empty();
  }();
  if (!piece_.inputs.empty() || rows_left || chunks_ == 0) store_piece(std::numeric_limits<double>::infinity());
}

void Recorder::take(std::size_t ticks) {
  std::uint64_t at = taken_.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < ticks; ++i, ++at) {
    const cases::RecordedTick& tick = queue_[at % kQueueTicks];
    piece_.inputs.push_back(tick.inputs);
    piece_.hashes.push_back(tick.hash);
    if (tick.pose) piece_.poses.push_back(*tick.pose);
    if (tick.force) piece_.forces.push_back(*tick.force);
    if (tick.endpoint) piece_.endpoint = tick.endpoint;
    cases::add_events(static_cast<double>(ticks_ + i + 1) * dt_s_, tick, *piece_.events);
  }
  taken_.store(at, std::memory_order_release);
  ticks_ += ticks;
}

// A picture that is told of late is in the next chunk: order is what counts.
void Recorder::store_piece(double end_s) {
  {
    const std::lock_guard lock(frames_mutex_);
    const auto later =
        std::find_if(frames_.begin(), frames_.end(), [&](const auto& frame) { return frame.t_s >= end_s; });
    piece_.frames.assign(frames_.begin(), later);
    frames_.erase(frames_.begin(), later);
  }
  piece_.step_version = step_version_;
  piece_.dt_s = dt_s_;
  if (!error_) {
    if (const auto stored = store_(cases::chunk_of(piece_, chunks_)); !stored) {
      error_ = stored.error();
      broken_.store(true);
    } else {
      ++chunks_;
    }
  }
  piece_ = {};
  piece_.events.emplace();
}

}  // namespace seldinger::assessment
