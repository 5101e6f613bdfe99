#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include "app/measure/bench/bench.h"
#include "app/measure/goals/goals_answer.h"
#include "app/measure/ultrasound_goals/goal.h"
#include "casedb/import/import.h"
#include "sim/base/failure.h"
#include "sim/imaging/ultrasound/ultrasound_gpu.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/imaging/ultrasound/visible.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::measure {
namespace {

using imaging::PolarPicture;
using imaging::Probe;
using imaging::UltrasoundMethod;
using imaging::UltrasoundView;

constexpr imaging::DisplaySize kDisplay{800, 700};
constexpr double kBytesPerMb = 1024.0 * 1024.0;
constexpr std::uint64_t kFrame = 1;
constexpr double kMostShare = 100.0;  // an error that cannot be measured is charted as that

// What is timed: the probe on a patient, a needle and a lesion in the picture.
struct Patient {
  std::string name;
  const volume::Volume* volume;
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;
  imaging::TissueVolume tissue() const { return {volume, classes, echogenicity}; }
};

// On the front of the body in the volume's middle, looking back.
UltrasoundView view_of(const Patient& patient, const Setting& setting) {
  const volume::Volume& v = *patient.volume;
  UltrasoundView view = setting.view();
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(v);
  const glm::dvec3 middle(v.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(v.size_voxels - 1), 1.0));
  glm::dvec3 at = middle;
  for (double up_mm = 0.0; up_mm < 400.0; up_mm += 1.0) {
    const glm::dvec3 p = middle - glm::dvec3(0.0, up_mm, 0.0);
    const glm::ivec3 i(glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)) + 0.5));
    if (i.x < 0 || i.y < 0 || i.z < 0 || i.x >= v.size_voxels.x || i.y >= v.size_voxels.y || i.z >= v.size_voxels.z)
      break;
    if (patient.classes[v.index(i.x, i.y, i.z)] != volume::TissueClass::air) at = p;
  }
  view.origin_lps_mm = at;
  return view;
}

imaging::Inserted inserted_in(const UltrasoundView& view) {
  imaging::Inserted inserted;
  const glm::dvec3 target = imaging::point_of(view, 0.5 * view.beams, 0.5 * view.depth_mm);
  inserted.needle = imaging::NeedlePose{target, glm::normalize(view.axial + view.lateral)};
  inserted.lesions.push_back({target, 5.0, 10.0});
  return inserted;
}

std::string count_text(int n, const char* what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string setting_text(const Setting& setting) {
  std::string text =
      std::string(setting.probe.name) + " " + std::to_string(setting.beams) + "x" + std::to_string(setting.samples);
  if (setting.method == UltrasoundMethod::scatterers)
    text += ", " + bench_number(setting.scatterers_per_cell) + " a cell";
  return text;
}

// How far the resident size rises while `work` runs, above what it was, in MB.
double peak_growth_mb(const std::function<void()>& work) {
  const auto in_status = [](const char* key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind(key, 0) == 0) return std::strtod(line.c_str() + std::string(key).size(), nullptr) / 1024.0;
    return std::nan("");
  };
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // forgets the peak so far
  const double before = in_status("VmRSS:");
  work();
  return in_status("VmHWM:") - before;
}

// Of the pixels that either shows, how many are more than a grey apart, in %.
double apart_percent(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
  std::size_t lit = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    lit += a[i] > 0 || b[i] > 0;
    apart += std::abs(int{a[i]} - int{b[i]}) > 1;
  }
  return 100.0 * static_cast<double>(apart) / static_cast<double>(std::max<std::size_t>(lit, 1));
}

class UltrasoundStage {
 public:
  UltrasoundStage(bool quick, std::vector<BenchRow>& rows) : quick_(quick), n_(quick ? 5 : 11), rows_(rows) {
    try {
      context_.emplace();
    } catch (const base::Failure& failure) {
      std::fprintf(stderr, "no GL here: %s\n", failure.what());
    }
  }

