// The answer of `haptics selftest`: a table for people, a document for programs.
#pragma once

#include <string>

#include "sim/case/record/servo_record.h"

namespace seldinger::app {

struct ServoAnswer {
  cases::ServoRecord record;
  double most_missed_share = 0.0;  // as asked for
  // That the hands were at work: their motors' most, and how many layers the needle opened.
  double most_needle_n = 0.0, most_probe_n = 0.0;
  std::uint64_t ruptures = 0;

  bool holds() const noexcept { return record.missed_share() <= most_missed_share; }
};

const char* name_of(cases::ServoScheduler scheduler);

// One record: what the table says of it, without the hands.
std::string text_of_servo_record(const cases::ServoRecord& record);
std::string text_of_servo(const ServoAnswer& answer);
std::string json_of_servo(const ServoAnswer& answer);

}  // namespace seldinger::app
