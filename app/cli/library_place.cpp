#include "app/cli/library_place.h"

#include <cstdlib>
#include <string>

#include "app/cli/words.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

std::string told_by_environment() {
  const char* told = std::getenv(kLibraryVariable);
  return told == nullptr ? "" : told;
}

std::filesystem::path demo_folder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/')
    return std::filesystem::path(data) / "seldinger" / "demo";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/')
    throw base::Failure("disk", std::string("there is no home folder; give --library or set ") + kLibraryVariable);
  return std::filesystem::path(home) / ".local" / "share" / "seldinger" / "demo";
}

}  // namespace

std::filesystem::path library_folder(const Arguments& arguments) {
  if (arguments.has("--library")) {
    const std::string given = arguments.text("--library");
    if (given.empty()) throw UsageError("--library is empty");
    return given;
  }
  const std::string told = told_by_environment();
  return told.empty() ? demo_folder() : std::filesystem::path(told);
}

std::filesystem::path library_folder_if_any(const Arguments& arguments) {
  try {
    return library_folder(arguments);
  } catch (const base::Failure&) {
    return {};
  }
}

base::Error error_of_library(const Arguments& arguments, base::Error error) {
  if (arguments.has("--library")) return error_of("--library", arguments.text("--library"), std::move(error));
  const std::string told = told_by_environment();
  if (!told.empty()) return error_of(kLibraryVariable, told, std::move(error));
  return error_of("the demo's library, as no --library is given,", demo_folder().string(), std::move(error));
}

}  // namespace seldinger::app
