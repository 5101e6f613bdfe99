#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <thread>

#include "app/measure/bench/bench.h"
#include "app/measure/rigs/projector_phantom.h"
#include "casedb/import/import.h"
#include "sim/base/failure.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/picture.h"
#include "sim/imaging/xray/projection/coarse.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::measure {
namespace {

using imaging::Basis;
using imaging::Instructions;
using imaging::PathLengths;
using imaging::ProjectionMethod;
using imaging::XrayGeometry;

constexpr int kCompareEvery = 8;  // errors are told from every 8th pixel of every 8th row

struct Scenery {
  std::string name;
  const volume::Volume* volume;
  XrayGeometry geometry;
};

// tests/bench/README.md, "The geometry": SAD 1000 mm, SID 1500 mm, 7 rad about z.
XrayGeometry peer_geometry(double width_mm, int width_px, int height_px) {
  const glm::dvec3 toward_source(std::cos(7.0), -std::sin(7.0), 0.0);
  XrayGeometry g;
  g.source_lps_mm = 1000.0 * toward_source;
  g.detector_center_lps_mm = -500.0 * toward_source;
  g.u = {std::sin(7.0), std::cos(7.0), 0.0};
  g.v = {0.0, 0.0, -1.0};
  g.pixel_mm = width_mm / width_px;
  g.width_px = width_px;
  g.height_px = height_px;
  return g;
}

// From the back to the front of the patient, the picture as wide as the volume is at its middle.
XrayGeometry anterior_posterior(const volume::Volume& volume) {
  const glm::dvec3 middle(volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(volume.size_voxels - 1), 1.0));
  XrayGeometry g;
  g.source_lps_mm = middle + glm::dvec3(0.0, 785.0, 0.0);
  g.detector_center_lps_mm = middle - glm::dvec3(0.0, 315.0, 0.0);
  g.u = {1.0, 0.0, 0.0};
  g.v = {0.0, 0.0, -1.0};
  g.width_px = g.height_px = 512;
  g.pixel_mm = volume.size_voxels.x * volume.spacing_mm.x * (1100.0 / 785.0) / 512.0;
  return g;
}

std::vector<double> reference_lengths(const Scenery& scenery, ProjectionMethod method) {
  std::vector<double> lengths_mm;
  for (int row = kCompareEvery / 2; row < scenery.geometry.height_px; row += kCompareEvery)
    for (int column = kCompareEvery / 2; column < scenery.geometry.width_px; column += kCompareEvery) {
      const imaging::RaySegment ray = imaging::ray_of(scenery.geometry, *scenery.volume, column, row);
      lengths_mm.push_back(
          imaging::lengths_between(*scenery.volume, ray.from_lps_mm, ray.to_lps_mm, method).total_mm());
    }
  return lengths_mm;
}

// Of the sampled rays that meet the volume: how many of all pixels, and voxels crossed by one in the mean.
std::string rays_and_voxels(const Scenery& scenery) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(*scenery.volume);
  double hit = 0.0, all = 0.0, voxels = 0.0;
  for (int row = kCompareEvery / 2; row < scenery.geometry.height_px; row += kCompareEvery)
    for (int column = kCompareEvery / 2; column < scenery.geometry.width_px; column += kCompareEvery) {
      const imaging::RaySegment ray = imaging::ray_of(scenery.geometry, *scenery.volume, column, row);
      const glm::dvec3 from = glm::dvec3(voxel_from_lps * glm::dvec4(ray.from_lps_mm, 1.0)) + 0.5;
      const glm::dvec3 along = glm::dmat3(voxel_from_lps) * (ray.to_lps_mm - ray.from_lps_mm);
      double enter = 0.0, leave = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double one = -from[axis] / along[axis],
                     other = (scenery.volume->size_voxels[axis] - from[axis]) / along[axis];
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
      }
      all += 1.0;
      if (!(leave > enter)) continue;
      hit += 1.0;
      const glm::dvec3 crossed = glm::abs(along) * (leave - enter);
      voxels += 1.0 + crossed.x + crossed.y + crossed.z;
    }
  const double pixels = static_cast<double>(scenery.geometry.width_px) * scenery.geometry.height_px;
  return bench_number(std::round(hit / all * pixels)) + " rays hit, " + bench_number(std::round(voxels / hit)) +
         " voxels a ray";
}

