#include "sim/haptics/proxy/surface_proxy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::haptics {
namespace {

constexpr int kMostTouches = 8;    // at one place
constexpr int kMostSteps = 12;     // a tick; what is left of a long way is for the next
constexpr int kMostLifts = 4;      // a tick
constexpr double kThereMm = 1e-5;  // no way left to go

// How much nearer than its radius the ball may come (far below what is felt; design).
double slack_mm(double radius_mm) {
  return std::min(1e-3, 0.1 * radius_mm);
}

// What the ball touches at one place: unit vectors it may not move against.
struct Touches {
  glm::dvec3 normal[kMostTouches];
  int n = 0;

  void add(const glm::dvec3& one) {
    if (n < kMostTouches) normal[n++] = one;
  }
  bool allow(const glm::dvec3& way, double tolerance) const {
    for (int i = 0; i < n; ++i)
      if (glm::dot(normal[i], way) < -tolerance) return false;
    return true;
  }
  // The allowed way that ends nearest to where `wanted` does: in a cone, the longest of its projections on the
  // cone's inside, faces and edges that is allowed; exact, for all touches together.
  glm::dvec3 nearest(const glm::dvec3& wanted) const {
    const double tolerance = 1e-9 * std::sqrt(glm::dot(wanted, wanted));
    if (allow(wanted, tolerance)) return wanted;
    glm::dvec3 best(0.0);
    double best2 = 0.0;
    const auto offer = [&](const glm::dvec3& way) {
      const double length2 = glm::dot(way, way);
      if (!(length2 > best2) || !allow(way, tolerance)) return;
      best = way;
      best2 = length2;
    };
    for (int i = 0; i < n; ++i) {
      offer(wanted - normal[i] * glm::dot(normal[i], wanted));
      for (int j = 0; j < i; ++j) {
        const glm::dvec3 edge = glm::cross(normal[i], normal[j]);
        const double length2 = glm::dot(edge, edge);
        if (length2 > 1e-18) offer(edge * (glm::dot(edge, wanted) / length2));
      }
    }
    return best;
  }
};

}  // namespace

SurfaceProxy::SurfaceProxy(const SurfaceSettings& settings) : settings_(settings), spring_(settings.spring) {
  CHECK(settings.radius_mm >= 0.0 && settings.dynamic_friction >= 0.0);
  CHECK(settings.static_friction >= settings.dynamic_friction);
  settings_.radius_mm = std::max(kPointRadiusMm, settings.radius_mm);
}

void SurfaceProxy::follow(const cases::MeshIndex& mesh, const glm::dvec3& device,
                          SurfaceTrack& track) const noexcept {
  Touches touches;
  bool slid = false;
  int lifts = kMostLifts;
  const double slack = slack_mm(settings_.radius_mm);
  const double friction = track.holding ? settings_.static_friction : settings_.dynamic_friction;
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dvec3 wanted = device - track.proxy_lps_mm;
    const glm::dvec3 way = touches.nearest(wanted);
    const double length_mm = std::sqrt(glm::dot(way, way));
    double go_mm = length_mm;
    if (touches.n > 0) {
      const glm::dvec3 pressed = wanted - way;
      const double pressed_mm = std::sqrt(glm::dot(pressed, pressed));
      if (!slid && length_mm <= friction * pressed_mm + kThereMm) {
        track.holding = true;
        return;
      }
      go_mm -= settings_.dynamic_friction * pressed_mm;
    }
    if (!(go_mm > kThereMm)) return;
    const glm::dvec3 direction = way / length_mm;
    const auto touch =
        mesh.first_touch(track.proxy_lps_mm, direction, go_mm, settings_.radius_mm, slack, track.triangle);
    const double moved_mm = touch ? touch->travel_mm : go_mm;
    if (moved_mm > 0.0) {
      track.proxy_lps_mm += direction * moved_mm;
      slid = slid || touches.n > 0;
      track.holding = false;
      touches.n = 0;
    }
    // Over a hollow it comes a little nearer, within the slack. It must not stay there: so near, the edges that it
    // slides across would hold it.
    if (touch && lifts > 0 && touch->distance_mm < settings_.radius_mm - 0.1 * slack) {
      --lifts;
      const double lift_mm = std::min(slack, settings_.radius_mm - touch->distance_mm);
      const auto roof =
          mesh.first_touch(track.proxy_lps_mm, touch->normal, lift_mm, settings_.radius_mm, slack, touch->triangle);
      track.proxy_lps_mm += touch->normal * (roof ? roof->travel_mm : lift_mm);
      track.triangle = touch->triangle;
      touches.n = 0;
    } else if (touch) {
      touches.add(touch->normal);
      track.triangle = touch->triangle;
      track.touching = true;
    } else if (go_mm == length_mm && way == wanted) {
      track.touching = false;  // it is where the device is
      return;
    }
  }
}

glm::dvec3 SurfaceProxy::advance(const cases::MeshIndex& mesh, const glm::dvec3& device,
                                 SurfaceTrack& track) const noexcept {
  if (!std::isfinite(glm::dot(device, device))) return glm::dvec3(0.0);
  if (!track.begun) {
    track.begun = true;
    track.proxy_lps_mm = device;
  }
  if (!mesh.empty())
    follow(mesh, device, track);
  else
    track.proxy_lps_mm = device;
  return spring_.advance(track.proxy_lps_mm - device, track.spring);
}

}  // namespace seldinger::haptics
