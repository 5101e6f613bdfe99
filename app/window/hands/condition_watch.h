// What the window sees, while an attempt runs, of the conditions under which it is made: how often it draws, how
// far what it shows lags behind the hands, how the pictures are made. The window's thread only.
#pragma once

#include <optional>
#include <string>

#include "casedb/attempts/conditions.h"
#include "sim/case/case.h"
#include "sim/case/record/time_histogram.h"

namespace seldinger::app {

class ConditionWatch {
 public:
  // Of an attempt that begins, or goes on.
  void begin(cases::Modality modality) noexcept;

  // A frame that is shown at now_s by any steady clock, and what belongs to it.
  struct Frame {
    double now_s = 0.0;
    bool paused = false;
    std::optional<double> force_lag_s{}, room_lag_s{};  // of a telling that no frame before knew of
    std::optional<double> picture_lag_s{};              // of a new picture that is live
    bool new_picture = false;
    bool sound = false, stereo = false;
    int width_px = 0, height_px = 0;
  };
  void shown(const Frame& frame) noexcept;
  void made_by(const std::string& method);  // the guidance's pictures, now: Monitor::method

  // About once a second, and with the first frame.
  bool due(double now_s) noexcept;
  void put_into(casedb::Conditions& conditions) const;

 private:
  cases::Modality modality_ = cases::Modality::mpr;
  std::optional<double> last_s_;  // the frame before, out of a pause
  double watched_s_ = 0.0, told_s_ = -1.0;
  std::uint64_t frames_ = 0, pictures_ = 0;
  cases::TimeHistogram force_lag_, room_lag_, picture_lag_;
  bool sound_ = false, stereo_ = false, fallback_ = false;
  int width_px_ = 0, height_px_ = 0;
  std::string method_;
};

}  // namespace seldinger::app
