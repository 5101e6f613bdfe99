// bench --stage displacement: ultrasound of tissue that moves beside that of tissue that lies still, in one run,
// and how far what lays its speckle and finds its way back are from u and its inverse.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <thread>

#include "app/measure/bench/bench.h"
#include "sim/base/failure.h"
#include "sim/base/rng.h"
#include "sim/imaging/ultrasound/ultrasound_gpu.h"
#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/visible.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::measure {
namespace {

struct Patient {
  volume::Volume volume;
  std::vector<volume::TissueClass> classes;
  glm::dvec3 front_lps_mm{0.0};  // the skin before its middle
  imaging::TissueVolume tissue() const { return {&volume, classes, {}}; }
};

Patient torso() {
  volume::Phantom made = volume::make_phantom();
  Patient patient{std::move(made.volume), {}};
  patient.classes = volume::tissue_classes(patient.volume, &made.labels);
  glm::ivec3 at = patient.volume.size_voxels / 2, skin = at;
  for (; at.y >= 0; --at.y)
    if (patient.classes[patient.volume.index(at.x, at.y, at.z)] != volume::TissueClass::air) skin = at;
  patient.front_lps_mm = glm::dvec3(patient.volume.lps_from_voxel * glm::dvec4(skin, 1.0));
  return patient;
}

constexpr double kPressMm = 8.0;

// Pressed, breathed in, a needle dragged: everything at once.
tissue::Displacement displacement_in(const Patient& patient) {
  const std::array<tissue::SkinPress, 1> press{
      {{.at_lps_mm = patient.front_lps_mm, .inward = {0.0, 1.0, 0.0}, .radius_mm = 20.0, .depth_mm = kPressMm}}};
  const tissue::NeedleDrag needle{.entry_lps_mm = patient.front_lps_mm - glm::dvec3(25.0, 0.0, 0.0),
                                  .direction = glm::normalize(glm::dvec3(0.5, 1.0, 0.0)),
                                  .cut_mm = 50.0,
                                  .tip_n = 1.0,
                                  .tip_mm = 2.0,
                                  .shaft_mm = 2.0};
  const tissue::Breath breath{{.middle_x_mm = patient.front_lps_mm.x,
                               .back_y_mm = patient.front_lps_mm.y + 220.0,
                               .dome_z_mm = patient.front_lps_mm.z + 30.0},
                              {2.0, 15.0, 16.0}};
  return tissue::displacement_of({.presses = press, .needle = needle, .breath = breath});
}

class Chart {
 public:
  Chart(const Patient& patient, const imaging::Probe& probe, bool quick, std::vector<BenchRow>& rows)
      : patient_(patient), displacement_(displacement_in(patient)), n_(quick ? 5 : 15), rows_(rows) {
    view_.probe = probe;
    view_.depth_mm = probe.radius_mm > 0.0 ? 150.0 : 50.0;
    view_.origin_lps_mm = patient.front_lps_mm + glm::dvec3(0.0, kPressMm, 0.0);
    inserted_.needle = imaging::NeedlePose{patient.front_lps_mm + glm::dvec3(0.0, 50.0, 0.0),
                                           glm::normalize(glm::dvec3(0.5, 1.0, 0.0))};
    inserted_.lesions.push_back({patient.front_lps_mm + glm::dvec3(5.0, 45.0, 0.0), 5.0, 10.0});
  }

  void pictures() {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    for (const auto method : {imaging::UltrasoundMethod::scatterers, imaging::UltrasoundMethod::lattice})
      for (const int threads : cores > 1 ? std::vector<int>{1, 2} : std::vector<int>{1}) {
        view_.method = method;
        view_.threads = threads;
        imaging::PolarPicture picture;
        pair("cpu", std::to_string(threads) + (threads == 1 ? " thread" : " threads"), n_,
             [&](const tissue::Displacement& displacement) {
               imaging::ultrasound_polar(patient_.tissue(), view_, inserted_, {}, picture, displacement);
             });
      }
    try {
      gpu::Context context;
      imaging::UltrasoundGpu gpu(context, patient_.tissue(), imaging::LinesBy::machine, imaging::TissueMoves::yes);
      imaging::PolarPicture picture;
      for (const auto method : {imaging::UltrasoundMethod::scatterers, imaging::UltrasoundMethod::lattice}) {
        view_.method = method;
        pair("gpu", context.renderer(), n_, [&](const tissue::Displacement& displacement) {
          gpu.polar(view_, inserted_, {}, picture, displacement);
        });
      }
    } catch (const base::Failure& failure) {
      std::fprintf(stderr, "no GL here: %s\n", failure.what());
    }
    view_.method = imaging::UltrasoundMethod::scatterers;
    what_ = "truth per frame, no picture, ";
    pair("cpu", "1 thread", 5 * n_, [&](const tissue::Displacement& displacement) {
      (void)imaging::ultrasound_visible(patient_.tissue(), view_, inserted_, {}, displacement);
    });
    what_.clear();
  }

