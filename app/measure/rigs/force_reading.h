// One figure of what the hand feels, held against its limit; `seldinger goals haptics` prints them.
#pragma once

namespace seldinger::measure {

struct ForceReading {
  const char* what;
  const char* where;  // tissue, device
  double measured;    // NaN: nothing was seen, and no limit holds
  const char* unit;
  double limit;
  bool at_least = false;  // else at most

  bool holds() const noexcept { return at_least ? measured >= limit : measured <= limit; }
};

}  // namespace seldinger::measure
