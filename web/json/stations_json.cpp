#include "web/json/stations_json.h"

#include "casedb/database/values_json.h"
#include "reports/pages/people/stations_page.h"

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_shares(const std::vector<reports::TimingShare>& shares) {
  Json list = Json::array();
  for (const reports::TimingShare& one : shares) list.push_back({{"class", one.label}, {"share", one.share}});
  return list;
}

double us_of(std::uint64_t ns) {
  return static_cast<double>(ns) / 1000.0;
}

}  // namespace

std::string stations_json(std::span<const casedb::StationUse> stations) {
  Json list = Json::array();
  for (const casedb::StationUse& one : stations) {
    Json results = Json::array();
    for (const casedb::StationResult& result : one.results)
      results.push_back({{"duration_s", result.duration_s},
                         {"target_mm", result.target_mm ? Json(*result.target_mm) : Json(nullptr)},
                         {"hit", result.hit ? Json(*result.hit) : Json(nullptr)}});
    list.push_back({{"station", casedb::maybe(one.station)},
                    {"simulated", one.simulated},
                    {"attempts", one.attempts},
                    {"people", one.people},
                    {"days", one.days},
                    {"duration_s", one.duration_s},
                    {"last_us", one.last_us},
                    {"newest", results}});
  }
  return casedb::line({{"stations", list}});
}

std::string station_timing_json(std::span<const casedb::StationTiming> stations) {
  Json list = Json::array();
  for (const casedb::StationTiming& one : stations) {
    const double due = static_cast<double>(one.ticks + one.missed);
    Json pictures = Json::array();
    for (const casedb::StationTiming::Pictures& made : one.pictures)
      pictures.push_back({{"method", made.method},
                          {"simplified", made.simplified},
                          {"shown_median_hz", reports::middle_of(made.shown_hz)}});
    list.push_back(
        {{"station", casedb::maybe(one.station)},
         {"missed_share", due > 0.0 ? static_cast<double>(one.missed) / due : 0.0},
         {"real_time", one.real_time},
         {"late_us",
          {{"p50", us_of(one.latency.quantile_ns(0.5))},
           {"p99", us_of(one.latency.quantile_ns(0.99))},
           {"longest", us_of(one.latency.most_ns)}}},
         {"work_us", {{"p50", us_of(one.compute.quantile_ns(0.5))}, {"p99", us_of(one.compute.quantile_ns(0.99))}}},
         {"late_shares", json_of_shares(reports::lateness_shares(one.latency))},
         {"frame_shares",
          one.window_hz.empty() ? Json(nullptr) : json_of_shares(reports::frame_shares(one.window_hz))},
         {"pictures", pictures}});
  }
  return casedb::line({{"stations", list}});
}

}  // namespace seldinger::web