// Mean relative error where the line integral at 80 keV is above 0.05 nepers (2.7 mm of water).
double mean_relative(const PathLengths& lengths, const std::vector<double>& reference_mm) {
  double sum = 0.0;
  std::size_t i = 0, count = 0;
  for (int row = kCompareEvery / 2; row < lengths.height_px; row += kCompareEvery)
    for (int column = kCompareEvery / 2; column < lengths.width_px; column += kCompareEvery, ++i) {
      if (reference_mm[i] < 2.7) continue;
      const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(lengths.width_px) +
                                static_cast<std::size_t>(column);
      const double got = static_cast<double>(lengths.water_mm[pixel]) +
                         (lengths.mineral_mm.empty() ? 0.0 : static_cast<double>(lengths.mineral_mm[pixel]));
      sum += std::abs(got - reference_mm[i]) / reference_mm[i];
      ++count;
    }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

const char* name_of(ProjectionMethod method) {
  return method == ProjectionMethod::exact ? "exact" : method == ProjectionMethod::slab ? "slab" : "trilinear";
}

const char* name_of(Instructions instructions) {
  return instructions == Instructions::avx512 ? "avx512" : instructions == Instructions::avx2 ? "avx2" : "scalar";
}

std::string threads_text(int threads) {
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

class XrayStage {
 public:
  XrayStage(bool quick, std::vector<BenchRow>& rows) : quick_(quick), n_(quick ? 5 : 15), rows_(rows) {
    for (const Instructions one : {Instructions::avx512, Instructions::avx2, Instructions::scalar})
      if (one <= imaging::best_instructions()) instructions_.push_back(one);
    threads_ = {1};
    if (std::thread::hardware_concurrency() > 1) threads_.push_back(2);
    try {
      context_.emplace();
    } catch (const base::Failure& failure) {
      std::fprintf(stderr, "no GL here: %s\n", failure.what());
    }
  }

  void run(const Scenery& scenery) {
    std::fprintf(stderr, "%s: %s\n", scenery.name.c_str(), rays_and_voxels(scenery).c_str());
    const imaging::XrayCpu cpu(*scenery.volume);
    for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab}) {
      const bool exact = method == ProjectionMethod::exact;
      reference_ = reference_lengths(scenery, exact ? ProjectionMethod::exact : ProjectionMethod::trilinear);
      reference_name_ = exact ? "exact, double, plain" : "trilinear, double, plain";
      for (const Instructions instructions : instructions_)
        for (const int threads : threads_) {
          const imaging::CpuOptions options{Basis::total, instructions, threads};
          add(scenery, name_of(method), name_of(instructions), "cpu", threads_text(threads), n_,
              [&] { return cpu.project(scenery.geometry, method, options); });
        }
      for (const int by : {2, 4}) {
        const XrayGeometry small = imaging::coarser(scenery.geometry, by);
        add(
            scenery, name_of(method), std::string(name_of(instructions_[0])) + " 1/" + std::to_string(by), "cpu",
            threads_text(1), n_,
            [&] {
              return cpu.project(small, method, {Basis::total, instructions_[0], 1});
            },
            [&](const PathLengths& lengths) { return imaging::enlarged(lengths, by); });
      }
      if (!quick_) {
        add(scenery, name_of(method), "plain", "reference", threads_text(1), 1,
            [&] { return imaging::xray_reference(*scenery.volume, scenery.geometry, method); });
        if (!exact)
          add(scenery, "trilinear", "plain", "cpu", threads_text(2), 1, [&] {
            return cpu.project(scenery.geometry, ProjectionMethod::trilinear,
                               {Basis::total, Instructions::scalar, 2});
          });
      }
      if (context_) {
        imaging::XrayGpu gpu(*context_, *scenery.volume);
        add(scenery, name_of(method), "", "gpu", context_->renderer(), n_,
            [&] { return gpu.project(scenery.geometry, method, Basis::total); });
        if (!context_->software()) {
          BenchRow row = rows_.back();
          std::vector<double> ms;
          for (int i = 0; i < 100; ++i) {
            (void)gpu.project(scenery.geometry, method, Basis::total);
            ms.push_back(gpu.last_gpu_ms());
          }
          std::sort(ms.begin(), ms.end());
          row.setting += " gpu timer, " + rays_and_voxels(scenery);
          row.n = 100;
          row.ms_median = ms[50];
          row.ms_min = ms.front();
          row.ms_max = ms.back();
          rows_.push_back(row);
        }
      }
    }
    chain(scenery, cpu);
  }

 private:
  void add(
      const Scenery& scenery, const std::string& method, const std::string& quality, const char* backend,
      const std::string& device, int n, const std::function<PathLengths()>& project,
      const std::function<PathLengths(const PathLengths&)>& finish = [](const PathLengths& p) { return p; }) {
    PathLengths lengths;
    if (n > 1) lengths = project();  // warm
    BenchRow row{"xray",
                 method,
                 scenery.name + (quality.empty() ? "" : " " + quality),
                 backend,
                 device,
                 bench_size(*scenery.volume),
                 0,
                 0,
                 0,
                 0,
                 "",
                 "mean relative",
                 reference_name_};
    time_into(row, n, [&] { lengths = project(); });
    row.error = bench_number(mean_relative(finish(lengths), reference_));
    rows_.push_back(row);
  }

  // Projector with both lengths, needle and lesion, spectrum, noise, blur and window, beside the projector alone:
  // in turns, so that both see the same machine.
  void chain(const Scenery& scenery, const imaging::XrayCpu& cpu) {
    cases::Fluoroscope machine;
    imaging::Beams beams(machine);
    const imaging::Pulse pulse;
    const imaging::BeamSignal& beam = beams.at(pulse.technique.kv);
    imaging::FluoroscopyPicture picture;
    // An 18-gauge needle with its tip in a lesion at the volume's middle.
    const volume::Volume& patient = *scenery.volume;
    const glm::dvec3 middle(patient.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(patient.size_voxels - 1), 1.0));
    imaging::Inserted inserted;
    inserted.needle =
        imaging::NeedlePose{middle, glm::normalize(glm::dvec3(0.6, 0.5, -0.62)), 150.0, 0.635, 0.42, 3000.0};
    inserted.lesions.push_back({middle, 6.0, 300.0});
    for (const Instructions instructions : instructions_)
      for (const int threads : threads_) {
        imaging::PictureSettings settings;
        settings.threads = threads;
        std::vector<double> share;
        BenchRow row{"xray",
                     "fluoroscopy chain",
                     scenery.name + " " + name_of(instructions),
                     "cpu",
                     threads_text(threads),
                     bench_size(*scenery.volume),
                     0,
                     0,
                     0,
                     0,
                     "",
                     "times the exact projector",
                     "exact, total, same run"};
        std::vector<double> ms;
        for (int i = 0; i < 2 * n_ + 1; ++i) {
          BenchRow alone, whole;
          time_into(alone, 1, [&] {
            (void)cpu.project(scenery.geometry, ProjectionMethod::exact, {Basis::total, instructions, threads});
          });
          time_into(whole, 1, [&] {
            PathLengths lengths = cpu.project(scenery.geometry, ProjectionMethod::exact,
                                              {Basis::water_and_mineral, instructions, threads});
            imaging::overlay_instruments(patient, scenery.geometry, inserted, ProjectionMethod::exact, lengths);
            settings.frame = static_cast<std::uint64_t>(i);
            imaging::render_picture(beam, beams.detector(), scenery.geometry.pixel_mm * scenery.geometry.width_px,
                                    pulse, lengths, settings, picture);
          });
          if (i == 0) continue;  // warm
          ms.push_back(whole.ms_median);
          share.push_back(whole.ms_median / alone.ms_median);
        }
        std::sort(ms.begin(), ms.end());
        std::sort(share.begin(), share.end());
        row.n = static_cast<int>(ms.size());
        row.ms_median = ms[ms.size() / 2];
        row.ms_min = ms.front();
        row.ms_max = ms.back();
        row.error = bench_number(share[share.size() / 2]);
        rows_.push_back(row);
      }
  }

  bool quick_;
  int n_;
  std::vector<BenchRow>& rows_;
  std::vector<Instructions> instructions_;
  std::vector<int> threads_;
  std::optional<gpu::Context> context_;
  std::vector<double> reference_;
  std::string reference_name_;
};

}  // namespace

base::Result<void> bench_xray(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  XrayStage stage(quick, rows);
  volume::Volume phantom;
  if (arguments.has("--volume")) {
    auto source = casedb::read_source(arguments.text("--volume"));
    if (!source) return source.error();
    phantom = std::move(source->volume);
  } else {
    phantom = make_projector_phantom();
  }
  stage.run({"G1", &phantom, peer_geometry(600.0, 512, 512)});
  stage.run({"G2", &phantom, peer_geometry(400.0, 624, 420)});
  if (!arguments.has("--ct")) return {};
  const auto patient = casedb::read_source(arguments.text("--ct"));
  if (!patient) return patient.error();
  stage.run({"AP", &patient->volume, anterior_posterior(patient->volume)});
  return {};
}

}  // namespace seldinger::measure
