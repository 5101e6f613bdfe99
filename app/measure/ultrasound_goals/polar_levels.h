// Levels and likeness of polar pictures.
#pragma once

#include <cmath>
#include <vector>

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::measure {

inline float at(const imaging::PolarPicture& picture, int beam, int sample) {
  return picture.envelope[static_cast<std::size_t>(beam) * static_cast<std::size_t>(picture.samples) +
                          static_cast<std::size_t>(sample)];
}

inline double decibels(double amplitude) {
  return 20.0 * std::log10(amplitude);
}

inline int sample_at(const imaging::UltrasoundView& view, double depth_mm) {
  return static_cast<int>(depth_mm / view.depth_mm * view.samples);
}
inline double depth_at(const imaging::UltrasoundView& view, int sample) {
  return (sample + 0.5) * view.depth_mm / view.samples;
}
// The beam that stands where `of_128` of 128 would.
inline int beam_at(const imaging::UltrasoundView& view, double of_128) {
  return static_cast<int>(of_128 / 128.0 * view.beams);
}

// Mean square of the envelope.
double mean_square(const imaging::PolarPicture& picture, int first_beam, int end_beam, int first_sample,
                   int end_sample);
double level_db(const imaging::PolarPicture& picture, int first_beam, int end_beam, int first_sample,
                int end_sample);

// Of two equally long rows of numbers.
double correlation(const std::vector<double>& a, const std::vector<double>& b);

struct Peak {
  double depth_mm = 0.0;
  float level = 0.0F;
};
Peak peak_of(const imaging::PolarPicture& picture, const imaging::UltrasoundView& view, int beam);

}  // namespace seldinger::measure
