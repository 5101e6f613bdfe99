#include "app/measure/ultrasound_goals/polar_levels.h"

namespace seldinger::measure {

double mean_square(const imaging::PolarPicture& picture, int first_beam, int end_beam, int first_sample,
                   int end_sample) {
  double sum = 0.0;
  for (int b = first_beam; b < end_beam; ++b)
    for (int k = first_sample; k < end_sample; ++k) sum += double{at(picture, b, k)} * at(picture, b, k);
  return sum / ((end_beam - first_beam) * (end_sample - first_sample));
}

double level_db(const imaging::PolarPicture& picture, int first_beam, int end_beam, int first_sample,
                int end_sample) {
  return 10.0 * std::log10(mean_square(picture, first_beam, end_beam, first_sample, end_sample));
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  const double n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i], sum_b += b[i];
    aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  }
  return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

Peak peak_of(const imaging::PolarPicture& picture, const imaging::UltrasoundView& view, int beam) {
  Peak peak;
  for (int k = 0; k < view.samples; ++k)
    if (at(picture, beam, k) > peak.level) peak = {depth_at(view, k), at(picture, beam, k)};
  return peak;
}

}  // namespace seldinger::measure
