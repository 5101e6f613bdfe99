// How far a long command is, for whoever watches a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace seldinger::app {

// Set in the environment of a program whose standard error somebody shows, though it is no terminal.
inline constexpr const char* kWatchedVariable = "SELDINGER_WATCHED";
// Whether somebody sees it.
bool is_watched();

// "3 of 11, about 40 s": what is left, at the pace so far. Without the time until something is done, and at the
// end.
std::string progress_text(std::size_t done, std::size_t all, double elapsed_s);

// One line on standard error that is written over, and is gone at the end; nothing where nobody watches, or where
// there is only one thing to do.
class Progress {
 public:
  explicit Progress(std::size_t all);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void one_done();
  void clear();  // for something else to be written

 private:
  void show() const;

  std::size_t all_, done_ = 0;
  bool seen_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace seldinger::app
