// How the ultrasound's speckle is made on this machine: as it is practised with, or where that is too slow, fast.
#pragma once

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::session {

// Scatterers, until they have for a while not come at kLeastHz; from then on the lattice. There is no way back
// within an attempt: a picture that changes its grain to and fro is worse than either.
class SpeckleChoice {
 public:
  static constexpr double kLeastHz = 5.0;  // our judgement
  static constexpr double kFineHz = 6.0;   // from here on the while begins anew
  static constexpr double kForS = 2.0;
  static constexpr int kLeastPictures = 5;

  imaging::UltrasoundMethod method() const noexcept { return method_; }
  // A picture by method() was there at t_s and had taken took_s, by one clock.
  void made(double t_s, double took_s) noexcept;

 private:
  imaging::UltrasoundMethod method_ = imaging::UltrasoundMethod::scatterers;
  double usual_s_ = 0.0, slow_since_s_ = 0.0;
  int slow_pictures_ = 0;  // 0: it is not slow
};

}  // namespace seldinger::session
