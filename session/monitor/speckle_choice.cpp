#include "session/monitor/speckle_choice.h"

namespace seldinger::session {
namespace {

constexpr double kUsualTimeOver = 0.6;  // of what a picture usually takes, what was before counts so much

}  // namespace

void SpeckleChoice::made(double t_s, double took_s) noexcept {
  if (method_ != imaging::UltrasoundMethod::scatterers) return;
  usual_s_ = usual_s_ > 0.0 ? kUsualTimeOver * usual_s_ + (1.0 - kUsualTimeOver) * took_s : took_s;
  if (usual_s_ < 1.0 / kFineHz) slow_pictures_ = 0;
  if (slow_pictures_ == 0 && usual_s_ <= 1.0 / kLeastHz) return;
  if (slow_pictures_ == 0) slow_since_s_ = t_s;
  ++slow_pictures_;
  if (slow_pictures_ > kLeastPictures && t_s - slow_since_s_ >= kForS) method_ = imaging::UltrasoundMethod::lattice;
}

}  // namespace seldinger::session
