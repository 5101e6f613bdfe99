#include "casedb/attempts/stations.h"

#include <algorithm>

#include "casedb/attempts/attempt_columns.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostStationLetters = 40;
constexpr std::string_view kStationEnds = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

// The one of that name: rows come by station.
StationTiming& last_called(std::vector<StationTiming>& stations, const std::string& name) {
  if (stations.empty() || stations.back().station != name) stations.emplace_back().station = name;
  return stations.back();
}

void add_pictures(StationTiming& timing, const Statement& row) {
  if (!row.is_null("window_hz")) timing.window_hz.push_back(row.real("window_hz"));
  if (row.is_null("picture_method") || row.is_null("picture_hz")) return;
  const std::string method = row.text("picture_method");
  const bool simplified = !row.is_null("speckle_fallback") && row.real("speckle_fallback") != 0.0;
  const auto same = std::find_if(timing.pictures.begin(), timing.pictures.end(), [&](const auto& one) {
    return one.method == method && one.simplified == simplified;
  });
  auto& pictures = same != timing.pictures.end()
                       ? *same
                       : timing.pictures.emplace_back(StationTiming::Pictures{method, simplified, {}});
  pictures.shown_hz.push_back(row.real("picture_hz"));
}

}  // namespace

base::Result<void> check_station_name(const std::string& name) {
  const bool fits =
      !name.empty() && name.size() <= kMostStationLetters && kStationEnds.find(name.front()) != kStationEnds.npos &&
      kStationEnds.find(name.back()) != kStationEnds.npos && std::all_of(name.begin(), name.end(), [](char c) {
        return kStationEnds.find(c) != kStationEnds.npos ||
               std::string_view(" -_.").find(c) != std::string_view::npos;
      });
  if (fits) return {};
  return base::Error{
      "bad_station_name",
      "a station's name has 1 to 40 letters, digits, spaces and - _ . and begins and ends with a letter or digit"};
}

std::vector<StationUse> list_station_use(Library& library, const std::vector<std::string>& people) {
  Sqlite& database = library.database();
  const Snapshot one_state(database);
  const std::string ids = json_of_ids(people);
  std::vector<StationUse> stations;
  Statement sums = question(database, "station_use");
  for (sums.bind("people", ids); sums.step();) {
    StationUse& one = stations.emplace_back();
    one.station = sums.text("station");
    one.simulated = sums.integer("simulated") != 0;
    one.attempts = static_cast<std::size_t>(sums.integer("attempts"));
    one.people = static_cast<std::size_t>(sums.integer("people"));
    one.days = static_cast<std::size_t>(sums.integer("days"));
    one.duration_s = sums.real("duration_s");
    one.last_us = sums.integer("last_us");
  }
  Statement newest = question(database, "station_results");
  newest.bind("people", ids).bind("count", kStationResults);
  for (auto one = stations.begin(); newest.step();) {
    const bool simulated = newest.integer("simulated") != 0;
    while (one->station != newest.view("station") || one->simulated != simulated) ++one;  // both in the same order
    StationResult& result = one->results.emplace_back();
    result.duration_s = newest.real("duration_s");
    if (!newest.is_null("target_mm")) result.target_mm = newest.real("target_mm");
    if (!newest.is_null("hit")) result.hit = newest.real("hit") != 0.0;
  }
  return stations;
}

std::vector<StationTiming> list_station_timing(Library& library) {
  std::vector<StationTiming> stations;
  Statement rows = question(library.database(), "station_timing");
  for (rows.bind("count", kStationResults); rows.step();) {
    StationTiming& one = last_called(stations, rows.text("station"));
    const cases::ServoRecord servo = read_servo_record(rows);
    if (one.ticks + one.missed == 0)
      one.real_time = servo.scheduler == cases::ServoScheduler::fifo;  // newest first
    one.ticks += servo.ticks;
    one.missed += servo.missed;
    one.latency.add(servo.latency);
    one.compute.add(servo.compute);
    add_pictures(one, rows);
  }
  for (StationTiming& one : stations)
    std::sort(one.pictures.begin(), one.pictures.end(), [](const auto& a, const auto& b) {
      return std::pair(a.method, a.simplified) < std::pair(b.method, b.simplified);
    });
  return stations;
}

}  // namespace seldinger::casedb
