#include "app/hands/station.h"

#include <cstdlib>

#include "app/cli/file.h"
#include "casedb/database/disk.h"

namespace seldinger::app {

base::Result<Station> change_station(const std::filesystem::path& file,
                                     const std::function<void(Station&)>& change) {
  const auto folder = std::filesystem::absolute(file).parent_path();
  // Only where nobody named it: a folder that was mistyped is not made.
  if (file == usual_station_file())
    casedb::without_paths([&] { return std::filesystem::create_directories(folder); });
  const casedb::FolderLock lock(folder);
  Station station;
  if (std::filesystem::exists(file)) {
    auto known = read_station(file);
    if (!known) return known.error();
    station = std::move(*known);
  }
  change(station);
  write_file(file, json_of_station(station));
  return station;
}

std::filesystem::path usual_station_file() {
  const auto below = [](const std::filesystem::path& folder) { return folder / "seldinger" / "station.json"; };
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config == '/')
    return below(config);
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? below(std::filesystem::path(home) / ".config") : std::filesystem::path();
}

}  // namespace seldinger::app
