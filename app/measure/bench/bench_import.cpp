// bench --stage import: reading a CT, and its skin by decimation and smoothing.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

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

// Of this process and of the jails that it has waited for.
double processor_s() {
  double sum_s = 0.0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(whose, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
      sum_s += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
  }
  return sum_s;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// What a jail costs: read with and without it in turns, so that what else the machine does falls on both.
base::Result<void> bench_jail(const std::string& source, int rounds, volume::Volume& volume,
                              std::vector<BenchRow>& rows) {
  struct Way {
    const char* name;
    base::Result<casedb::Source> (*read)(const std::string& source);
    std::vector<double> wall_ms{}, processor{};
  };
  Way ways[] = {{"in this process", [](const std::string& where) { return casedb::read_source_here(where); }},
                {"in a jail", [](const std::string& where) { return casedb::read_source(where); }}};
  std::vector<double> of_wall, of_processor;       // in a jail over in this process, round by round
  for (int round = -1; round < rounds; ++round) {  // the first warms the file cache
    for (int turn = 0; turn < 2; ++turn) {
      Way& way = ways[(round + 1 + turn) % 2];
      BenchRow once;
      const double before_s = processor_s();
      std::optional<base::Error> refused;
      time_into(once, 1, [&] {
        auto read = way.read(source);
        if (read)
          volume = std::move(read->volume);
        else
          refused = read.error();
      });
      if (refused) return *refused;
      if (round < 0) continue;
      way.wall_ms.push_back(once.ms_median);
      way.processor.push_back(processor_s() - before_s);
    }
    if (round < 0) continue;
    of_wall.push_back(ways[1].wall_ms.back() / ways[0].wall_ms.back());
    of_processor.push_back(ways[1].processor.back() / ways[0].processor.back());
  }
  for (const Way& way : ways) {
    BenchRow row{"import",
                 "read",
                 std::string("file or folder, ") + way.name,
                 "cpu",
                 "1 thread",
                 bench_size(volume),
                 rounds,
                 median(way.wall_ms),
                 std::ranges::min(way.wall_ms),
                 std::ranges::max(way.wall_ms),
                 "",
                 "",
                 ""};
    row.setting += ", " + bench_number(median(way.processor)) + " s of the processor";
    if (&way == &ways[1])
      row.setting += ", " + bench_number(median(of_wall)) + " of the time and " +
                     bench_number(median(of_processor)) +
                     " of the processor's time in this process (medians of ratios in turns)";
    rows.push_back(row);
  }
  return {};
}

}  // namespace

base::Result<void> bench_import(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  volume::Volume volume;
  if (arguments.has("--ct")) {
    const auto read = bench_jail(arguments.text("--ct"), quick ? 3 : 11, volume, rows);
    if (!read) return read.error();
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
