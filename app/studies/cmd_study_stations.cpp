// study stations.
#include <cstdio>
#include <set>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "assessment/study/stations.h"
#include "reports/export/csv_line.h"

namespace seldinger::app {
namespace {

constexpr long long kMostStations = 12, kMostPeople = 1'000, kMostSeed = 1'000'000'000;

// "person,turn_1,turn_2 …", a line for each.
std::string timetable_csv(const std::vector<std::string>& stations,
                          const std::vector<std::vector<std::size_t>>& orders) {
  reports::CsvLine line;
  line.text("person");
  for (std::size_t turn = 1; turn <= stations.size(); ++turn) line.text("turn_" + std::to_string(turn));
  std::string csv = line.take();
  for (std::size_t i = 0; i < orders.size(); ++i) {
    line.whole(static_cast<std::int64_t>(i + 1));
    for (const std::size_t station : orders[i]) line.text(stations[station]);
    csv += line.take();
  }
  return csv;
}

int run_study_stations(const Arguments& arguments) {
  const std::vector<std::string> stations = arguments.all("--station");
  const std::set<std::string> different(stations.begin(), stations.end());
  if (stations.size() < 2 || static_cast<long long>(stations.size()) > kMostStations ||
      different.size() != stations.size() || different.contains(""))
    throw UsageError("give --station two to " + std::to_string(kMostStations) +
                     " times, each with a different name");
  const auto people = static_cast<std::size_t>(arguments.whole("--people", 0, 1, kMostPeople));
  if (people == 0) throw UsageError("--people is missing");
  const auto seed = static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, kMostSeed));
  const std::string csv =
      timetable_csv(stations, assessment::study::orders_of_stations(stations.size(), people, seed));
  if (arguments.has("--out"))
    write_file(file_of("--out", arguments.text("--out"), {".csv"}), csv);
  else
    std::fputs(csv.c_str(), stdout);
  return kDone;
}

constexpr Option kStationOptions[] = {
    {"--station", "NAME", "a station, by its case or task; two to twelve", true},
    {"--people", "N", "how many people; once the table is drawn, you say who is person 1"},
    {"--seed", "N", "draws rows and stations; default 1"},
    {"--out", "FILE.csv", "the file; else it is printed"}};

}  // namespace

Command study_stations_command() {
  return {.name = "study stations",
          .options = kStationOptions,
          .summary =
              "Draws who is at which station when, for a day on which everybody goes through all of them: "
              "Williams' Latin squares, in which each station follows each other one equally often.",
          .run = &run_study_stations};
}

}  // namespace seldinger::app
