// What bench stages share: rows of time against error. Figures, not tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::measure {

// A row of results.csv.
struct BenchRow {
  std::string stage, method, setting, backend, device, size;
  int n = 0;
  double ms_median = 0.0, ms_min = 0.0, ms_max = 0.0;
  std::string error, error_unit, reference;
};

std::string bench_number(double value);
std::string bench_size(const volume::Volume& volume);
std::string bench_cores();  // of this machine, e.g. "2 cores"

// Runs `work` n times and fills the times of a row.
void time_into(BenchRow& row, int n, const std::function<void()>& work);

// The stages (stages.h). quick: fewer repetitions and smaller scenes. They read `--ct SOURCE` where a patient can
// take the place of the built-in one, xray also `--volume FILE`.
base::Result<void> bench_import(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
base::Result<void> bench_mpr(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Projectors and the fluoroscopy chain; on `--volume FILE` or the projector phantom, and on `--ct SOURCE`.
base::Result<void> bench_xray(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// What tissue that moves adds to a fluoroscope's pulse, and how far that is from the truth.
base::Result<void> bench_breathing(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Methods, beams, samples and densities on the built-in torso, and timed on `--ct SOURCE`. The error is the worst
// of the goals that a setting can change, over its tolerance (fast column, few frames).
base::Result<void> bench_ultrasound(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// The patient's picture by quality, size, one eye or two.
base::Result<void> bench_room(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// What moves tissue under a probe, by model against Hertz' full field, and ways back from where tissue is to where
// it was, by their steps.
base::Result<void> bench_displacement(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// The needle's laws at three speeds against the published lines, then bench_servo and bench_touch.
base::Result<void> bench_haptics(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
base::Result<void> bench_step(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Lists, checks, backups and bundles of 5,000 small cases and 20,000 attempts (quick: a tenth).
base::Result<void> bench_library(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
// Every metric of an attempt of ten minutes, at the rates that trackers have.
base::Result<void> bench_assessment(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);

// Part of stage ultrasound: a picture with all that lies over it beside one without.
void bench_everything_on(bool quick, std::vector<BenchRow>& rows);
// Part of stage displacement: ultrasound of the torso, moving beside still, and how far its grids are off.
void bench_moving_ultrasound(bool quick, std::vector<BenchRow>& rows);
// Parts of stage haptics: a tick of two hands on a skin of some 200,000 triangles and 512³ voxels (quick: the torso
// as it is); segment queries beside Embree, ticks of the proxies.
base::Result<void> bench_servo(bool quick, std::vector<BenchRow>& rows);
void bench_touch(bool quick, std::vector<BenchRow>& rows);
// Stage haptics' page of force against depth.
std::string force_depth_page();

}  // namespace seldinger::measure
