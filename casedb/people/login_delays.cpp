#include "casedb/people/login_delays.h"

#include <algorithm>

#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

constexpr int kFreeTries = 5;
constexpr std::int64_t kSecond_us = 1000000, kLongestWait_us = 60 * kSecond_us;
constexpr std::size_t kMostKept = 20000;  // of about 200 bytes

}  // namespace

std::int64_t login_wait_us(int failures) {
  if (failures < kFreeTries) return 0;
  const int doublings = std::min(failures - kFreeTries, 20);
  return std::min(kSecond_us << doublings, kLongestWait_us);
}

std::int64_t whole_seconds(std::int64_t duration_us) {
  return duration_us <= 0 ? 0 : (duration_us + kSecond_us - 1) / kSecond_us;
}

std::string folded_name(std::string_view name) {
  return base::lower(name.substr(0, 256));  // longer names do not exist: 64 characters of at most 4 bytes
}

std::int64_t LoginDelays::begin(std::string_view name, std::string_view place, std::int64_t now_us) {
  const std::lock_guard lock(mutex_);
  const auto ready_us = [](const Tries& one) { return one.last_us + login_wait_us(one.failures); };
  const std::pair<std::string, std::string> key{folded_name(name), place};
  auto found = tries_.find(key);
  if (found != tries_.end() && now_us - found->second.last_us >= kLoginForgotten_us) {
    tries_.erase(found);
    found = tries_.end();
  }
  if (found != tries_.end() && ready_us(found->second) > now_us)
    return whole_seconds(ready_us(found->second) - now_us);
  if (found == tries_.end() && tries_.size() >= kMostKept) {
    // Those that delay nobody are forgotten first, so that no crowd of names washes a long wait away.
    std::erase_if(tries_, [&](const auto& one) {
      return one.second.failures < kFreeTries || now_us - one.second.last_us >= kLoginForgotten_us;
    });
    if (tries_.size() >= kMostKept)
      tries_.erase(std::min_element(tries_.begin(), tries_.end(), [&](const auto& a, const auto& b) {
        return a.second.last_us < b.second.last_us;
      }));
  }
  Tries& tries = tries_[key];
  ++tries.failures;
  tries.last_us = now_us;
  return 0;
}

void LoginDelays::take_back(std::string_view name, std::string_view place) {
  const std::lock_guard lock(mutex_);
  const auto found = tries_.find({folded_name(name), std::string(place)});
  if (found != tries_.end() && --found->second.failures <= 0) tries_.erase(found);
}

void LoginDelays::forget(std::string_view name, std::string_view place) {
  const std::lock_guard lock(mutex_);
  tries_.erase({folded_name(name), std::string(place)});
}

void LoginDelays::forget(std::string_view name) {
  const std::string folded = folded_name(name);
  const std::lock_guard lock(mutex_);
  std::erase_if(tries_, [&](const auto& one) { return one.first.first == folded; });
}

bool LoginDelays::heed(std::string_view name, std::int64_t let_in_again) {
  {
    const std::lock_guard lock(mutex_);
    std::int64_t& heeded = heeded_[folded_name(name)];
    if (let_in_again <= heeded) return false;
    heeded = let_in_again;
  }
  forget(name);
  return true;
}

std::int64_t LoginDelays::longest_wait_s(std::string_view name, std::int64_t now_us) {
  const std::string folded = folded_name(name);
  std::int64_t longest_us = 0;
  const std::lock_guard lock(mutex_);
  for (auto it = tries_.lower_bound({folded, ""}); it != tries_.end() && it->first.first == folded; ++it)
    longest_us = std::max(longest_us, it->second.last_us + login_wait_us(it->second.failures) - now_us);
  return whole_seconds(longest_us);
}

}  // namespace seldinger::casedb
