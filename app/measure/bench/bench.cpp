#include "app/measure/bench/bench.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

namespace seldinger::measure {

std::string bench_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void time_into(BenchRow& row, int n, const std::function<void()>& work) {
  std::vector<double> ms;
  for (int i = 0; i < n; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(ms.begin(), ms.end());
  row.n = n;
  row.ms_median = ms[ms.size() / 2];
  row.ms_min = ms.front();
  row.ms_max = ms.back();
}

std::string bench_size(const volume::Volume& volume) {
  return std::to_string(volume.size_voxels.x) + "x" + std::to_string(volume.size_voxels.y) + "x" +
         std::to_string(volume.size_voxels.z);
}

std::string bench_cores() {
  return std::to_string(std::thread::hardware_concurrency()) + " cores";
}

}  // namespace seldinger::measure
