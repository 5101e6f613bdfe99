// What a person sees in a fixed X-ray view, as needle and lesions move: with the technique that automatic exposure
// of a usual machine would settle on in it.
#pragma once

#include "app/pictures/scene.h"
#include "sim/imaging/xray/visibility.h"

namespace seldinger::app {

class XraySight {
 public:
  // `volume` must outlive it.
  XraySight(const volume::Volume& volume, const XrayView& view);
  imaging::Visible see(const imaging::Inserted& inserted);

 private:
  const volume::Volume& volume_;
  imaging::XrayGeometry geometry_;
  imaging::Beams beams_;
  imaging::Pulse pulse_;
};

}  // namespace seldinger::app
