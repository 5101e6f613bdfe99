#include "web/login_limits.h"

#include <algorithm>

namespace seldinger::web {
namespace {
constexpr int kFreeTries = 5;
constexpr std::int64_t kSecond_us = 1000000, kLongestWait_us = 900 * kSecond_us, kForgotten_us = 3600 * kSecond_us;
constexpr double kBurst = 60.0;
constexpr int kInside = 2, kWaiting = 8;

std::string folded(std::string_view name) {
  std::string out(name.substr(0, 64));  // longer names do not exist
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::int64_t wait_after_us(int failures) {
  if (failures < kFreeTries) return 0;
  const int doublings = std::min(failures - kFreeTries, 20);
  return std::min(kSecond_us << doublings, kLongestWait_us);
}

std::int64_t whole_seconds(std::int64_t duration_us) {
  return (duration_us + kSecond_us - 1) / kSecond_us;
}
}  // namespace

std::optional<std::int64_t> LoginThrottle::begin(std::string_view name) {
  const std::int64_t now_us = surroundings_.now_us();
  const std::lock_guard lock(mutex_);
  const std::int64_t since_us = now_us - refilled_us_.value_or(now_us);
  tokens_ = std::min(kBurst, tokens_ + static_cast<double>(since_us) / static_cast<double>(kSecond_us));
  refilled_us_ = now_us;
  std::erase_if(by_name_, [&](const auto& entry) { return now_us - entry.second.last_us >= kForgotten_us; });

  const std::string key = folded(name);
  if (const auto found = by_name_.find(key); found != by_name_.end()) {
    const std::int64_t ready_us = found->second.last_us + wait_after_us(found->second.failures);
    if (ready_us > now_us) return whole_seconds(ready_us - now_us);
  }
  if (tokens_ < 1.0) return 1;
  tokens_ -= 1.0;
  Tries& tries = by_name_[key];
  ++tries.failures;
  tries.last_us = now_us;
  return std::nullopt;
}

void LoginThrottle::succeeded(std::string_view name) {
  const std::lock_guard lock(mutex_);
  by_name_.erase(folded(name));
}

std::optional<LoginGate::Pass> LoginGate::enter() {
  std::unique_lock lock(mutex_);
  if (inside_ >= kInside) {
    if (waiting_ >= kWaiting) return std::nullopt;
    ++waiting_;
    left_.wait(lock, [&] { return inside_ < kInside; });
    --waiting_;
  }
  ++inside_;
  return Pass(this);
}

LoginGate::Pass::~Pass() {
  if (gate_ == nullptr) return;
  {
    const std::lock_guard lock(gate_->mutex_);
    --gate_->inside_;
  }
  gate_->left_.notify_one();
}

}  // namespace seldinger::web
