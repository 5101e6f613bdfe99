#include "app/hands/servo_answer.h"

#include <cstdio>

#include "app/hands/formatted.h"

namespace seldinger::app {
namespace {

std::string row(const char* name, const cases::TimeHistogram& histogram) {
  const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
  return formatted("%-10s %10.1f %10.1f %10.1f\n", name, us(histogram.quantile_ns(0.5)),
                   us(histogram.quantile_ns(0.999)), us(histogram.most_ns));
}

}  // namespace

const char* name_of(cases::ServoScheduler scheduler) {
  return scheduler == cases::ServoScheduler::fifo ? "SCHED_FIFO" : "SCHED_OTHER";
}

std::string text_of_servo_record(const cases::ServoRecord& record) {
  return formatted("%-10s %10s %10s %10s\n", "µs", "p50", "p99.9", "max") + row("period", record.period) +
         row("latency", record.latency) + row("compute", record.compute) +
         formatted("ticks %llu, missed %llu (%.3f %%)\n", static_cast<unsigned long long>(record.ticks),
                   static_cast<unsigned long long>(record.missed), 100.0 * record.missed_share()) +
         formatted("scheduler %s, memory %s\n", name_of(record.scheduler),
                   record.memory_locked ? "locked" : "not locked");
}

std::string text_of_servo(const ServoAnswer& answer) {
  return text_of_servo_record(answer.record) +
         formatted("missed at most %.3f %% asked for\n", 100.0 * answer.most_missed_share) +
         formatted("forces up to %.2f N (needle, %llu layers opened) and %.2f N (probe)\n", answer.most_needle_n,
                   static_cast<unsigned long long>(answer.ruptures), answer.most_probe_n);
}

}  // namespace seldinger::app
