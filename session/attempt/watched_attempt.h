// A stored attempt to be watched as it was made: its inputs go through the same step again, at the wall's pace or
// faster, and room and monitor show what comes. One that is being made is followed from where it has come to, as
// its pieces are stored: some seconds behind the hand. Nothing is recorded.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "assessment/replay_marks.h"
#include "casedb/attempts/attempts.h"
#include "session/monitor/monitor.h"
#include "sim/base/result.h"

namespace seldinger::session {

class WatchedAttempt {
 public:
  enum class Phase { preparing, playing, over, refused };

  // Begins at once.
  WatchedAttempt(std::filesystem::path library, std::string attempt_id, PicturesBy by = PicturesBy::cpu);
  ~WatchedAttempt();
  WatchedAttempt(const WatchedAttempt&) = delete;
  WatchedAttempt& operator=(const WatchedAttempt&) = delete;

  Phase phase() const noexcept { return phase_.load(std::memory_order_acquire); }
  const base::Error& error() const;  // `refused` only (CHECKed), as this all from `playing` on:
  const casedb::AttemptRow& attempt() const;
  const cases::Case& scene() const;
  std::shared_ptr<const cases::Case> kept_scene() const { return scene_; }  // for who works on it beside
  std::shared_ptr<const cases::Recording> recording() const;                // so far
  // It is being made right now; what it holds grows, and nothing is told of what happened when.
  bool live() const noexcept { return live_; }
  Monitor& monitor();
  const std::vector<assessment::ReplayMark>& marks() const;  // what happened when
  // When the needle first went through the skin, and when it was fired; nothing: that never was.
  std::optional<double> punctured_s() const;
  std::optional<double> fired_s() const;

  std::optional<engine::Moment> moment() noexcept { return moments_.take(); }  // the newest since the last call
  double duration_s() const;
  void set_speed(double times) noexcept { speed_ = times; }  // 0: it stands
  double speed() const noexcept { return speed_; }
  // From there on, forwards or back: what lies before is stepped through as fast as it goes.
  void go_to(double t_s) noexcept { wanted_s_ = t_s < 0.0 ? 0.0 : t_s; }

 private:
  void run();
  void play(casedb::Library& library);  // until it is to end
  void look_for_more(casedb::Library& library);
  base::Result<casedb::AttemptRow> find(casedb::Library& library);

  std::filesystem::path library_;
  std::string attempt_id_;
  PicturesBy by_;
  std::atomic<Phase> phase_{Phase::preparing};
  std::optional<base::Error> error_;
  std::optional<casedb::AttemptRow> attempt_;
  std::shared_ptr<const cases::Case> scene_;
  mutable std::mutex recording_mutex_;
  std::shared_ptr<const cases::Recording> recording_;
  std::atomic<bool> live_{false};
  std::vector<assessment::ReplayMark> marks_;
  std::optional<double> punctured_s_, fired_s_;
  std::unique_ptr<Monitor> monitor_;
  base::Snapshot<engine::Moment> moments_;
  static constexpr double kNowhere = -1.0;
  std::atomic<double> speed_{1.0}, wanted_s_{kNowhere};
  std::atomic<bool> ending_{false};
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::session
