// Work that falls into rows (of a picture, blocks of beams, slices of a volume), shared out among threads. Which
// thread takes a row, and how many threads there are, must say nothing about what the row becomes.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace seldinger::base {

// Calls work(row, scratch) for 0 ≤ row < count on up to `threads` threads, this one among them; 0 or fewer: as many
// as the machine has. Each thread makes its own scratch with make_scratch(). Returns when all rows are done.
template <typename MakeScratch, typename Work>
void over_rows(int count, int threads, const MakeScratch& make_scratch, const Work& work) {
  const int wanted = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  std::atomic<int> next{0};
  const auto run = [&] {
    auto scratch = make_scratch();
    for (int row = next.fetch_add(1); row < count; row = next.fetch_add(1)) work(row, scratch);
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < std::min(wanted, count); ++i) others.emplace_back(run);
  run();
}

// The same without scratch: calls work(row).
template <typename Work>
void over_rows(int count, int threads, const Work& work) {
  over_rows(
      count, threads, [] { return 0; }, [&](int row, int) { work(row); });
}

}  // namespace seldinger::base
