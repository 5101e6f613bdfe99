#include "sim/imaging/xray/live_picture.h"

#include <utility>

#include "sim/imaging/xray/projection/coarse.h"

namespace seldinger::imaging {

const FluoroscopyPicture& LivePicture::expose(const XrayGeometry& geometry, bool arm_moves,
                                              const Inserted& inserted, std::vector<float> contrast_mm,
                                              const BeamSignal& beam, const Detector& detector,
                                              double field_side_mm, const Pulse& pulse,
                                              const PictureSettings& settings) {
  // Coarse lengths do for a moving arm, and not for one at rest.
  if (!geometry_ || !(*geometry_ == geometry) || (coarse_ && !arm_moves)) {
    const CpuOptions options{.threads = settings.threads};
    const XrayGeometry at = arm_moves ? coarser(geometry, kMovingCoarseness) : geometry;
    const auto of_each_pixel = [&](PathLengths lengths) {
      return arm_moves ? enlarged(lengths, kMovingCoarseness) : std::move(lengths);
    };
    patient_ = of_each_pixel(projector_->project(at, ProjectionMethod::exact, options));
    if (enhanced_) iodine_ = of_each_pixel(enhanced_->project(at, options));
    geometry_ = geometry;
    coarse_ = arm_moves;
    ++integrations_;
  }
  lengths_ = patient_;
  lengths_.contrast_mm = std::move(contrast_mm);
  overlay_instruments(*volume_, geometry, inserted, ProjectionMethod::exact, lengths_);
  if (enhanced_) tell_iodine(*enhanced_, geometry, inserted, iodine_, lengths_);
  render_picture(beam, detector, field_side_mm, pulse, lengths_, settings, picture_);
  return picture_;
}

}  // namespace seldinger::imaging
