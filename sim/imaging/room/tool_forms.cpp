#include "sim/imaging/room/tool_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>
#include <vector>

#include "sim/case/gauge.h"

namespace seldinger::imaging {
namespace {

const RoomColour kSteel(0.75F, 0.75F, 0.77F), kMark(0.02F, 0.02F, 0.025F), kPlastic(0.80F, 0.81F, 0.80F);
const RoomColour kLens(0.10F, 0.11F, 0.12F), kOrientation(0.05F, 0.45F, 0.16F), kCable(0.30F, 0.31F, 0.32F);

// ISO 6009: by nominal outer diameter, as the gauge stands for it.
struct HubColour {
  int gauge;
  RoomColour colour;
};
const std::array<HubColour, 10> kHubColours = {{{16, {0.85F, 0.85F, 0.84F}},
                                                {17, {0.42F, 0.04F, 0.20F}},
                                                {18, {0.85F, 0.28F, 0.42F}},
                                                {19, {0.80F, 0.70F, 0.46F}},
                                                {20, {0.85F, 0.62F, 0.02F}},
                                                {21, {0.01F, 0.22F, 0.06F}},
                                                {22, {0.015F, 0.015F, 0.017F}},
                                                {23, {0.01F, 0.06F, 0.36F}},
                                                {24, {0.25F, 0.09F, 0.36F}},
                                                {25, {0.85F, 0.22F, 0.01F}}}};

// A cross-section of the probe: half widths along x and y at a height.
struct Section {
  double z_mm, half_x_mm, half_y_mm;
  RoomColour paint;
};

// A rounded rectangle: |x/a|⁴ + |y/b|⁴ = 1.
glm::dvec2 rounded(double angle, double half_x_mm, double half_y_mm) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double r = 1.0 / std::pow(c * c * c * c + s * s * s * s, 0.25);
  return {half_x_mm * r * c, half_y_mm * r * s};
}

}  // namespace

RoomMesh shaft_form(const cases::Instrument& instrument) {
  constexpr double kMarkMm = 1.0, kWideMarkMm = 2.5, kTipRadii = 5.0;
  const double length_mm =
      instrument.length_mm + (instrument.kind == cases::InstrumentKind::core ? instrument.throw_mm : 0.0);
  const double point_mm = std::min(kTipRadii * instrument.radius_mm, 0.2 * length_mm);
  std::vector<TurnedPart> parts;
  double z = -length_mm;
  const auto to = [&](double end, const RoomColour& paint) {
    if (end > z) parts.push_back({{1.0, z}, {1.0, end}, paint});
    z = std::max(z, end);
  };
  for (int tens = static_cast<int>(length_mm / 10.0); tens >= 1; --tens) {
    const double half_mm = 0.5 * (tens % 5 == 0 ? kWideMarkMm : kMarkMm);
    to(-10.0 * tens - half_mm, kSteel);
    to(std::min(-10.0 * tens + half_mm, -point_mm), kMark);
  }
  to(-point_mm, kSteel);
  parts.push_back({{1.0, -point_mm}, {0.0, 0.0}, kSteel});
  return turned(parts, 10);
}

RoomColour gauge_colour(double radius_mm) noexcept {
  const HubColour* best = &kHubColours.front();
  double least = 1e9;
  for (const HubColour& one : kHubColours) {
    const double away = std::abs(cases::gauge(one.gauge)->outer_mm - 2.0 * radius_mm);
    if (away >= least) continue;
    least = away;
    best = &one;
  }
  return best->colour;
}

RoomMesh hub_form(const cases::Instrument& instrument) {
  const RoomColour colour = gauge_colour(instrument.radius_mm);
  const double z = -instrument.length_mm;
  if (instrument.kind == cases::InstrumentKind::core) {
    RoomMesh mesh = turned(std::vector<TurnedPart>{{{0.0, z - 30.0}, {6.0, z - 30.0}, kPlastic},
                                                   {{6.0, z - 30.0}, {4.5, z - 4.0}, kPlastic},
                                                   {{4.5, z - 4.0}, {1.5, z}, kPlastic},
                                                   {{1.5, z}, {0.0, z}, kPlastic}},
                           16);
    mesh.append(box({-13.0, -10.0, z - 165.0}, {13.0, 10.0, z - 25.0}, 4.0, kPlastic), glm::dmat4(1.0));
    mesh.append(box({-13.5, -7.0, z - 70.0}, {13.5, 7.0, z - 40.0}, 2.0, colour), glm::dmat4(1.0));
    mesh.append(box({-5.0, 8.0, z - 110.0}, {5.0, 14.0, z - 88.0}, 2.0, colour), glm::dmat4(1.0));  // the trigger
    return mesh;
  }
  // A luer hub with the stylet's cap in it.
  return turned(std::vector<TurnedPart>{{{0.0, z - 36.0}, {3.4, z - 36.0}, colour},
                                        {{3.4, z - 36.0}, {3.6, z - 26.0}, colour},
                                        {{3.6, z - 26.0}, {2.4, z - 25.0}, colour},
                                        {{2.4, z - 25.0}, {4.2, z - 24.0}, kPlastic},
                                        {{4.2, z - 24.0}, {4.2, z - 21.5}, kPlastic},
                                        {{4.2, z - 21.5}, {3.0, z - 21.0}, kPlastic},
                                        {{3.0, z - 21.0}, {2.6, z - 8.0}, colour},
                                        {{2.6, z - 8.0}, {1.2, z - 1.0}, colour},
                                        {{1.2, z - 1.0}, {0.3, z}, colour}},
                20);
}