  // Errors do not depend on the patient: worked out once a setting.
  void chart(const Patient& patient, const Probe& probe, bool with_errors) {
    const Setting middle = setting_of(UltrasoundMethod::scatterers, probe);
    if (context_) gpu_.emplace(*context_, patient.tissue());
    for (const UltrasoundMethod method : kUltrasoundMethods) point(patient, setting_of(method, probe), with_errors);
    for (const int beams : quick_ ? std::vector<int>{64, 256} : std::vector<int>{64, 256, 512})
      for (const UltrasoundMethod method : kUltrasoundMethods) {
        Setting setting = setting_of(method, probe);
        setting.beams = beams;
        point(patient, setting, with_errors);
      }
    for (const int samples : quick_ ? std::vector<int>{512} : std::vector<int>{256, 512, 2048})
      for (const UltrasoundMethod method : kUltrasoundMethods) {
        Setting setting = setting_of(method, probe);
        setting.samples = samples;
        point(patient, setting, with_errors);
      }
    for (const double density :
         quick_ ? std::vector<double>{3.0, 16.0} : std::vector<double>{1.0, 2.0, 4.0, 16.0, 32.0}) {
      Setting setting = middle;
      setting.scatterers_per_cell = density;
      point(patient, setting, with_errors);
    }
    parts(patient, middle);
    gpu_.reset();
  }

 private:
  static Setting setting_of(UltrasoundMethod method, const Probe& probe) {
    Setting setting = Setting::of(method, probe, Quality::fast);
    setting.quick = true;
    return setting;
  }

  BenchRow row_of(const Patient& patient, const Setting& setting, int threads) const {
    return {"ultrasound",
            name_of(setting.method),
            patient.name + " " + setting_text(setting),
            "cpu",
            count_text(threads, "thread"),
            bench_size(*patient.volume),
            0,
            0,
            0,
            0,
            "",
            "",
            ""};
  }

  void point(const Patient& patient, const Setting& setting, bool with_errors) {
    UltrasoundView view = view_of(patient, setting);
    const imaging::Inserted inserted = inserted_in(view);
    const imaging::ScanConverter converter(view, kDisplay);
    PolarPicture polar;
    std::vector<unsigned char> grey;
    std::string error, what;
    if (with_errors) {
      const Worst worst = worst_of(measure_by_setting(setting), Quality::fast);
      error = bench_number(std::min(worst.share, kMostShare));
      what = worst.what;
    }
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    for (const int threads : cores > 1 ? std::vector<int>{1, 2} : std::vector<int>{1}) {
      view.threads = threads;
      const auto work = [&] {
        imaging::ultrasound_polar(patient.tissue(), view, inserted, {}, polar);
        converter.grey(view, {}, polar, grey);
      };
      work();  // warm
      BenchRow row = row_of(patient, setting, threads);
      time_into(row, n_, work);
      row.error = error;
      row.error_unit = error.empty() ? "" : "worst error over tolerance, at most 100";
      row.reference = what.empty() ? "" : "goal " + what;
      rows_.push_back(row);
    }
    if (gpu_ && setting.method != UltrasoundMethod::thesis) point_on_gpu(patient, setting, view, inserted);
  }

  // As practised with: the envelope by the GPU, noise and screen by the CPU.
  void point_on_gpu(const Patient& patient, const Setting& setting, const UltrasoundView& view,
                    const imaging::Inserted& inserted) {
    PolarPicture polar;
    std::vector<unsigned char> by_cpu, by_gpu;
    const imaging::ScanConverter converter(view, kDisplay);
    imaging::ultrasound_polar(patient.tissue(), view, inserted, {}, polar);
    imaging::add_receiver_noise(view.seed, kFrame, polar);
    converter.grey(view, {}, polar, by_cpu);
    const auto work = [&] {
      gpu_->polar(view, inserted, {}, polar);
      imaging::add_receiver_noise(view.seed, kFrame, polar);
      converter.grey(view, {}, polar, by_gpu);
    };
    work();  // warm
    BenchRow row = row_of(patient, setting, 1);
    row.backend = "gpu";
    row.device = context_->renderer();
    time_into(row, n_, work);
    row.error = bench_number(apart_percent(by_cpu, by_gpu));
    row.error_unit = "% of lit pixels over a grey apart";
    row.reference = "the cpu's picture";
    rows_.push_back(row);
  }

