// The goals of the ultrasound picture: each is measured from pictures of tissue whose answer is
// known in closed form, the same way for every method, and told as how far off it is.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/measure/ultrasound_goals/tissue_block.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::measure {

// The two columns of the table. fast: the picture as it is practised with. reference: the same model with 512
// beams, twice the samples and three times the scatterers, and four times the frames to measure it by.
enum class Quality { fast, reference };

using Paint = std::function<void(const imaging::TissueVolume&, const imaging::UltrasoundView&,
                                 const imaging::Inserted&, imaging::PolarPicture&)>;

// What is measured, and how thoroughly.
struct Setting {
  imaging::UltrasoundMethod method = imaging::UltrasoundMethod::scatterers;
  imaging::Probe probe = imaging::kC52v;
  int beams = 128, samples = 1024;
  double scatterers_per_cell = 8.0;
  Quality quality = Quality::fast;
  bool quick = false;  // fewer frames, where no goal asks for a number of them
  Paint paint;

  // Of a method on the CPU.
  static Setting of(imaging::UltrasoundMethod method, const imaging::Probe& probe, Quality quality);

  // 150 mm under a curved face, 50 under a straight one.
  double depth_mm() const noexcept { return probe.radius_mm > 0.0 ? 150.0 : 50.0; }
  imaging::UltrasoundView view() const;
  imaging::UltrasoundView lossless_view() const;  // soft tissue takes nothing
  int frames(int fast) const noexcept { return quality == Quality::reference ? 4 * fast : quick ? fast / 2 : fast; }
  imaging::PolarPicture picture(const TissueBlock& block, const imaging::UltrasoundView& view,
                                const imaging::Inserted& inserted = {}) const;
};

struct Reading {
  int goal;
  std::string what;
  std::string probe;
  double off;  // how far off, ≥ 0, in `unit`; NaN: nothing to be seen, which holds nowhere
  const char* unit;
  double fast, reference;  // tolerances

  double tolerance(Quality quality) const noexcept { return quality == Quality::fast ? fast : reference; }
  // Of the tolerance that is used up; infinity where off is NaN, or above a tolerance of 0.
  double share(Quality quality) const noexcept;
  bool holds(Quality quality) const noexcept { return share(quality) <= 1.0; }
};
using Readings = std::vector<Reading>;

// The greater; NaN, once there, stays.
inline double farther(double off, double other) noexcept {
  return std::isnan(off) || other <= off ? off : other;
}

struct Goal {
  int number;
  const char* name;
  bool by_setting;  // beams, samples or density can change it much
  void (*measure)(const Setting& setting, Readings& readings);
};
std::span<const Goal> ultrasound_goals();

Readings measure_all(const Setting& setting);
Readings measure_by_setting(const Setting& setting);

// max(off/tolerance); infinity where one cannot be measured. Names the reading.
struct Worst {
  double share = 0.0;
  std::string what;
};
Worst worst_of(std::span<const Reading> readings, Quality quality);

void measure_scan_conversion(const Setting& setting, Readings& readings);  // 1
void measure_attenuation(const Setting& setting, Readings& readings);      // 2
void measure_shadow(const Setting& setting, Readings& readings);           // 3
void measure_reflection(const Setting& setting, Readings& readings);       // 4
void measure_angle_law(const Setting& setting, Readings& readings);        // 5
void measure_statistics(const Setting& setting, Readings& readings);       // 6
void measure_widths(const Setting& setting, Readings& readings);           // 7
void measure_motion(const Setting& setting, Readings& readings);           // 8
void measure_contrast(const Setting& setting, Readings& readings);         // 9
void measure_enhancement(const Setting& setting, Readings& readings);      // 10
void measure_needle_place(const Setting& setting, Readings& readings);     // 11
void measure_needle_fading(const Setting& setting, Readings& readings);    // 12
void measure_slice(const Setting& setting, Readings& readings);            // 13
void measure_grey(const Setting& setting, Readings& readings);             // 14
void measure_bits(const Setting& setting, Readings& readings);             // 15
void measure_elements(const Setting& setting, Readings& readings);         // 16

}  // namespace seldinger::measure
