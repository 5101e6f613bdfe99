// The torso's hollow organs: stomach, duodenum, colon with haustra, small bowel; gas lies in front when supine,
// behind when prone.
#include <cstdint>

#include "sim/base/rng.h"
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

const Over kFree{kVisceralFat.name};

// The wall of all parts first, then their lumen, so that neighbours join.
void add_hollow(Shapes& shapes, const Tissue& wall, const std::vector<Ellipsoid>& parts, double wall_mm,
                const Over& over) {
  for (const Ellipsoid& part : parts) add(shapes, wall, part, over);
  for (const Ellipsoid& part : parts)
    add(shapes, kBowelContent, Ellipsoid{part.center_mm, part.radii_mm - wall_mm}, {wall.name});
}

// Gas above a level, content below it: one level for all that hangs together.
void add_gas(Shapes& shapes, const Box& above) {
  add(shapes, kBowelGas, above, {kBowelContent.name});
}

void add_stomach(Shapes& shapes, bool prone) {
  const std::vector<Ellipsoid> parts{
      {{62.0, 6.0, 74.0}, {36.0, 38.0, 32.0}},   {{60.0, -14.0, 50.0}, {36.0, 34.0, 34.0}},
      {{56.0, -34.0, 26.0}, {32.0, 26.0, 30.0}}, {{42.0, -44.0, 6.0}, {28.0, 20.0, 22.0}},
      {{20.0, -46.0, -4.0}, {22.0, 16.0, 17.0}}, {{-2.0, -42.0, 2.0}, {18.0, 14.0, 14.0}},
      {{-18.0, -32.0, 8.0}, {10.0, 10.0, 10.0}}};
  add_hollow(shapes, kStomach, parts, 4.0, kFree);
  add_gas(shapes, prone ? Box{{-30.0, 12.0, -30.0}, {100.0, 60.0, 110.0}}
                        : Box{{-10.0, -80.0, -30.0}, {100.0, -36.0, 110.0}});
  // Duodenum round the pancreatic head.
  add_tube(shapes, kSmallBowel,
           {{{-26.0, -28.0, 8.0}, 11.0},
            {{-46.0, -8.0, -4.0}, 12.0},
            {{-46.0, 2.0, -34.0}, 12.0},
            {{-26.0, -2.0, -52.0}, 11.0},
            {{14.0, -10.0, -50.0}, 10.0},
            {{34.0, -16.0, -28.0}, 10.0}},
           kFree);
  add_tube(shapes, kBowelContent,
           {{{-26.0, -28.0, 8.0}, 8.0},
            {{-46.0, -8.0, -4.0}, 9.0},
            {{-46.0, 2.0, -34.0}, 9.0},
            {{-26.0, -2.0, -52.0}, 8.0},
            {{14.0, -10.0, -50.0}, 7.0},
            {{34.0, -16.0, -28.0}, 7.0}},
           {kSmallBowel.name});
}

