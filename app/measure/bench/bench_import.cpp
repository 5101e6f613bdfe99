// bench --stage import: reading a CT, and its skin by decimation and smoothing.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/measure/bench/bench.h"
#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "sim/case/form/mesh_index.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {
namespace {

// Mean distance of the mesh's vertices to the full surface.
double mean_distance_mm(const cases::Mesh& mesh, const cases::MeshIndex& full) {
  double sum = 0.0;
  std::uint32_t hint = 0;
  for (const glm::vec3& vertex : mesh.vertices_lps_mm) {
    const cases::Closest near = full.closest(glm::dvec3(vertex), hint);
    hint = near.triangle;
    sum += std::abs(near.distance_mm);
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, mesh.vertices_lps_mm.size()));
}

}  // namespace

base::Result<void> bench_import(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  volume::Volume volume;
  if (arguments.has("--ct")) {
    std::optional<base::Error> refused;
    const auto read = [&](const char* where, const auto& reads) {
      BenchRow row{"import", "read", where, "cpu", "1 thread", "", 0, 0, 0, 0, "", "", ""};
      time_into(row, quick ? 1 : 3, [&] {
        auto source = reads(arguments.text("--ct"));
        if (source)
          volume = std::move(source->volume);
        else
          refused = source.error();
      });
      row.size = bench_size(volume);
      rows.push_back(row);
    };
    // The first also warms the file cache.
    read("file or folder, in this process",
         [](const std::string& source) { return casedb::read_source_here(source); });
    if (!refused)
      read("file or folder, in a jail", [](const std::string& source) { return casedb::read_source(source); });
    if (refused) return *refused;
  } else {
    volume = volume::make_phantom().volume;
  }
  casedb::SurfaceOptions full_options;
  full_options.decimate_share = 0.0;
  full_options.smoothing_iterations = 0;
  full_options.target_spacing_mm = 0.1;  // no shrinking
  const auto full = casedb::skin_surface(volume, full_options);
  if (!full) return full.error();
  const cases::MeshIndex index(*full);
  struct Choice {
    double share;
    int smoothing;
  };
  const int smoothing = casedb::SurfaceOptions{}.smoothing_iterations;
  for (const Choice& choice : {Choice{0.0, 0}, Choice{0.0, smoothing}, Choice{0.5, smoothing}, Choice{0.7, 0},
                               Choice{0.7, smoothing}, Choice{0.7, 2 * smoothing}, Choice{0.9, smoothing}}) {
    casedb::SurfaceOptions options;
    options.decimate_share = choice.share;
    options.smoothing_iterations = choice.smoothing;
    cases::Mesh mesh;
    BenchRow row{"surface",
                 "mask, iso-surface, decimate, smooth",
                 "decimate " + bench_number(choice.share) + ", smooth " + bench_number(choice.smoothing),
                 "cpu",
                 bench_cores(),
                 bench_size(volume),
                 0,
                 0,
                 0,
                 0,
                 "",
                 "mm mean distance",
                 "full-resolution iso-surface, not decimated"};
    time_into(row, quick ? 1 : 3, [&] { mesh = std::move(*casedb::skin_surface(volume, options)); });
    row.setting += ", " + std::to_string(mesh.triangles.size()) + " triangles";
    row.error = bench_number(mean_distance_mm(mesh, index));
    rows.push_back(row);
  }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::fprintf(stderr, "peak memory after import and surfaces: %.0f MB\n",
               static_cast<double>(usage.ru_maxrss) / 1024.0);
  return {};
}

}  // namespace seldinger::measure
