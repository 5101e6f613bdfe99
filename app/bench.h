// What bench stages share: rows of time against error. Figures, not tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/arguments.h"
#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::app {

// A row of results.csv (contracts.md, bench).
struct BenchRow {
  std::string stage, method, setting, backend, device, size;
  int n = 0;
  double ms_median = 0.0, ms_min = 0.0, ms_max = 0.0;
  std::string error, error_unit, reference;
};

std::string bench_number(double value);
std::string bench_size(const volume::Volume& volume);

// Runs `work` n times and fills the times of a row.
void time_into(BenchRow& row, int n, const std::function<void()>& work);

// Stage xray: projectors, the fluoroscopy chain; on `--volume FILE` or the projector phantom, and on `--ct SOURCE`.
base::Result<void> bench_xray(const Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Stage breathing: what tissue that moves adds to a fluoroscope's pulse, and how far that is from the truth; on
// `--ct SOURCE`, else the torso.
base::Result<void> bench_breathing(const Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Stage ultrasound: methods, beams, samples and densities on the built-in torso, and timed on `--ct SOURCE`. The
// error is the worst of the goals that a setting can change, over its tolerance (fast column, few frames).
base::Result<void> bench_ultrasound(const Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Stage haptics: the needle's laws at three speeds against the published lines, and their page of force against
// depth.
void bench_haptics(bool quick, std::vector<BenchRow>& rows);
std::string force_depth_page();
// Stage haptics, too: a tick of two hands on a skin of some 200,000 triangles and 512³ voxels (quick: the torso as
// it is).
base::Result<void> bench_servo(bool quick, std::vector<BenchRow>& rows);

// Also of stage haptics: segment queries beside Embree, ticks of the proxies.
void bench_touch(bool quick, std::vector<BenchRow>& rows);

// Stage displacement: what moves tissue under a probe, by model against Hertz' full field, and ways back from where
// tissue is to where it was, by their steps.
void bench_displacement(bool quick, std::vector<BenchRow>& rows);
// Also of stage displacement: ultrasound of the torso, moving beside still, and how far its grids are off.
void bench_moving_ultrasound(bool quick, std::vector<BenchRow>& rows);

// Stage room: the patient's picture by quality, size, one eye or two; `--ct SOURCE` in place of the torso.
base::Result<void> bench_room(const Arguments& arguments, bool quick, std::vector<BenchRow>& rows);

// Stage library: lists, checks, backups and bundles of 5,000 small cases and 20,000 attempts (quick: a tenth).
base::Result<void> bench_library(bool quick, std::vector<BenchRow>& rows);

// Stage assessment: every metric of an attempt of ten minutes, at the rates that trackers have.
base::Result<void> bench_assessment(bool quick, std::vector<BenchRow>& rows);

}  // namespace seldinger::app
