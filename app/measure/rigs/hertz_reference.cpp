#include "app/measure/rigs/hertz_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/base/check.h"

namespace seldinger::measure {
namespace {

struct Node {
  double at, weight;  // on [−1, 1]
};

// Gauss and Legendre's, by Newton's steps on the polynomial.
std::vector<Node> gauss_nodes(int n) {
  std::vector<Node> nodes;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int step = 0; step < 50; ++step) {
      double before = 1.0, here = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k;
        before = here;
        here = next;
      }
      slope = n * (x * here - before) / (x * x - 1.0);
      x -= here / slope;
      if (std::abs(here / slope) < 1e-15) break;
    }
    nodes.push_back({x, 2.0 / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

// Integral from a to b of what may bend like a root at both ends.
template <typename Function>
double integral(const std::vector<Node>& nodes, double a, double b, Function&& function) {
  double sum = 0.0;
  for (const Node& node : nodes) {
    const double angle = 0.5 * std::numbers::pi * node.at;
    sum += node.weight * std::cos(angle) * function(0.5 * (a + b) + 0.5 * (b - a) * std::sin(angle));
  }
  return sum * 0.5 * std::numbers::pi * 0.5 * (b - a);
}

}  // namespace

double contact_radius_mm(const BallContact& contact) {
  return std::sqrt(contact.radius_mm * contact.depth_mm);
}

// In polar coordinates s, φ around the foot of the point: R² = s² + z², and s ds takes 1/R's pole away. s = z sinh
// v, so that a point close to the skin sees what is close to it.
AxisDisplacement hertz_reference(const BallContact& contact, double r_mm, double z_mm, int nodes) {
  CHECK(contact.radius_mm > 0.0 && contact.depth_mm > 0.0 && r_mm >= 0.0 && z_mm >= 0.0 && nodes > 1);
  const double a = contact_radius_mm(contact);
  const double z = std::max(z_mm, 1e-7 * a);
  const auto gauss = gauss_nodes(nodes);
  const bool under = r_mm < a;
  const double most_phi = under ? std::numbers::pi : std::asin(std::min(1.0, a / r_mm));
  // Along φ (from the direction towards the axis) the chord reaches from low to high.
  const auto over_chord = [&](double phi, auto&& kernel) {
    const double middle = r_mm * std::cos(phi), across = r_mm * std::sin(phi);
    const double half = std::sqrt(std::max(0.0, a * a - across * across));
    const double low = under ? 0.0 : std::max(0.0, middle - half), high = middle + half;
    if (!(high > low)) return 0.0;
    return integral(gauss, std::asinh(low / z), std::asinh(high / z), [&](double v) {
      const double s = z * std::sinh(v), distance = z * std::cosh(v);
      const double pressure = std::sqrt(std::max(0.0, (high - s) * (s - (middle - half)))) / a;
      return pressure * kernel(s, distance) * s * distance;  // ds = distance · dv
    });
  };
  const auto over_disk = [&](auto&& kernel_of) {
    return 2.0 * integral(gauss, 0.0, most_phi, [&](double phi) { return over_chord(phi, kernel_of(phi)); });
  };
  // Boussinesq at ν = 1/2, times 4 π G / F: inwards 1/R + z²/R³, away from the force s z / R³.
  const double inwards =
      over_disk([&](double) { return [&](double, double d) { return 1.0 / d + z * z / (d * d * d); }; });
  const double outwards = over_disk([&](double phi) {
    return [&, cosine = std::cos(phi)](double s, double d) { return cosine * s * z / (d * d * d); };
  });
  // In the middle of the skin the sum of 1/R is π² a / 2, and there the displacement is the depth.
  const double scale = contact.depth_mm / (0.5 * std::numbers::pi * std::numbers::pi * a);
  return {outwards * scale, inwards * scale};
}

}  // namespace seldinger::measure
