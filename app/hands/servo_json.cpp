#include <nlohmann/json.hpp>

#include "app/hands/servo_answer.h"
#include "app/hands/servo_record_json.h"

namespace seldinger::app {

using Json = nlohmann::ordered_json;

namespace {

Json times(const cases::TimeHistogram& histogram) {
  const auto us = [](std::uint64_t ns) { return 1e-3 * static_cast<double>(ns); };
  Json bins = Json::array();  // [longest of the bin, how many], those that are not empty
  for (std::size_t bin = 0; bin < cases::TimeHistogram::kBins; ++bin)
    if (histogram.counts[bin] > 0) bins.push_back({us(cases::longest_of_time_bin_ns(bin)), histogram.counts[bin]});
  return {{"n", histogram.n},
          {"p50_us", us(histogram.quantile_ns(0.5))},
          {"p99_9_us", us(histogram.quantile_ns(0.999))},
          {"max_us", us(histogram.most_ns)},
          {"bins_us", bins}};
}

}  // namespace

std::string json_of_servo(const ServoAnswer& answer) {
  const cases::ServoRecord& record = answer.record;
  Json document = {{"holds", answer.holds()}};
  document.update(json_of_servo_record(record));
  document["most_missed_share"] = answer.most_missed_share;
  document["most_needle_n"] = answer.most_needle_n;
  document["most_probe_n"] = answer.most_probe_n;
  document["ruptures"] = answer.ruptures;
  return document.dump(2) + "\n";
}

Json json_of_servo_record(const cases::ServoRecord& record) {
  return {{"tick_us", 1e6 * record.tick_s},
          {"ticks", record.ticks},
          {"missed", record.missed},
          {"missed_share", record.missed_share()},
          {"scheduler", name_of(record.scheduler)},
          {"memory_locked", record.memory_locked},
          {"period", times(record.period)},
          {"latency", times(record.latency)},
          {"compute", times(record.compute)}};
}

}  // namespace seldinger::app
