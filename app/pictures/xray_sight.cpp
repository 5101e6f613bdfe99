#include "app/pictures/xray_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::app {

XraySight::XraySight(const volume::Volume& volume, const XrayView& view)
    : volume_(volume), geometry_(view.geometry), beams_(cases::Fluoroscope{}) {
  constexpr int kMeterPx = 64, kSettled = 4;
  imaging::XrayGeometry small = geometry_;
  // The same field in fewer pixels.
  const double by = std::max(1.0, static_cast<double>(std::max(small.width_px, small.height_px)) / kMeterPx);
  small.pixel_mm *= by;
  small.width_px = std::max(1, static_cast<int>(std::lround(small.width_px / by)));
  small.height_px = std::max(1, static_cast<int>(std::lround(small.height_px / by)));
  const imaging::PathLengths field = imaging::XrayCpu(volume).project(small, imaging::ProjectionMethod::exact);
  const imaging::AutomaticExposure automatic(beams_.fluoroscope());
  if (geometry_.source_lps_mm)
    pulse_.sid_mm = std::abs(glm::dot(geometry_.detector_center_lps_mm - *geometry_.source_lps_mm,
                                      glm::cross(geometry_.u, geometry_.v)));
  for (int i = 0; i < kSettled; ++i) pulse_.technique = imaging::meter(beams_, automatic, pulse_, field, {}).next;
}

imaging::Visible XraySight::see(const imaging::Inserted& inserted) {
  return imaging::xray_visible(volume_, geometry_, beams_.at(pulse_.technique.kv), pulse_, inserted);
}

}  // namespace seldinger::app
