// Somebody who looks at one picture only and knows where to look: matched filters for a needle's tip and a place on
// its shaft, against the mean of what lies about it beside the needle. The threshold is that of the law, 6 dB above
// the background that is there as well.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/imaging/ultrasound/visible.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {

class NeedleDetector {
 public:
  NeedleDetector(const PolarPicture& picture, const UltrasoundView& view, const NeedlePose& needle,
                 const glm::dvec3& p_lps_mm)
      : picture_(picture), view_(view), needle_(needle) {
    const BeamAndDepth place = in_picture(p_lps_mm);
    beam_ = static_cast<int>(std::lround(place.beam));
    depth_mm_ = place.depth_mm;
  }

  bool tip() const { return stands_out(tip_power()); }
  bool shaft() const { return stands_out(shaft_power()); }

 private:
  bool stands_out(double here) const { return here >= (1.0 + std::pow(10.0, 0.1 * kNeedleAboveDb)) * background(); }
  double tip_power() const {
    const int middle = sample_at(view_, depth_mm_);
    double here = 0.0;
    for (int k = middle - 1; k <= middle + 1; ++k) here = std::max(here, power(beam_, k));
    return here;
  }
  // Over up to seven beams along the shaft, whose near side lies as much higher as it is thick and steep.
  double shaft_power() const {
    const double upper_mm = needle_.radius_mm / std::max(0.25, std::sqrt(1.0 - sine() * sine()));
    double here = 0.0;
    for (int up = -1; up <= 1 + static_cast<int>(upper_mm / sample_mm()); ++up) {
      double sum = 0.0;
      int count = 0;
      for (int b = beam_ - 3; b <= beam_ + 3; ++b) {
        const double shaft_mm = shaft_depth_mm(b);
        if (std::abs(shaft_mm - depth_mm_) > kAlongMm) continue;
        sum += power(b, sample_at(view_, shaft_mm) - up);
        ++count;
      }
      here = std::max(here, sum / count);
    }
    return here;
  }
  BeamAndDepth in_picture(const glm::dvec3& p_lps_mm) const {
    const glm::dvec3 d = p_lps_mm - view_.origin_lps_mm;
    return beam_and_depth(view_, glm::dot(d, view_.lateral), glm::dot(d, view_.axial));
  }
  double sine() const { return glm::dot(glm::normalize(needle_.direction), view_.axial); }
  double sample_mm() const { return view_.depth_mm / view_.samples; }
  // As the screen has it, which makes up for depth.
  double power(int beam, int sample) const {
    const double level = static_cast<double>(at(picture_, beam, sample));
    return level * level *
           std::exp(0.1 * std::log(10.0) * display_gain_db(view_, {}, (sample + 0.5) * sample_mm()));
  }
  // Where the shaft, drawn out beyond both ends, crosses a beam: by halving, it goes down from beam to beam.
  double shaft_depth_mm(int beam) const {
    double up_mm = -200.0, down_mm = 200.0;
    const auto beam_at = [&](double along_mm) {
      return in_picture(needle_.tip_lps_mm + along_mm * glm::normalize(needle_.direction));
    };
    for (int i = 0; i < 40; ++i) {
      const double middle_mm = 0.5 * (up_mm + down_mm);
      (beam_at(middle_mm).beam < beam ? up_mm : down_mm) = middle_mm;
    }
    return beam_at(down_mm).depth_mm;
  }
  // 3 mm about the place, and of the needle what lies 3 mm above to 6 mm below it, are no background.
  double background() const {
    double sum = 0.0;
    int count = 0;
    const int middle = sample_at(view_, depth_mm_);
    const glm::dvec3 here = point_of(view_, beam_, depth_mm_);
    for (int b = 0; b < view_.beams; ++b) {
      const double shaft_mm = shaft_depth_mm(b);
      for (int k = std::max(0, middle - 60); k <= std::min(view_.samples - 1, middle + 60); ++k) {
        const double z_mm = (k + 0.5) * sample_mm();
        if (glm::length(point_of(view_, b, z_mm) - here) < 3.0) continue;
        if (z_mm > shaft_mm - 3.0 && z_mm < shaft_mm + 6.0) continue;
        sum += power(b, k);
        ++count;
      }
    }
    EXPECT_GT(count, 400);
    return sum / count;
  }

  static constexpr double kAlongMm = 4.0;  // in depth, that a shaft is looked along
  const PolarPicture& picture_;
  const UltrasoundView& view_;
  const NeedlePose& needle_;
  int beam_ = 0;
  double depth_mm_ = 0.0;
};

inline bool tip_detected(const PolarPicture& picture, const UltrasoundView& view, const NeedlePose& needle) {
  return NeedleDetector(picture, view, needle, needle.tip_lps_mm).tip();
}
inline bool shaft_detected(const PolarPicture& picture, const UltrasoundView& view, const NeedlePose& needle,
                           double behind_tip_mm) {
  return NeedleDetector(picture, view, needle, needle.tip_lps_mm - behind_tip_mm * glm::normalize(needle.direction))
      .shaft();
}

// Of random scenes; more under the label `long`.
inline int random_scenes() {
  return std::getenv("SELDINGER_FUZZ") != nullptr ? 2000 : 600;
}

// How often a detector and the law say the same, apart for what lies within 3 dB of the limit.
struct Agreement {
  int far = 0, agree = 0, near = 0, near_seen = 0;
  void add(double above_limit_db, bool found) {
    if (std::abs(above_limit_db) > 3.0) {
      ++far;
      agree += found == (above_limit_db > 0.0) ? 1 : 0;
    } else {
      ++near;
      near_seen += found ? 1 : 0;
    }
  }
  void expect_holds(const char* what, int least_near) const {
    printf("%s: detector and law agree in %d of %d pictures beyond 3 dB of the limit; within, %d of %d are found\n",
           what, agree, far, near_seen, near);
    EXPECT_GE(agree, 0.95 * far) << what;
    EXPECT_GE(near, least_near) << what;
    const double by_chance = 2.0 * std::sqrt(0.25 * near);  // two sd of what few scenes show
    EXPECT_GE(near_seen, 0.35 * near - by_chance) << what;
    EXPECT_LE(near_seen, 0.65 * near + by_chance) << what;
  }
};

}  // namespace seldinger::imaging
