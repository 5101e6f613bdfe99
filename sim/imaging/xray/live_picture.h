// The picture on a fluoroscope's screen, pulse by pulse. The patient is integrated again only when the geometry has
// changed, or the patient: tube, window, noise, collimator and needle are passes over the same path lengths. While
// the arm moves the patient is integrated at half the resolution (docs/decisions/0011: on every backend measured
// here that is the faster way, not another method); at rest exactly. Between pulses the last image is held.
#pragma once

#include <optional>

#include "sim/imaging/xray/enhanced.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/picture.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

class LivePicture {
 public:
  static constexpr int kMovingCoarseness = 2;

  // Both must outlive it.
  LivePicture(const volume::Volume& volume, const XrayCpu& projector) : volume_(&volume), projector_(&projector) {}

  // From now on these: the patient has moved, and is integrated anew. `enhanced`: what of it is iodine.
  void take_patient(const volume::Volume& volume, const XrayCpu& projector,
                    const std::optional<EnhancedTissue>& enhanced = {}) noexcept {
    volume_ = &volume;
    projector_ = &projector;
    enhanced_ = enhanced;
    geometry_.reset();
  }

  // The picture of one pulse. `geometry` covers the pulse's whole field of field_side_mm, in order
  // (check_geometry), with width_px and height_px multiples of kMovingCoarseness. `contrast_mm` of each of its
  // pixels (contrast.h); empty: none.
  const FluoroscopyPicture& expose(const XrayGeometry& geometry, bool arm_moves, const Inserted& inserted,
                                   std::vector<float> contrast_mm, const BeamSignal& beam, const Detector& detector,
                                   double field_side_mm, const Pulse& pulse, const PictureSettings& settings);

  // Last-image hold: what the last pulse showed; nothing before the first.
  const FluoroscopyPicture* held() const noexcept { return picture_.grey.empty() ? nullptr : &picture_; }

  // How often the patient was integrated: what a still arm does not cost.
  int integrations() const noexcept { return integrations_; }

 private:
  const volume::Volume* volume_;
  const XrayCpu* projector_;
  std::optional<EnhancedTissue> enhanced_;
  std::optional<XrayGeometry> geometry_;  // of patient_
  bool coarse_ = false;
  PathLengths patient_, iodine_;  // without instruments; of enhanced_
  PathLengths lengths_;           // with them; kept for its memory
  FluoroscopyPicture picture_;
  int integrations_ = 0;
};

}  // namespace seldinger::imaging