RoomMesh probe_form(const Probe& probe) {
  const bool curved = probe.radius_mm > 0.0;
  const double arc_mm = probe.elements * probe.pitch_mm;
  const double face_mm = curved ? probe.radius_mm * std::sin(0.5 * arc_mm / probe.radius_mm) : 0.5 * arc_mm;
  const double a = face_mm + 4.0, b = 0.5 * probe.height_mm + 5.0;
  // How far the face is behind its middle.
  const auto bend_mm = [&](double x) {
    if (!curved) return 0.0;
    const double inside = std::min(std::abs(x), 0.999 * probe.radius_mm);
    return probe.radius_mm - std::sqrt(probe.radius_mm * probe.radius_mm - inside * inside);
  };
  const double edge_mm = bend_mm(a);
  // From the cable's end to the face.
  const std::vector<Section> sections = {{-150.0, 5.0, 5.0, kCable},
                                         {-140.0, 9.0, 9.0, kPlastic},
                                         {-128.0, 14.0, 12.0, kPlastic},
                                         {-110.0, 17.0, 13.5, kPlastic},
                                         {-75.0, 17.0, 13.0, kPlastic},
                                         {-52.0, 0.45 * a + 9.0, 0.5 * b + 7.0, kPlastic},
                                         {-32.0 - 0.3 * edge_mm, 0.85 * a, b + 1.0, kPlastic},
                                         {-18.0, a, b, kPlastic},
                                         {-4.0, a, b, kPlastic},
                                         {-3.9, a, b, kLens},
                                         {-1.0, a - 0.6, b - 0.6, kLens},
                                         {-0.2, a - 2.0, b - 2.0, kLens},
                                         {0.0, a - 4.0, b - 4.0, kLens}};
  constexpr int kSides = 48;
  RoomMesh mesh;
  const auto place = [&](const Section& s, double angle) {
    const glm::dvec2 xy = rounded(angle, s.half_x_mm, s.half_y_mm);
    const double share = std::clamp((s.z_mm + 60.0) / 42.0, 0.0, 1.0);  // the handle is not bent
    return glm::dvec3(xy, s.z_mm - share * share * bend_mm(xy.x));
  };
  for (const Section& s : sections)
    for (int i = 0; i < kSides; ++i) mesh.add(place(s, 2.0 * std::numbers::pi * i / kSides), {}, s.paint);
  const auto n = static_cast<std::uint32_t>(sections.size());
  for (std::uint32_t k = 0; k + 1 < n; ++k)
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t p = k * kSides + i, q = k * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({p, q, p + kSides});
      mesh.triangles.push_back({q, q + kSides, p + kSides});
    }
  // The face, by lines across it from angle i to −i: they are straight along y, so the curve along x stays.
  const std::uint32_t ring = (n - 1) * kSides;
  const auto at = [&](int i) { return ring + static_cast<std::uint32_t>((i + kSides) % kSides); };
  for (int i = 0; i < kSides / 2; ++i) {
    if (i > 0) mesh.triangles.push_back({at(i), at(-i - 1), at(-i)});
    if (i + 1 < kSides / 2) mesh.triangles.push_back({at(i), at(i + 1), at(-i - 1)});
  }
  make_smooth(mesh);
  mesh.append(box({-a - 1.5, -1.5, -36.0 - edge_mm}, {-a + 4.0, 1.5, -16.0 - edge_mm}, 0.7, kOrientation),
              glm::dmat4(1.0));
  // The cable hangs to the side −y.
  std::vector<glm::dvec3> cable;
  for (int i = 0; i <= 10; ++i) {
    const double t = i / 10.0;
    cable.push_back({0.0, -40.0 * t * t, -147.0 - 90.0 * t + 25.0 * t * t});
  }
  mesh.append(swept(cable, 3.0, 10, kCable), glm::dmat4(1.0));
  return mesh;
}

}  // namespace seldinger::imaging
