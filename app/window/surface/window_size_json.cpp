#include "app/window/surface/window_size_json.h"

#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/file.h"
#include "app/cli/state_folder.h"
#include "app/window/surface/window.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::json;

constexpr int kMostPixels = 16384;
constexpr std::size_t kMostBytes = 4096;

std::optional<int> pixels(const Json& size, const char* name, int least) {
  const auto found = size.find(name);
  if (found == size.end() || !found->is_number_integer()) return std::nullopt;
  const double value = found->get<double>();
  if (!(value >= least && value <= kMostPixels)) return std::nullopt;
  return static_cast<int>(value);
}

}  // namespace

std::filesystem::path window_size_file() {
  return state_folder() / "window.json";
}

std::optional<WindowSize> read_window_size(const std::filesystem::path& file) {
  const auto text = read_text(file, kMostBytes);
  if (!text) return std::nullopt;
  const Json size = Json::parse(*text, nullptr, false);
  if (!size.is_object()) return std::nullopt;
  const auto width = pixels(size, "width", kLeastWidth), height = pixels(size, "height", kLeastHeight);
  const auto whole = size.find("whole_screen");
  if (!width || !height || whole == size.end() || !whole->is_boolean()) return std::nullopt;
  return WindowSize{*width, *height, whole->get<bool>()};
}

bool keep_window_size(const std::filesystem::path& file, const WindowSize& size) {
  if (read_window_size(file) == size) return true;
  try {
    std::filesystem::create_directories(file.parent_path());
    write_file(
        file,
        Json{{"width", size.width}, {"height", size.height}, {"whole_screen", size.whole_screen}}.dump(2) + "\n");
    return true;
  } catch (const base::Failure&) {
    return false;
  } catch (const std::filesystem::filesystem_error&) {
    return false;
  }
}

}  // namespace seldinger::app
