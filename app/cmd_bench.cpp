// bench: time against error, relative to a stated reference. Figures, not tests: machines here are noisy.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <thread>

#include "app/bench.h"
#include "app/command.h"
#include "app/file.h"
#include "app/import_case.h"
#include "app/simulated_attempt.h"
#include "assessment/operators/lesion_site.h"
#include "casedb/import/import.h"
#include "casedb/import/surface.h"
#include "reports/frontier_page.h"
#include "sim/base/failure.h"
#include "sim/base/rng.h"
#include "sim/engine/step.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/volume/phantom.h"

namespace seldinger::app {

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

namespace {

using Row = BenchRow;

std::string cores() {
  return std::to_string(std::thread::hardware_concurrency()) + " cores";
}

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

base::Result<void> bench_import(const Arguments& arguments, bool quick, std::vector<Row>& rows) {
  volume::Volume volume;
  if (arguments.has("--ct")) {
    Row read{"import", "read", "file or folder", "cpu", "1 thread", "", 0, 0, 0, 0, "", "", ""};
    std::optional<base::Error> refused;
    time_into(read, quick ? 1 : 3, [&] {
      auto source = casedb::read_source(arguments.text("--ct"));
      if (source)
        volume = std::move(source->volume);
      else
        refused = source.error();
    });
    if (refused) return *refused;
    read.size = bench_size(volume);
    rows.push_back(read);
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
    Row row{"surface",
            "mask, iso-surface, decimate, smooth",
            "decimate " + bench_number(choice.share) + ", smooth " + bench_number(choice.smoothing),
            "cpu",
            cores(),
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

void bench_mpr(bool quick, std::vector<Row>& rows) {
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
      Row row{"mpr",
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
    add("cpu", cores(), [&] { return imaging::mpr_cpu(volume, view, inserted); });
    if (on_gpu) add("gpu", context->renderer(), [&] { return on_gpu->render(view, inserted); });
  }
}

base::Result<void> bench_step(bool quick, std::vector<Row>& rows) {
  cases::Case scene;
  scene.volume = volume::make_phantom().volume;
  auto skin = casedb::skin_surface(scene.volume);
  if (!skin) return skin.error();
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  const auto site = assessment::find_lesion_site(scene.volume, scene.skin_index);
  if (!site) return site.error();
  scene.lesions.push_back(site->lesion);
  const auto profile = *assessment::named_profile("expert");
  cases::Recording recording;
  Row attempt{"attempt", "expert",   "simulated at 1 kHz with pictures' truth",
              "cpu",     "1 thread", bench_size(scene.volume),
              0,         0,          0,
              0,         "",         "",
              ""};
  time_into(attempt, quick ? 1 : 5, [&] { recording = run_attempt(scene, site->plan, profile, 1); });
  attempt.setting +=
      ", " + bench_number(static_cast<double>(recording.inputs.size()) * recording.dt_s) + " s of attempt";
  rows.push_back(attempt);
  Row row{"step",
          "skin index, no forces",
          "per tick, " + std::to_string(scene.skin.triangles.size()) + " triangles",
          "cpu",
          "1 thread",
          bench_size(scene.volume),
          0,
          0,
          0,
          0,
          "",
          "",
          ""};
  time_into(row, quick ? 3 : 11, [&] {
    cases::State state;
    for (const cases::Inputs& inputs : recording.inputs) engine::step(scene, inputs, recording.dt_s, state);
  });
  const auto ticks = static_cast<double>(recording.inputs.size());
  row.ms_median /= ticks;
  row.ms_min /= ticks;
  row.ms_max /= ticks;
  rows.push_back(row);
  return {};
}

std::string csv(const std::vector<Row>& rows) {
  std::string text =
      "stage,method,setting,backend,device,size,n,ms_median,ms_min,ms_max,error,error_unit,reference\n";
  const auto quoted = [](const std::string& cell) {
    return cell.find(',') == std::string::npos ? cell : '"' + cell + '"';
  };
  for (const Row& row : rows)
    text += row.stage + ',' + quoted(row.method) + ',' + quoted(row.setting) + ',' + row.backend + ',' +
            quoted(row.device) + ',' + row.size + ',' + std::to_string(row.n) + ',' + bench_number(row.ms_median) +
            ',' + bench_number(row.ms_min) + ',' + bench_number(row.ms_max) + ',' + row.error + ',' +
            quoted(row.error_unit) + ',' + quoted(row.reference) + '\n';
  return text;
}

// What a chart is of: rows with the same can be compared.
std::string scene_of(const Row& row) {
  if (row.stage == "xray") return row.setting.substr(0, row.setting.find(' '));
  if (row.stage == "ultrasound") return row.setting.substr(0, row.setting.find(' ', row.setting.find(' ') + 1));
  return row.size;
}

// Stages that chart one against the other: rows with an error, one chart for each scene, one thread and GL alone.
std::string frontier(const std::vector<Row>& rows) {
  std::vector<reports::FrontierPoint> points;
  for (const Row& row : rows) {
    if (row.error.empty() || row.device == "2 threads" || row.method == "fluoroscopy chain" ||
        row.method == "peak memory of a picture")
      continue;
    const std::string scene = scene_of(row);
    const std::string detail = row.setting.size() > scene.size() ? row.setting.substr(scene.size()) : "";
    const std::string where = row.backend == "gpu" ? " gpu" : "";
    points.push_back({row.stage + ", " + scene + ", " + row.error_unit, row.method, row.method + detail + where,
                      row.ms_median, std::strtod(row.error.c_str(), nullptr), row.error_unit, row.reference});
  }
  return reports::frontier_page("Time against error", points);
}

}  // namespace

int run_bench(const Arguments& arguments) {
  const std::filesystem::path out = arguments.required("--out");
  const bool quick = arguments.has("--quick");
  std::vector<std::string> stages;
  std::string list = arguments.text(
      "--stage", "import,mpr,xray,breathing,ultrasound,room,displacement,haptics,step,library,assessment");
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    stages.push_back(list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  for (const std::string& stage : stages)
    if (stage != "import" && stage != "mpr" && stage != "xray" && stage != "ultrasound" && stage != "haptics" &&
        stage != "step" && stage != "library" && stage != "assessment" && stage != "displacement" &&
        stage != "room" && stage != "breathing")
      throw UsageError(
          "--stage knows import, mpr, xray, breathing, ultrasound, room, displacement, haptics, step, library and "
          "assessment");
  std::vector<Row> rows;
  for (const std::string& stage : stages) {
    std::fprintf(stderr, "bench %s …\n", stage.c_str());
    base::Result<void> done;
    if (stage == "import") done = bench_import(arguments, quick, rows);
    if (stage == "mpr") bench_mpr(quick, rows);
    if (stage == "xray") done = bench_xray(arguments, quick, rows);
    if (stage == "breathing") done = bench_breathing(arguments, quick, rows);
    if (stage == "ultrasound") done = bench_ultrasound(arguments, quick, rows);
    if (stage == "room") done = bench_room(arguments, quick, rows);
    if (stage == "displacement") bench_displacement(quick, rows);
    if (stage == "haptics") {
      bench_haptics(quick, rows);
      done = bench_servo(quick, rows);
      bench_touch(quick, rows);
    }
    if (stage == "step") done = bench_step(quick, rows);
    if (stage == "library") done = bench_library(quick, rows);
    if (stage == "assessment") done = bench_assessment(quick, rows);
    if (!done) return refuse(done.error());
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw base::Failure("disk", "the output folder cannot be made");
  const std::string text = csv(rows);
  write_file(out / "results.csv", text);
  write_file(out / "frontier.html", frontier(rows));
  if (std::find(stages.begin(), stages.end(), "haptics") != stages.end())
    write_file(out / "force_depth.html", force_depth_page());
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace seldinger::app
