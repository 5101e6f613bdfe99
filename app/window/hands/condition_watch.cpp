#include "app/window/hands/condition_watch.h"

#include <cmath>

namespace seldinger::app {
namespace {

constexpr double kTellEveryS = 1.0;

void add(const std::optional<double>& lag_s, cases::TimeHistogram& lags) noexcept {
  if (lag_s && *lag_s >= 0.0) lags.add(static_cast<std::uint64_t>(std::llround(1e9 * *lag_s)));
}

void put(const cases::TimeHistogram& lags, casedb::LagQuantiles& into) {
  if (lags.n == 0) return;
  const auto ms = [](std::uint64_t ns) { return 1e-6 * static_cast<double>(ns); };
  into = {ms(lags.quantile_ns(0.5)), ms(lags.quantile_ns(0.95)), ms(lags.most_ns)};
}

}  // namespace

void ConditionWatch::begin(cases::Modality modality) noexcept {
  *this = {};
  modality_ = modality;
}

void ConditionWatch::shown(const Frame& frame) noexcept {
  sound_ = sound_ || frame.sound;
  stereo_ = stereo_ || frame.stereo;
  width_px_ = frame.width_px;
  height_px_ = frame.height_px;
  if (frame.paused) {
    last_s_.reset();
    return;
  }
  if (last_s_) {
    watched_s_ += frame.now_s - *last_s_;
    ++frames_;
    if (frame.new_picture) ++pictures_;
  }
  last_s_ = frame.now_s;
  add(frame.force_lag_s, force_lag_);
  add(frame.room_lag_s, room_lag_);
  add(frame.picture_lag_s, picture_lag_);
}

void ConditionWatch::made_by(const std::string& method) {
  method_ = method;
  fallback_ = fallback_ || method.starts_with("lattice");
}

bool ConditionWatch::due(double now_s) noexcept {
  if (told_s_ >= 0.0 && now_s - told_s_ < kTellEveryS) return false;
  told_s_ = now_s;
  return true;
}

void ConditionWatch::put_into(casedb::Conditions& conditions) const {
  if (!method_.empty()) {
    conditions.picture_method = method_;
    if (modality_ == cases::Modality::ultrasound) conditions.speckle_fallback = fallback_;
  }
  if (watched_s_ > 0.0) {
    conditions.window_rate_hz = static_cast<double>(frames_) / watched_s_;
    conditions.picture_rate_hz = static_cast<double>(pictures_) / watched_s_;
  }
  put(force_lag_, conditions.force_lag);
  put(room_lag_, conditions.room_lag);
  put(picture_lag_, conditions.picture_lag);
  if (width_px_ <= 0) return;  // nothing was shown yet
  conditions.sound = sound_;
  conditions.stereo = stereo_;
  conditions.window_width_px = width_px_;
  conditions.window_height_px = height_px_;
}

}  // namespace seldinger::app