  // Of the setting in the middle: what the screen costs alone, and the memory of a picture.
  void parts(const Patient& patient, const Setting& setting) {
    UltrasoundView view = view_of(patient, setting);
    view.threads = 2;
    const imaging::Inserted inserted = inserted_in(view);
    const imaging::ScanConverter converter(view, kDisplay);
    PolarPicture polar;
    std::vector<unsigned char> shown;
    imaging::ultrasound_polar(patient.tissue(), view, inserted, {}, polar);
    BenchRow grey = row_of(patient, setting, 1);
    grey.method = "noise and grey alone, 800x700";
    time_into(grey, n_, [&] {
      imaging::add_receiver_noise(view.seed, kFrame, polar);
      converter.grey(view, {}, polar, shown);
    });
    rows_.push_back(grey);
    BenchRow truth = row_of(patient, setting, 1);
    truth.method = "truth per frame, no picture";
    time_into(truth, 101, [&] { (void)imaging::ultrasound_visible(patient.tissue(), view, inserted, {}); });
    rows_.push_back(truth);
    BenchRow memory = row_of(patient, setting, 2);
    memory.method = "peak memory of a picture";
    double mb = 0.0;
    time_into(memory, 1, [&] {
      mb = peak_growth_mb([&] {
        const imaging::ScanConverter fresh(view, kDisplay);
        PolarPicture picture;
        std::vector<unsigned char> pixels;
        imaging::ultrasound_polar(patient.tissue(), view, inserted, {}, picture);
        fresh.grey(view, {}, picture, pixels);
      });
    });
    memory.error = bench_number(mb);
    memory.error_unit = "MB beside the volume";
    rows_.push_back(memory);
    if (!gpu_) return;
    // By now the buffers are as large as any setting of this chart made them; a fresh one holds what this one
    // needs.
    imaging::UltrasoundGpu fresh(*context_, patient.tissue());
    BenchRow on_gpu = row_of(patient, setting, 1);
    on_gpu.method = memory.method;
    on_gpu.backend = "gpu";
    on_gpu.device = context_->renderer();
    time_into(on_gpu, 1, [&] { fresh.polar(view, inserted, {}, polar); });
    const auto mb_of = [](std::size_t bytes) { return static_cast<double>(bytes) / kBytesPerMb; };
    on_gpu.error = bench_number(mb_of(fresh.buffer_bytes() + fresh.tissue_bytes()));
    on_gpu.error_unit = memory.error_unit;
    on_gpu.reference = "buffers and the tissue's texture, " + bench_number(mb_of(fresh.tissue_bytes()));
    rows_.push_back(on_gpu);
  }

  bool quick_;
  int n_;
  std::vector<BenchRow>& rows_;
  std::optional<gpu::Context> context_;
  std::optional<imaging::UltrasoundGpu> gpu_;  // of the patient that is charted
};

Patient patient_of(std::string name, const volume::Volume& volume, const volume::LabelMap* labels) {
  Patient patient{std::move(name), &volume, volume::tissue_classes(volume, labels), {}};
  patient.echogenicity = imaging::echogenicity(volume, patient.classes);
  imaging::show_organs(volume, patient.classes, patient.echogenicity);
  return patient;
}

}  // namespace

base::Result<void> bench_ultrasound(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows) {
  UltrasoundStage stage(quick, rows);
  const volume::Phantom torso = volume::make_phantom();
  const Patient built_in = patient_of("torso", torso.volume, &torso.labels);
  for (const Probe& probe : {imaging::kC52v, imaging::kL115v}) stage.chart(built_in, probe, true);
  if (!arguments.has("--ct")) return {};
  const auto source = casedb::read_source(arguments.text("--ct"));
  if (!source) return source.error();
  const Patient patient = patient_of("CT", source->volume, nullptr);
  for (const Probe& probe : {imaging::kC52v, imaging::kL115v}) stage.chart(patient, probe, false);
  return {};
}

}  // namespace seldinger::measure
