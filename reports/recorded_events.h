// What happened in an attempt at one instant: what hands and buttons did.
#pragma once

#include <string>
#include <vector>

#include "sim/case/recording.h"

namespace seldinger::reports {

struct RecordedEvent {
  double t_s = 0.0;
  std::string kind;  // snake_case; event_kinds() has them all
};

struct EventKindInfo {
  const char* kind;
  const char* what;
};
const std::vector<EventKindInfo>& event_kinds();

std::vector<RecordedEvent> recorded_events(const cases::Recording& recording);  // by time

}  // namespace seldinger::reports
