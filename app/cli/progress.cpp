#include "app/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace seldinger::app {
namespace {

// No more exact than a guess is: seconds by 5 from 10 on, minutes from 90 s on.
std::string about(double seconds) {
  if (seconds >= 90.0) return std::to_string(std::lround(seconds / 60.0)) + " min";
  const long whole = seconds >= 10.0 ? 5 * std::lround(seconds / 5.0) : std::max(1L, std::lround(seconds));
  return std::to_string(whole) + " s";
}

}  // namespace

bool is_watched() {
  return ::isatty(STDERR_FILENO) != 0 || std::getenv(kWatchedVariable) != nullptr;
}

std::string progress_text(std::size_t done, std::size_t all, double elapsed_s) {
  std::string text = std::to_string(done) + " of " + std::to_string(all);
  if (done == 0 || done >= all) return text;
  return text + ", about " + about(elapsed_s * static_cast<double>(all - done) / static_cast<double>(done));
}

Progress::Progress(std::size_t all) : all_(all), seen_(all > 1 && is_watched()) {
  show();
}

Progress::~Progress() {
  clear();
}

void Progress::one_done() {
  ++done_;
  show();
}

void Progress::clear() {
  if (seen_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show() const {
  if (!seen_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  std::fprintf(stderr, "\r\x1b[K%s", progress_text(done_, all_, elapsed.count()).c_str());
}

}  // namespace seldinger::app
