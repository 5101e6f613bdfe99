#include "sim/haptics/proxy/volume_proxy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::haptics {
namespace {

constexpr int kMostLooks = 400;          // a tick, at the volume
constexpr int kMostSlides = 32;          // a tick
constexpr double kVolumeThereMm = 1e-5;  // no way left to go

double length_of(const glm::dvec3& v) {
  return std::sqrt(glm::dot(v, v));
}

// Between `outside` and `inside`, a step apart: the last place outside, as near to the surface as counts.
glm::dvec3 surface_between(const IsoSurface& surface, glm::dvec3 outside, glm::dvec3 inside) {
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 middle = 0.5 * (outside + inside);
    (surface.at(middle).hu >= 0.0 ? inside : outside) = middle;
  }
  return outside;
}

// From `p`, near the surface, to just outside it by Newton's steps along its rise; nowhere farther than `most_mm`.
bool come_to_surface(const IsoSurface& surface, double most_mm, glm::dvec3& p) {
  const glm::dvec3 start = p;
  for (int i = 0; i < 8; ++i) {
    const IsoSurface::Value value = surface.at(p);
    const double rise2 = glm::dot(value.rise_hu_mm, value.rise_hu_mm);
    if (!(rise2 > 0.0)) return false;
    const double off_mm = value.hu / std::sqrt(rise2);
    if (off_mm < 0.0 && off_mm > -kVolumeThereMm) return true;
    // Half of what counts outside, so that it ends on the right side.
    p -= value.rise_hu_mm * ((off_mm + 0.5 * kVolumeThereMm) / std::sqrt(rise2));
    if (length_of(p - start) > most_mm) return false;
  }
  return surface.at(p).hu < 0.0;
}

}  // namespace

VolumeProxy::VolumeProxy(const VolumeProxySettings& settings) : settings_(settings), spring_(settings.spring) {
  CHECK(settings.dynamic_friction >= 0.0 && settings.static_friction >= settings.dynamic_friction);
}

void VolumeProxy::follow(const IsoSurface& surface, const glm::dvec3& device,
                         VolumeProxyTrack& track) const noexcept {
  const double friction = track.holding ? settings_.static_friction : settings_.dynamic_friction;
  glm::dvec3& proxy = track.proxy_lps_mm;
  bool slid = false;
  int looks = 0;
  for (int slide = 0; slide < kMostSlides;) {
    const glm::dvec3 wanted = device - proxy;
    if (track.touching) {
      const glm::dvec3 rise = surface.at(proxy).rise_hu_mm;
      const double rise_length = length_of(rise);
      const glm::dvec3 inward = rise_length > 0.0 ? rise / rise_length : glm::dvec3(0.0);
      const double pressed_mm = glm::dot(wanted, inward);
      track.touching = pressed_mm > 0.0;
      if (track.touching) {
        const glm::dvec3 way = wanted - inward * pressed_mm;
        const double length_mm = length_of(way);
        if (!slid && length_mm <= friction * pressed_mm + kVolumeThereMm) {
          track.holding = true;
          return;
        }
        const double go_mm = std::min(length_mm - settings_.dynamic_friction * pressed_mm, 2.0 * surface.step_mm());
        if (!(go_mm > kVolumeThereMm)) return;
        glm::dvec3 next = proxy + way * (go_mm / length_mm);
        if (come_to_surface(surface, 4.0 * surface.step_mm(), next)) {
          proxy = next;
          track.holding = false;
          slid = true;
          ++slide;
          continue;
        }
        // An edge too sharp for a slide: over it if it falls away, else this is as near as it comes.
        next = proxy + way * (std::min(go_mm, surface.step_mm()) / length_mm);
        if (surface.at(next).hu >= 0.0) return;
        proxy = next;
        ++slide;
      }
    }
    const double length_mm = length_of(device - proxy);
    const glm::dvec3 along = length_mm > 0.0 ? (device - proxy) / length_mm : glm::dvec3(0.0);
    const glm::dvec3 from = proxy;
    for (double way_mm = 0.0; way_mm < length_mm && !track.touching;) {
      way_mm = std::min(length_mm, way_mm + surface.step_mm());
      const glm::dvec3 next = way_mm < length_mm ? from + along * way_mm : device;
      if (surface.at(next).hu >= 0.0) {
        proxy = surface_between(surface, proxy, next);
        track.touching = true;
      } else {
        proxy = next;
      }
      if (++looks >= kMostLooks) return;
    }
    if (!track.touching) {
      track.holding = false;
      return;
    }
    ++slide;
  }
}

glm::dvec3 VolumeProxy::advance(const IsoSurface& surface, const glm::dvec3& device,
                                VolumeProxyTrack& track) const noexcept {
  if (!std::isfinite(glm::dot(device, device))) return glm::dvec3(0.0);
  if (!track.begun || surface.at(track.proxy_lps_mm).hu >= 0.0) {
    track.begun = true;
    track.touching = track.holding = false;
    track.proxy_lps_mm = device;
  } else {
    follow(surface, device, track);
  }
  return spring_.advance(track.proxy_lps_mm - device, track.spring);
}

}  // namespace seldinger::haptics
