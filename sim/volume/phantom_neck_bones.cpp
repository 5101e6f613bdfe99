// The neck's bones: vertebrae from the third cervical to the third thoracic, clavicles, sternum, first ribs.
#include <iterator>

#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

struct Level {
  double z_mm, y_mm, half_height_mm, radius_mm, transverse_mm, spinous_mm;
};
constexpr Level kLevels[] = {{393.0, 8.0, 5.8, 8.0, 24.0, 12.0},   {377.0, 8.0, 5.8, 8.0, 25.0, 12.0},
                             {361.0, 9.5, 5.8, 8.2, 26.0, 14.0},   {345.0, 13.0, 6.0, 8.5, 27.0, 18.0},
                             {328.0, 18.0, 6.6, 9.0, 31.0, 16.0},  {309.0, 25.0, 7.6, 10.0, 34.0, 14.0},
                             {288.0, 32.0, 8.2, 11.0, 32.0, 12.0}, {266.0, 38.0, 8.6, 11.5, 30.0, 12.0}};
constexpr double kColumnX_mm = 4.5;  // of a body's two columns from the midline

void add_level(Shapes& shapes, const Level& v) {
  const double canal_y_mm = v.y_mm + v.radius_mm + 6.5;
  for (const auto& [tissue, inset_mm] : {std::pair(kSpineCortex, 0.0), std::pair(kSpineMarrow, 1.5)})
    for (const double side : {-1.0, 1.0})
      add(shapes, tissue,
          Cylinder{{side * kColumnX_mm, v.y_mm, v.z_mm - v.half_height_mm + inset_mm},
                   {side * kColumnX_mm, v.y_mm, v.z_mm + v.half_height_mm - inset_mm},
                   v.radius_mm - inset_mm});
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x_mm, double y_mm, double dz_mm) {
      return glm::dvec3(side * x_mm, y_mm, v.z_mm + dz_mm);
    };
    // Pedicle and lamina, joints above and below, transverse process.
    add_bone(shapes, kSpineCortex, kSpineMarrow,
             {{at(11.0, v.y_mm + 5.0, 1.0), 3.4},
              {at(14.0, canal_y_mm, 0.0), 3.6},
              {at(9.0, canal_y_mm + 8.0, -2.0), 2.8},
              {at(0.0, canal_y_mm + 11.5, -4.0), 3.0}},
             1.2);
    add_bone(shapes, kSpineCortex, kSpineMarrow,
             {{at(16.0, canal_y_mm, 7.0), 4.2}, {at(16.5, canal_y_mm + 3.0, -7.0), 4.2}}, 1.2);
    add_tube(shapes, kSpineCortex,
             {{at(14.0, v.y_mm + 3.0, 0.0), 3.0}, {at(v.transverse_mm, v.y_mm + 6.0, -2.0), 2.8}});
  }
  add_bone(shapes, kSpineCortex, kSpineMarrow,
           {{{0.0, canal_y_mm + 11.0, v.z_mm - 4.0}, 3.2},
            {{0.0, canal_y_mm + 11.0 + v.spinous_mm, v.z_mm - 6.0 - 0.3 * v.spinous_mm}, 2.6}},
           1.2);
}

}  // namespace

void add_neck_bones(Shapes& shapes) {
  for (std::size_t i = 0; i < std::size(kLevels); ++i) {
    const Level& v = kLevels[i];
    const double next_z_mm = i + 1 < std::size(kLevels) ? kLevels[i + 1].z_mm : v.z_mm - 24.0;
    for (const double side : {-1.0, 1.0})
      add(shapes, kDisc,
          Cylinder{{side * kColumnX_mm, v.y_mm + 1.0, next_z_mm},
                   {side * kColumnX_mm, v.y_mm, v.z_mm},
                   v.radius_mm - 0.6});
  }
  for (const Level& v : kLevels) add_level(shapes, v);
  std::vector<Knot> canal{{{0.0, 23.0, 412.0}, 6.5}};
  for (const Level& v : kLevels) canal.push_back({{0.0, v.y_mm + v.radius_mm + 7.0, v.z_mm}, 6.5});
  add_tube(shapes, kSpinalCanal, canal);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x_mm, double y_mm, double z_mm) { return glm::dvec3(side * x_mm, y_mm, z_mm); };
    add_bone(shapes, kRibCortex, kRibMarrow,  // the first
             {{at(17.0, 32.0, 304.0), 4.0},
              {at(46.0, 40.0, 308.0), 4.2},
              {at(76.0, 16.0, 300.0), 4.5},
              {at(72.0, -20.0, 285.0), 4.5},
              {at(40.0, -50.0, 268.0), 4.5},
              {at(22.0, -58.0, 262.0), 4.5}},
             1.5);
    add_bone(shapes, kRibCortex, kRibMarrow,  // and the second
             {{at(19.0, 40.0, 284.0), 4.5},
              {at(56.0, 56.0, 288.0), 4.5},
              {at(94.0, 40.0, 276.0), 5.0},
              {at(106.0, 4.0, 256.0), 5.0},
              {at(100.0, -20.0, 240.0), 5.0}},
             1.5);
    add_bone(shapes, kClavicleCortex, kClavicleMarrow,
             {{at(16.0, -51.0, 285.0), 8.5},
              {at(30.0, -48.0, 288.0), 6.5},
              {at(60.0, -37.0, 293.0), 5.8},
              {at(92.0, -12.0, 293.0), 5.8},
              {at(120.0, 8.0, 286.0), 6.5},
              {at(136.0, 14.0, 278.0), 7.0}},
             1.8);
    // Manubrium: strands side by side.
    for (const double x_mm : {6.0, 16.0})
      add_bone(shapes, kClavicleCortex, kClavicleMarrow,
               {{at(x_mm, -52.0, 276.0), 6.0}, {at(x_mm, -66.0, 248.0), 6.0}}, 1.5);
  }
}

}  // namespace seldinger::volume::phantom
