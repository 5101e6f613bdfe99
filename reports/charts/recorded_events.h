// What happened in an attempt at one instant: what hands and buttons did, and its events (sim/case/event.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/case/record/recording.h"

namespace seldinger::reports {

struct RecordedEventInfo {
  std::string kind;    // snake_case
  std::string source;  // hand, trainee, mentor, patient, workstation
  std::string words;   // for pages
  std::string about;   // one sentence
};
const std::vector<RecordedEventInfo>& recorded_event_kinds();

struct RecordedEvent {
  double t_s = 0.0;
  const RecordedEventInfo* info = nullptr;  // one of these
  std::optional<double> wall_s{};           // how long by the wall's clock, of a pause
  std::optional<double> length_mm{};        // that was told with it
};
std::vector<RecordedEvent> recorded_events(const cases::Recording& recording);  // by time

}  // namespace seldinger::reports
