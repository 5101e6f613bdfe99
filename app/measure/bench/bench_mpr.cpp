// bench --stage mpr: a slice by interpolation and backend.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "app/measure/bench/bench.h"
#include "sim/base/failure.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {
namespace {

struct Difference {
  double mean = 0.0, max = 0.0;
};

Difference difference(const imaging::HuImage& a, const imaging::HuImage& b) {
  Difference result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    result.mean += d / static_cast<double>(a.size());
    result.max = std::max(result.max, d);
  }
  return result;
}

}  // namespace

base::Result<void> bench_mpr(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  const volume::Volume volume = volume::make_phantom().volume;
  imaging::MprView view;
  const glm::dvec3 middle = glm::dvec3(volume.size_voxels - 1) * 0.5;
  view.center_lps_mm = glm::dvec3(volume.lps_from_voxel * glm::dvec4(middle, 1.0));
  view.u = {0.8, 0.6, 0.0};
  view.v = {-0.36, 0.48, 0.8};
  view.pixel_mm = 0.5;
  view.width_px = view.height_px = 512;
  imaging::Inserted inserted;
  inserted.needle = imaging::NeedlePose{view.center_lps_mm, view.u};
  inserted.lesions.push_back({view.center_lps_mm, 6.0, 20.0});
  const imaging::HuImage exact = imaging::mpr_reference(volume, view, inserted);
  std::optional<gpu::Context> context;
  std::optional<imaging::MprGpu> on_gpu;
  try {
    context.emplace();
    on_gpu.emplace(*context, volume);
  } catch (const base::Failure& failure) {
    std::fprintf(stderr, "no GL here: %s\n", failure.what());
  }
  for (const bool linear : {false, true}) {
    view.interpolation = linear ? imaging::Interpolation::linear : imaging::Interpolation::nearest;
    const auto add = [&](const char* backend, const std::string& device,
                         const std::function<imaging::HuImage()>& make) {
      imaging::HuImage picture = make();  // warm
      BenchRow row{"mpr",
                   linear ? "linear" : "nearest",
                   "512x512",
                   backend,
                   device,
                   bench_size(volume),
                   0,
                   0,
                   0,
                   0,
                   "",
                   "HU mean abs",
                   "linear, double, plain"};
      time_into(row, quick ? 5 : 41, [&] { picture = make(); });
      row.error = bench_number(difference(picture, exact).mean);
      rows.push_back(row);
    };
    add("reference", "1 thread", [&] { return imaging::mpr_reference(volume, view, inserted); });
    add("cpu", bench_cores(), [&] { return imaging::mpr_cpu(volume, view, inserted); });
    if (on_gpu) add("gpu", context->renderer(), [&] { return on_gpu->render(view, inserted); });
  }
  return {};
}

}  // namespace seldinger::measure
