// The torso's chest: lungs with the pleural recess below them, mediastinum, heart, diaphragm.
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

// The lungs' lower border and the recess's both fall from front to back: spheres centred high behind.
constexpr double kPleuraX_mm = 58.0, kPleuraY_mm = 60.0, kPleuraZ_mm = 215.0;
constexpr double kRecess_mm = 212.0, kLung_mm = 187.0;

// The domes under which liver, stomach and spleen lie; right, left and the central tendon, each with a front part
// that reaches the costal margin. Their equators touch the wall, so that the gap outside them closes downwards:
// that gap is lung above and recess below.
struct Dome {
  glm::dvec3 center_mm, radii_mm;
};
constexpr Dome kDomes[] = {
    {{-64.0, -2.0, 0.0}, {71.0, 80.0, 121.0}}, {{-52.0, -24.0, 58.0}, {72.0, 60.0, 52.0}},
    {{64.0, -2.0, -4.0}, {71.0, 80.0, 111.0}}, {{52.0, -24.0, 56.0}, {72.0, 60.0, 48.0}},
    {{0.0, -14.0, 12.0}, {84.0, 72.0, 86.0}},  {{0.0, -26.0, 58.0}, {70.0, 58.0, 42.0}},
};
constexpr double kDiaphragm_mm = 3.0;

}  // namespace

void add_lungs(Shapes& shapes) {
  const Over inside{kVisceralFat.name}, recess{kPleuralRecess.name}, lung{kLung.name};
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec3 center_mm{side * kPleuraX_mm, kPleuraY_mm, kPleuraZ_mm};
    add(shapes, kPleuralRecess, Sphere{center_mm, kRecess_mm}, inside);
    add(shapes, kLung, Sphere{center_mm, kLung_mm}, recess);
  }
  // Vessels of the lower lobes, from the hila above the volume.
  constexpr glm::dvec3 kLobes[] = {{50.0, 40.0, 60.0},  {80.0, 48.0, 62.0},   {105.0, 30.0, 80.0},
                                   {112.0, 0.0, 92.0},  {98.0, -30.0, 118.0}, {70.0, -50.0, 128.0},
                                   {62.0, 20.0, 118.0}, {90.0, 10.0, 120.0},  {45.0, 55.0, 110.0}};
  for (const double side : {-1.0, 1.0})
    for (const glm::dvec3& end_mm : kLobes) {
      const glm::dvec3 hilum_mm{40.0, 5.0, 190.0};
      const glm::dvec3 middle_mm = 0.5 * (hilum_mm + end_mm) + glm::dvec3(4.0, 2.0, 6.0);
      add_tube(shapes, kPulmonaryVessel,
               {{mirrored(hilum_mm, side), 5.0}, {mirrored(middle_mm, side), 2.6}, {mirrored(end_mm, side), 1.0}},
               lung);
    }
  for (const Dome& dome : kDomes)
    add(shapes, kDiaphragm, Ellipsoid{dome.center_mm, dome.radii_mm},
        {kPleuralRecess.name, kLung.name, kPulmonaryVessel.name});
  for (const Dome& dome : kDomes)
    add(shapes, kVisceralFat, Ellipsoid{dome.center_mm, dome.radii_mm - kDiaphragm_mm}, {kDiaphragm.name});
}

void add_mediastinum(Shapes& shapes) {
  const Over inside{kVisceralFat.name};
  Over chest{kPleuralRecess.name, kLung.name, kPulmonaryVessel.name};
  // Fat behind and around the heart; the domes are painted and stay.
  add(shapes, kVisceralFat, Ellipsoid{{4.0, 28.0, 190.0}, {27.0, 30.0, 190.0}}, chest);
  add(shapes, kVisceralFat, Ellipsoid{{2.0, -66.0, 165.0}, {34.0, 24.0, 80.0}}, chest);
  add(shapes, kVisceralFat, Ellipsoid{{20.0, -32.0, 152.0}, {67.0, 48.0, 64.0}}, chest);
  chest.emplace_back(kVisceralFat.name);
  add(shapes, kHeart, Ellipsoid{{8.0, -26.0, 158.0}, {44.0, 40.0, 45.0}}, chest);
  add(shapes, kHeart, Ellipsoid{{38.0, -36.0, 148.0}, {42.0, 33.0, 38.0}}, chest);
  for (const double side : {-1.0, 1.0})  // crura
    add_tube(
        shapes, kDiaphragm,
        {{{side * 20.0, 22.0, 92.0}, 4.0}, {{side * 19.0, 26.0, 45.0}, 5.5}, {{side * 15.0, 24.0, -25.0}, 3.0}},
        inside);
}

}  // namespace seldinger::volume::phantom
