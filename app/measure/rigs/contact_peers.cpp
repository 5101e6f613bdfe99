#include "app/measure/rigs/contact_peers.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace seldinger::measure {
namespace {

// Boussinesq's solution at ν = 1/2 for a force `above` the skin, times 4 π G / F. All in contact radii.
glm::dvec3 shifted(const glm::dvec3& at, const glm::dvec2& place, double above) {
  const glm::dvec3 from = at - glm::dvec3(place, -above);
  const double distance = glm::length(from);
  return glm::dvec3(0.0, 0.0, 1.0 / distance) + from * (from.z / (distance * distance * distance));
}

struct Shifted {
  double weight, above;
};
glm::dvec3 middle_and_ring(const glm::dvec3& at, Shifted middle, Shifted each_of_ring, double ring) {
  glm::dvec3 sum = middle.weight * shifted(at, {0.0, 0.0}, middle.above);
  constexpr double kSine = 0.8660254037844386;  // of 60°
  for (const glm::dvec2& place :
       {glm::dvec2(1.0, 0.0), {0.5, kSine}, {-0.5, kSine}, {-1.0, 0.0}, {-0.5, -kSine}, {0.5, -kSine}})
    sum += each_of_ring.weight * shifted(at, ring * place, each_of_ring.above);
  return sum;
}

// F / (4 π G a δ) = 16/3 / 4π.
constexpr double kForce = 4.0 / (3.0 * std::numbers::pi);

}  // namespace

std::vector<ContactPeer> contact_peers(const BallContact& contact) {
  const double a = contact_radius_mm(contact), depth_mm = contact.depth_mm;
  const auto peer = [&](const char* name, auto of_radii) {
    return ContactPeer{name,
                       [a, depth_mm, of_radii](const glm::dvec3& at_mm) { return depth_mm * of_radii(at_mm / a); }};
  };
  return {peer("bell times fall-off",
               [](const glm::dvec3& at) {
                 constexpr double kWidth = 0.7, kDepth = 3.0;
                 const double bell = std::exp(-(at.x * at.x + at.y * at.y) / (2.0 * kWidth * kWidth));
                 return glm::dvec3(0.0, 0.0, bell * std::exp(-at.z / kDepth));
               }),
          peer("1 shifted source",
               [](const glm::dvec3& at) {
                 // As far above as gives the depth below it: 2 F / (4 π G ε) = δ.
                 return kForce * shifted(at, {0.0, 0.0}, 2.0 * kForce);
               }),
          peer("7 shifted sources",
               [](const glm::dvec3& at) {
                 // A seventh of Hertz' force in the middle, the rest at its mean radius; as far above as gives the
                 // depth.
                 return middle_and_ring(at, {kForce / 7.0, 0.299}, {kForce / 7.0, 0.299}, 0.653);
               }),
          peer("7 shifted sources, least squares", [](const glm::dvec3& at) {
            // Places by search on a grid of 0.1, weights by least squares, over 4a × 6a by volume.
            return middle_and_ring(at, {-1.4548, 0.7}, {0.3118, 0.5}, 0.4);
          })};
}

}  // namespace seldinger::measure