// Haustra strung along the colon: lenses whose size alternates.
void add_colon(Shapes& shapes, bool prone) {
  const std::vector<Knot> line{
      {{-92.0, 2.0, -185.0}, 25.0},   {{-104.0, 6.0, -160.0}, 24.0}, {{-107.0, 10.0, -130.0}, 22.0},
      {{-106.0, 10.0, -102.0}, 21.0}, {{-98.0, -4.0, -78.0}, 20.0},  {{-82.0, -34.0, -70.0}, 19.0},
      {{-58.0, -52.0, -62.0}, 18.0},  {{-28.0, -58.0, -66.0}, 18.0}, {{2.0, -60.0, -64.0}, 18.0},
      {{34.0, -56.0, -56.0}, 18.0},   {{62.0, -46.0, -40.0}, 18.0},  {{88.0, -28.0, -14.0}, 18.0},
      {{106.0, -6.0, 8.0}, 18.0},     {{112.0, 10.0, -14.0}, 16.0},  {{113.0, 14.0, -46.0}, 15.0},
      {{112.0, 14.0, -80.0}, 15.0},   {{110.0, 10.0, -112.0}, 15.0}, {{106.0, 2.0, -145.0}, 16.0},
      {{96.0, -6.0, -185.0}, 16.0}};
  std::vector<Ellipsoid> parts;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    for (int half = 0; half < 2; ++half) {
      const double t = 0.5 * half;
      const double radius_mm =
          (line[i].radius_mm + (line[i + 1].radius_mm - line[i].radius_mm) * t) * (half == 0 ? 1.0 : 0.84);
      parts.push_back(
          {line[i].p_mm + (line[i + 1].p_mm - line[i].p_mm) * t, {radius_mm, 0.92 * radius_mm, 0.95 * radius_mm}});
    }
  add_hollow(shapes, kColon, parts, 3.0, kFree);
  if (prone) {  // the transverse colon is lowest, and full of content
    add_gas(shapes, {{-140.0, -2.0, -200.0}, {-80.0, 40.0, -55.0}});
    add_gas(shapes, {{86.0, -2.0, -200.0}, {140.0, 40.0, 22.0}});
  } else {
    add_gas(shapes, {{-140.0, -90.0, -95.0}, {100.0, -50.0, 0.0}});
    add(shapes, kBowelGas, Ellipsoid{{98.0, -24.0, 0.0}, {9.0, 5.0, 8.0}}, {kBowelContent.name});
    add_gas(shapes, {{-140.0, -60.0, -200.0}, {-80.0, -6.0, -91.0}});
    add_gas(shapes, {{90.0, -60.0, -75.0}, {140.0, 8.0, -42.0}});
    add_gas(shapes, {{90.0, -60.0, -165.0}, {140.0, -2.0, -108.0}});
  }
}

// Loops that wander from side to side, the jejunum in the left upper abdomen; bubbles in some.
struct LoopRow {
  double x_mm, half_width_mm, y_mm, z_mm;
};
constexpr LoopRow kLoopRows[] = {
    {56.0, 34.0, -22.0, -40.0},  {50.0, 40.0, -8.0, -62.0},   {-4.0, 62.0, 2.0, -74.0},
    {-2.0, 66.0, -47.0, -92.0},  {0.0, 72.0, -26.0, -100.0},  {4.0, 60.0, 0.0, -102.0},
    {3.0, 68.0, -48.0, -119.0},  {-3.0, 74.0, -26.0, -127.0}, {0.0, 52.0, -2.0, -128.0},
    {-2.0, 66.0, -47.0, -146.0}, {2.0, 72.0, -24.0, -154.0},  {0.0, 66.0, -48.0, -173.0},
};

void add_small_bowel(Shapes& shapes, bool prone) {
  std::uint64_t draw = 0;
  const auto jitter = [&](double by_mm) { return by_mm * (2.0 * base::uniform_at(21, draw++) - 1.0); };
  for (const LoopRow& row : kLoopRows) {
    std::vector<Knot> loop;
    for (int i = 0; i <= 6; ++i) {
      const double x_mm = row.x_mm + row.half_width_mm * (i - 3) / 3.0 + jitter(5.0);
      const double y_mm = row.y_mm + jitter(9.0), z_mm = row.z_mm + jitter(11.0);
      loop.push_back({{x_mm, y_mm, z_mm}, 11.0 + jitter(2.5)});
    }
    add_tube(shapes, kSmallBowel, loop, kFree);
    std::vector<Knot> lumen = loop;
    for (Knot& knot : lumen) knot.radius_mm -= 2.5;
    add_tube(shapes, kBowelContent, lumen, {kSmallBowel.name});
    for (const Knot& knot : lumen)
      if (base::uniform_at(22, draw++) > 0.55) {
        const double r_mm = knot.radius_mm;
        const glm::dvec3 middle_mm = knot.p_mm - glm::dvec3(0.0, prone ? -0.5 * r_mm : 0.5 * r_mm, 0.0);
        add(shapes, kBowelGas, Ellipsoid{middle_mm, {1.1 * r_mm, 0.5 * r_mm, 0.9 * r_mm}}, {kBowelContent.name});
      }
  }
}

}  // namespace

void add_bowel(Shapes& shapes, bool prone) {
  add_stomach(shapes, prone);
  add_colon(shapes, prone);
  add_small_bowel(shapes, prone);
}

}  // namespace seldinger::volume::phantom
