// When a picture is due, of a machine whose rate may change under it.
#pragma once

#include <cmath>

namespace seldinger::session {

class PictureClock {
 public:
  // Whether one is due; asked by rising time. The first at once, then rate_hz a second; at another rate from the
  // last picture on.
  bool due(double t_s, double rate_hz) noexcept {
    if (rate_hz != rate_hz_) {
      if (rate_hz_ > 0.0) {
        since_s_ = last_s_;
        before_ = count_ - 1;
        told_ = 1;
      }
      rate_hz_ = rate_hz;
    }
    const auto now = static_cast<long long>(std::floor((t_s - since_s_) * rate_hz));
    if (now < told_) return false;
    told_ = now + 1;
    count_ = before_ + told_;
    last_s_ = t_s;
    return true;
  }
  // Until now, with those that nobody asked for.
  long long count() const noexcept { return count_; }
  bool operator==(const PictureClock&) const = default;

  // each(…) is called with all that it remembers, for who saves and restores it.
  template <typename Each, typename Clock>
  static void visit(Each&& each, Clock& clock) {
    auto& [rate_hz, since_s, last_s, told, before, count] = clock;
    each(rate_hz, since_s, last_s, told, before, count);
  }

 private:
  double rate_hz_ = 0.0, since_s_ = 0.0, last_s_ = 0.0;
  long long told_ = 0, before_ = 0, count_ = 0;
};

}  // namespace seldinger::session