  void grids(bool quick) {
    BenchRow row = row_of("grids of a picture", "cpu", "1 thread");
    time_into(row, n_, [&] { (void)imaging::motion_of(view_, displacement_); });
    rows_.push_back(row);
    const imaging::PictureMotion motion(view_, displacement_);
    base::Rng rng(1);
    const int places = quick ? 3000 : 30000;
    double forwards_2 = 0.0, back_2 = 0.0, forwards_most = 0.0, back_most = 0.0;
    int n = 0;
    for (int tries = 0; n < places && tries < 20 * places; ++tries) {
      const double beam = rng.uniform() * (view_.beams - 1.0), depth_mm = rng.uniform() * view_.depth_mm;
      const glm::dvec3 at = imaging::point_of(view_, beam, depth_mm);
      const glm::dvec3 rest = tissue::rest_of(displacement_, at, {.fixed_point = 4, .newton = 6});
      if (!(rest.y > patient_.front_lps_mm.y)) continue;  // no tissue
      ++n;
      const double back = glm::length(motion.path(beam).at(depth_mm) - rest);
      const double forwards = glm::length(motion.slab().moved_mm(rest) - (at - rest));
      back_2 += back * back;
      forwards_2 += forwards * forwards;
      back_most = std::max(back_most, back);
      forwards_most = std::max(forwards_most, forwards);
    }
    const auto add = [&](const char* method, double squares, double most) {
      BenchRow miss = row_of(method, "cpu", "1 thread");
      miss.setting += ", at most " + bench_number(most) + " mm";
      miss.n = n;
      miss.error = bench_number(std::sqrt(squares / n));
      miss.error_unit = "mm rms";
      miss.reference = "u itself, turned round for each sample";
      rows_.push_back(miss);
    };
    add("where speckle is laid", forwards_2, forwards_most);
    add("where samples come from", back_2, back_most);
  }

 private:
  BenchRow row_of(const std::string& method, const std::string& backend, const std::string& device) const {
    const bool lattice = view_.method == imaging::UltrasoundMethod::lattice;
    return {"displacement",
            "ultrasound, " + method,
            std::string(view_.probe.name) + " 128x1024, " + (lattice ? "lattice" : "scatterers"),
            backend,
            device,
            bench_size(patient_.volume),
            0,
            0,
            0,
            0,
            "",
            "",
            ""};
  }

  // Still and moving by turns, so that what else the machine does falls on both.
  template <typename Paint>
  void pair(const std::string& backend, const std::string& device, int n, const Paint& paint) {
    BenchRow still = row_of(what_ + "still", backend, device), moving = row_of(what_ + "moving", backend, device);
    const tissue::Displacement none{};
    paint(none);
    paint(displacement_);  // warm
    std::vector<double> of_still, of_moving, ratios;
    for (int i = 0; i < n; ++i) {
      BenchRow one = still, other = moving;
      time_into(one, 1, [&] { paint(none); });
      time_into(other, 1, [&] { paint(displacement_); });
      of_still.push_back(one.ms_median);
      of_moving.push_back(other.ms_median);
      ratios.push_back(other.ms_median / one.ms_median);
    }
    fill(still, of_still);
    fill(moving, of_moving);
    std::sort(ratios.begin(), ratios.end());
    moving.error = bench_number(100.0 * (ratios[ratios.size() / 2] - 1.0));
    moving.error_unit = "% more than still";
    moving.reference = "still, by turns in this run";
    rows_.push_back(still);
    rows_.push_back(moving);
  }
  static void fill(BenchRow& row, std::vector<double>& ms) {
    std::sort(ms.begin(), ms.end());
    row.n = static_cast<int>(ms.size());
    row.ms_median = ms[ms.size() / 2];
    row.ms_min = ms.front();
    row.ms_max = ms.back();
  }

  const Patient& patient_;
  tissue::Displacement displacement_;
  imaging::UltrasoundView view_;
  imaging::Inserted inserted_;
  int n_;
  std::string what_;
  std::vector<BenchRow>& rows_;
};

}  // namespace

void bench_moving_ultrasound(bool quick, std::vector<BenchRow>& rows) {
  const Patient patient = torso();
  for (const imaging::Probe& probe : {imaging::kC52v, imaging::kL115v}) {
    Chart chart(patient, probe, quick, rows);
    chart.pictures();
    chart.grids(quick);
  }
}

}  // namespace seldinger::measure
