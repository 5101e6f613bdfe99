// bench --stage breathing: what a breathing patient adds to a fluoroscope's pulse, and how far it is from the
// truth.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "app/measure/bench/bench.h"
#include "casedb/import/import.h"
#include "sim/imaging/xray/projection/moved_volume.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {
namespace {

constexpr int kCompareEvery = 8;  // errors are told from every 8th pixel of every 8th row

// A field of 300 mm on the panel, through the volume's middle, from back to front or from right to left.
imaging::XrayGeometry fluoroscope(const volume::Volume& volume, bool lateral) {
  const glm::dvec3 middle(volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(volume.size_voxels - 1), 1.0));
  const glm::dvec3 along = lateral ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, -1.0, 0.0);
  imaging::XrayGeometry g;
  g.source_lps_mm = middle - 785.0 * along;
  g.detector_center_lps_mm = middle + 315.0 * along;
  g.v = {0.0, 0.0, -1.0};
  g.u = glm::cross(g.v, along);
  g.width_px = g.height_px = 512;
  g.pixel_mm = 300.0 / 512.0;
  return g;
}

// A deep breath whose dome is at the volume's middle: nothing in it moves more.
tissue::Displacement breathed_in(const volume::Volume& volume, double level) {
  const glm::dvec3 middle(volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(volume.size_voxels - 1), 1.0));
  tissue::Causes causes;
  tissue::Breath breath;
  breath.region.middle_x_mm = middle.x;
  breath.region.back_y_mm = middle.y + 0.5 * breath.region.depth_mm;
  breath.region.dome_z_mm = middle.z;
  breath.amount_mm = level * glm::dvec3(2.0, 15.0, 16.0);
  causes.breath = breath;
  return tissue::displacement_of(causes);
}

}  // namespace

base::Result<void> bench_breathing(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  // The patient.
  volume::Volume volume;
  if (arguments.has("--ct")) {
    auto source = casedb::read_source(arguments.text("--ct"));
    if (!source) return source.error();
    volume = std::move(source->volume);
  } else {
    volume = volume::make_phantom().volume;
  }
  // From the front and from the side.
  const int n = quick ? 5 : 15;
  const imaging::XrayCpu still(volume);
  for (const bool lateral : {false, true}) {
    const imaging::XrayGeometry geometry = fluoroscope(volume, lateral);
    const tissue::Displacement breath = breathed_in(volume, 1.0), other = breathed_in(volume, 0.98);
    // The truth on some of the pixels: the lines through displaced tissue, walked finely.
    std::vector<double> reference_mm;
    double highest_mm = 0.0;
    for (int row = kCompareEvery / 2; row < geometry.height_px; row += kCompareEvery)
      for (int column = kCompareEvery / 2; column < geometry.width_px; column += kCompareEvery) {
        const imaging::RaySegment ray = imaging::ray_of(geometry, volume, column, row);
        // Where there can be something: the volume is within 400 mm of its middle.
        const glm::dvec3 along = glm::normalize(ray.to_lps_mm - ray.from_lps_mm);
        reference_mm.push_back(
            imaging::displaced_lengths_between(volume, breath, ray.from_lps_mm + 385.0 * along, ray.to_lps_mm)
                .total_mm());
        highest_mm = std::max(highest_mm, reference_mm.back());
      }
    // A row: the time, and where there are lengths, how far they are from the truth.
    const auto add = [&](const std::string& what, const imaging::PathLengths* lengths, const auto& work) {
      BenchRow row{"xray",
                   what,
                   lateral ? "lateral" : "AP",
                   "cpu",
                   "1 thread",
                   bench_size(volume),
                   0,
                   0,
                   0,
                   0,
                   "",
                   "mean of range; 95 %",
                   "every 0.25 mm at rest"};
      time_into(row, n, work);
      if (lengths != nullptr) {
        // As shares of the longest line.
        std::vector<double> errors;
        std::size_t i = 0;
        double sum = 0.0;
        for (int r = kCompareEvery / 2; r < geometry.height_px; r += kCompareEvery)
          for (int c = kCompareEvery / 2; c < geometry.width_px; c += kCompareEvery, ++i) {
            const auto pixel = static_cast<std::size_t>(r) * static_cast<std::size_t>(geometry.width_px) +
                               static_cast<std::size_t>(c);
            const double got =
                static_cast<double>(lengths->water_mm[pixel]) + static_cast<double>(lengths->mineral_mm[pixel]);
            errors.push_back(std::abs(got - reference_mm[i]) / highest_mm);
            sum += errors.back();
          }
        std::sort(errors.begin(), errors.end());
        row.error = bench_number(sum / static_cast<double>(errors.size())) + "; " +
                    bench_number(errors[errors.size() * 95 / 100]);
      }
      rows.push_back(row);
    };
    // A patient who is held still, and one who moves, by the fineness of what is moved.
    const imaging::CpuOptions options{.threads = 1};
    imaging::PathLengths lengths;
    lengths = still.project(geometry, imaging::ProjectionMethod::exact, options);
    add("still", &lengths, [&] { lengths = still.project(geometry, imaging::ProjectionMethod::exact, options); });
    for (const double voxel_mm : {1.0, 2.0, 3.0})
      for (const double node_mm : {8.0, 12.0, 24.0}) {
        const std::string grid =
            std::string(" ") + bench_number(voxel_mm) + " mm, nodes " + bench_number(node_mm) + " mm";
        imaging::MovedVolume moved(volume, {voxel_mm, node_mm});
        // Every pulse sees another breath than the one before.
        bool in = false;
        add("moved, volume" + grid, nullptr, [&] {
          moved.move(in ? breath : other, geometry);
          in = !in;
        });
        moved.move(breath, geometry);
        lengths = moved.projector().project(geometry, imaging::ProjectionMethod::exact, options);
        add("moved, projection" + grid, &lengths,
            [&] { lengths = moved.projector().project(geometry, imaging::ProjectionMethod::exact, options); });
      }
  }
  return {};
}

}  // namespace seldinger::measure
