// The torso's wall: skin, fat and muscle layers, spine, pelvis, ribs with their bundles.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

// A trunk's section is no ellipse: a middle one and two lateral ones give flat flanks, belly and back.
struct Ellipse {
  double x_mm, y_mm, x_radius_mm, y_radius_mm;
};
constexpr std::array<Ellipse, 3> kOutline{
    {{0.0, -2.0, 168.0, 112.0}, {48.0, 6.0, 120.0, 108.0}, {-48.0, 6.0, 120.0, 108.0}}};

constexpr Inset kSkinInside{2.0, 2.0, 2.0};
constexpr Inset kMuscleOutside{22.0, 20.0, 16.0};
constexpr Inset kCavity{35.0, 32.0, 38.0};
constexpr Inset kRibLine{30.0, 27.0, 32.0};  // where ribs run inside the muscle

Ellipse inset(const Ellipse& e, const Inset& by) {
  return {e.x_mm, e.y_mm + 0.5 * (by.front_mm - by.back_mm), e.x_radius_mm - by.lateral_mm,
          e.y_radius_mm - 0.5 * (by.front_mm + by.back_mm)};
}

void add_layer(Shapes& shapes, const Tissue& tissue, const Inset& by) {
  for (const Ellipse& outline : kOutline) {
    const Ellipse e = inset(outline, by);
    add(shapes, tissue, Ellipsoid{{e.x_mm, e.y_mm, 0.0}, {e.x_radius_mm, e.y_radius_mm, kTall_mm}});
  }
}

// The point of the rib line at an angle from the back (0°) round the flank (90°) to the front (180°).
glm::dvec3 on_rib_line(double angle_deg, double side, double z_mm) {
  const double angle_rad = angle_deg * (std::numbers::pi / 180.0);
  const double dx = side * base::exact_sin(angle_rad), dy = base::exact_cos(angle_rad);
  double far_mm = 0.0;  // the union's boundary: the farthest of the ellipses along this ray from the middle
  for (const Ellipse& outline : kOutline) {
    const Ellipse e = inset(outline, kRibLine);
    const double ux = dx / e.x_radius_mm, uy = dy / e.y_radius_mm;
    const double cx = e.x_mm / e.x_radius_mm, cy = e.y_mm / e.y_radius_mm;
    const double a = ux * ux + uy * uy, b = ux * cx + uy * cy, c = cx * cx + cy * cy - 1.0;
    far_mm = std::max(far_mm, (b + std::sqrt(b * b - a * c)) / a);
  }
  return {dx * far_mm, dy * far_mm, z_mm};
}

struct Vertebra {
  double z_mm, y_mm;      // the body's middle
  double half_height_mm;  // of the body
  double half_width_mm;   // between its two overlapping columns
  double radius_mm;       // of each column
  double transverse_mm;   // half span of the transverse processes; 0: the rib takes their place
};
constexpr std::array<Vertebra, 12> kVertebrae{{
    {198.0, 51.0, 11.0, 2.0, 15.0, 0.0},
    {172.0, 50.0, 11.0, 2.0, 15.0, 0.0},  // T6, T7
    {147.0, 49.0, 10.5, 2.0, 15.5, 0.0},
    {121.0, 47.0, 11.0, 3.0, 15.5, 0.0},  // T8, T9
    {94.0, 45.0, 11.5, 4.0, 16.0, 0.0},
    {66.0, 43.0, 12.0, 4.5, 16.0, 0.0},  // T10, T11
    {36.0, 41.0, 12.5, 5.0, 16.5, 0.0},
    {3.0, 39.0, 13.5, 6.0, 16.5, 38.0},  // T12, L1
    {-32.0, 37.0, 13.5, 6.5, 17.0, 42.0},
    {-68.0, 36.0, 14.0, 7.0, 17.0, 46.0},  // L2, L3
    {-105.0, 37.0, 14.0, 7.5, 17.5, 44.0},
    {-142.0, 40.0, 14.0, 8.0, 18.0, 42.0},  // L4, L5
}};

void add_vertebra(Shapes& shapes, const Vertebra& v) {
  const double canal_y_mm = v.y_mm + v.radius_mm + 7.5;
  const auto column = [&](const Tissue& tissue, double radius_mm, double half_height_mm) {
    for (const double side : {-1.0, 1.0})
      add(shapes, tissue,
          Cylinder{{side * v.half_width_mm, v.y_mm, v.z_mm - half_height_mm},
                   {side * v.half_width_mm, v.y_mm, v.z_mm + half_height_mm},
                   radius_mm});
  };
  column(kSpineCortex, v.radius_mm, v.half_height_mm);
  column(kSpineMarrow, v.radius_mm - 2.0, v.half_height_mm - 2.0);
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](double x_mm, double y_mm, double dz_mm) {
      return glm::dvec3(side * x_mm, y_mm, v.z_mm + dz_mm);
    };
    // Pedicle, lamina, facets, transverse process.
    add_tube(shapes, kSpineCortex,
             {{at(12.0, v.y_mm + 10.0, 4.0), 5.0},
              {at(14.0, canal_y_mm + 1.0, 2.0), 5.0},
              {at(9.0, canal_y_mm + 9.0, -4.0), 4.0},
              {at(0.0, canal_y_mm + 12.0, -8.0), 4.0}});
    add_tube(shapes, kSpineCortex,
             {{at(15.0, canal_y_mm + 4.0, 14.0), 4.5}, {at(16.0, canal_y_mm + 6.0, -18.0), 5.0}});
    if (v.transverse_mm > 0.0)
      add_tube(shapes, kSpineCortex,
               {{at(15.0, canal_y_mm + 2.0, 2.0), 4.5}, {at(v.transverse_mm, canal_y_mm + 7.0, 3.0), 3.0}});
  }
  for (const double dz_mm : {-3.0, -8.0})
    add(shapes, kSpineCortex, Ellipsoid{{0.0, canal_y_mm + 19.0, v.z_mm + dz_mm - 6.0}, {3.5, 11.0, 9.0}});
  add(shapes, kSpineMarrow, Ellipsoid{{0.0, canal_y_mm + 19.0, v.z_mm - 12.0}, {1.8, 8.0, 7.0}});
}

struct Rib {
  int number;
  double head_z_mm;  // at the spine
  double drop_mm;    // from there to the rib's end
  double end_deg;    // of on_rib_line
  double neck_y_mm;  // of the head, beside the vertebra
};
constexpr double kRibStart_deg = 31.0;
constexpr std::array<Rib, 9> kRibs{{
    {4, 248.0, 70.0, 163.0, 62.0},
    {5, 223.0, 80.0, 161.0, 62.0},
    {6, 199.0, 92.0, 157.0, 61.0},
    {7, 173.0, 96.0, 150.0, 60.0},
    {8, 148.0, 101.0, 140.0, 59.0},
    {9, 122.0, 98.0, 126.0, 57.0},
    {10, 95.0, 88.0, 112.0, 55.0},
    {11, 67.0, 58.0, 88.0, 53.0},
    {12, 37.0, 32.0, 56.0, 51.0},
}};

// The rib's middle line, shifted down by below_mm.
std::vector<Knot> rib_line(const Rib& rib, double side, double below_mm) {
  std::vector<Knot> knots{{{side * 19.0, rib.neck_y_mm, rib.head_z_mm - below_mm}, 0.0},
                          {{side * 31.0, rib.neck_y_mm + 14.0, rib.head_z_mm - 1.0 - below_mm}, 0.0}};
  const int pieces = static_cast<int>((rib.end_deg - kRibStart_deg) / 6.0) + 1;
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double z_mm = rib.head_z_mm - 2.0 - (rib.drop_mm - 2.0) * t - below_mm;
    knots.push_back({on_rib_line(kRibStart_deg + (rib.end_deg - kRibStart_deg) * t, side, z_mm), 0.0});
  }
  return knots;
}

void add_costal_arch(Shapes& shapes, double side) {
  // From each rib's end (10 to 7) along the margin to the one above, the seventh to the xiphoid.
  constexpr double kXiphoid_deg = 174.0, kXiphoidZ_mm = 103.0;
  for (std::size_t i = 2; i < 7; ++i) {
    const Rib& rib = kRibs[i];
    const bool margin = rib.number >= 8;
    const double to_deg = margin ? kRibs[i - 1].end_deg : kXiphoid_deg;
    const double to_z_mm =
        margin ? kRibs[i - 1].head_z_mm - kRibs[i - 1].drop_mm : kXiphoidZ_mm + (rib.number == 6 ? 25.0 : 0.0);
    std::vector<Knot> knots;
    for (int piece = 0; piece <= 4; ++piece) {
      const double t = piece / 4.0;
      const double z_mm = rib.head_z_mm - rib.drop_mm + (to_z_mm - rib.head_z_mm + rib.drop_mm) * t;
      knots.push_back({on_rib_line(rib.end_deg + (to_deg - rib.end_deg) * t, side, z_mm), 4.5});
    }
    add_tube(shapes, kCartilage, knots);
  }
}

}  // namespace

void add_body_layers(Shapes& shapes, const Inset& less_fat) {
  add_layer(shapes, kSkin, less_fat);
  add_layer(shapes, kFat,
            {kSkinInside.lateral_mm + less_fat.lateral_mm, kSkinInside.front_mm + less_fat.front_mm,
             kSkinInside.back_mm + less_fat.back_mm});
  add_layer(shapes, kMuscle, kMuscleOutside);
  add_layer(shapes, kVisceralFat, kCavity);
}

void add_trunk_muscles(Shapes& shapes) {
  const Over inside{kVisceralFat.name}, wall{kMuscle.name};
  // The wall's seams below the ribs: linea alba, semilunar lines.
  add(shapes, kFat, Ellipsoid{{0.0, -97.0, -70.0}, {5.0, 11.5, 170.0}}, wall);
  for (const double side : {-1.0, 1.0}) {
    add(shapes, kFat, Ellipsoid{{side * 78.0, -80.0, -95.0}, {3.5, 8.0, 110.0}}, wall);
    // Erector spinae and multifidus, quadratus lumborum, psoas, iliacus.
    add(shapes, kMuscle, Ellipsoid{{side * 24.0, 85.0, 0.0}, {26.0, 14.0, kTall_mm}}, inside);
    add(shapes, kMuscle, Ellipsoid{{side * 30.0, 82.0, -120.0}, {34.0, 22.0, 170.0}}, inside);
    add(shapes, kMuscle, Ellipsoid{{side * 66.0, 68.0, -60.0}, {24.0, 9.0, 78.0}}, inside);
    add_tube(shapes, kMuscle,
             {{{side * 27.0, 46.0, 5.0}, 6.0},
              {{side * 33.0, 42.0, -35.0}, 12.0},
              {{side * 39.0, 38.0, -75.0}, 17.0},
              {{side * 46.0, 32.0, -115.0}, 21.0},
              {{side * 55.0, 22.0, -175.0}, 22.0}},
             inside);
    add(shapes, kMuscle, Ellipsoid{{side * 98.0, 40.0, -180.0}, {30.0, 34.0, 62.0}}, inside);
  }
}

void add_spine(Shapes& shapes) {
  for (const Vertebra& v : kVertebrae)
    for (const double side : {-1.0, 1.0})
      add(shapes, kDisc,
          Cylinder{{side * v.half_width_mm, v.y_mm, v.z_mm - v.half_height_mm - 11.0},
                   {side * v.half_width_mm, v.y_mm, v.z_mm},
                   v.radius_mm - 0.5});
  for (const Vertebra& v : kVertebrae) add_vertebra(shapes, v);
  add(shapes, kSpineCortex, Ellipsoid{{0.0, 47.0, -180.0}, {46.0, 20.0, 24.0}});  // the sacrum's base
  add(shapes, kSpineMarrow, Ellipsoid{{0.0, 47.0, -180.0}, {44.0, 18.0, 22.0}});
  std::vector<Knot> canal;
  for (const Vertebra& v : kVertebrae) canal.push_back({{0.0, v.y_mm + v.radius_mm + 7.0, v.z_mm}, 7.5});
  canal.push_back({{0.0, 66.0, -180.0}, 7.0});
  add_tube(shapes, kSpinalCanal, canal);
}

void add_pelvis(Shapes& shapes) {
  // The iliac wings: upright lenses side by side along the wing; z is the crest's height there.
  constexpr std::array<glm::dvec3, 14> kCrest{{{50.0, 70.0, -142.0},
                                               {58.0, 72.0, -130.0},
                                               {67.0, 72.0, -121.0},
                                               {76.0, 70.0, -115.0},
                                               {85.0, 66.0, -111.0},
                                               {93.0, 60.0, -108.0},
                                               {101.0, 53.0, -107.0},
                                               {108.0, 45.0, -107.0},
                                               {114.0, 36.0, -108.0},
                                               {119.0, 27.0, -111.0},
                                               {122.0, 17.0, -115.0},
                                               {124.0, 7.0, -121.0},
                                               {124.0, -3.0, -129.0},
                                               {122.0, -13.0, -140.0}}};
  constexpr double kMiddleZ_mm = -200.0;
  for (const double side : {-1.0, 1.0})
    for (const auto& [tissue, inset_mm] : {std::pair(kPelvisCortex, 0.0), std::pair(kPelvisMarrow, 2.0)})
      for (std::size_t i = 0; i + 1 < kCrest.size(); ++i)
        for (const double t : {0.0, 0.5}) {
          const glm::dvec3 crest = kCrest[i] + (kCrest[i + 1] - kCrest[i]) * t;
          add(shapes, tissue,
              Ellipsoid{{side * crest.x, crest.y, kMiddleZ_mm},
                        {6.0 - inset_mm, 7.0 - inset_mm, crest.z - kMiddleZ_mm - inset_mm}});
        }
}

void add_ribs(Shapes& shapes) {
  // A rib is flat: two tubes 6 mm apart, one above the other, each 7 mm thick. Its vein, artery and nerve run under
  // the lower border.
  constexpr double kHalfHeight_mm = 3.0, kCortex_mm = 3.5, kMarrow_mm = 2.0, kBundle_mm = 1.8;
  const Over wall{kMuscle.name, kVisceralFat.name};
  for (const double side : {-1.0, 1.0}) {
    for (const Rib& rib : kRibs)
      add_tube(shapes, kIntercostalBundle,
               with_radius(rib_line(rib, side, kHalfHeight_mm + kCortex_mm + 0.9 * kBundle_mm), kBundle_mm), wall);
    for (const auto& [tissue, radius_mm] : {std::pair(kRibCortex, kCortex_mm), std::pair(kRibMarrow, kMarrow_mm)})
      for (const Rib& rib : kRibs)
        for (const double below_mm : {kHalfHeight_mm, 0.0, -kHalfHeight_mm})
          add_tube(shapes, tissue, with_radius(rib_line(rib, side, below_mm), radius_mm));
    add_costal_arch(shapes, side);
  }
  add(shapes, kCartilage, Ellipsoid{{0.0, -84.0, 122.0}, {11.0, 4.5, 22.0}});  // xiphoid
  add(shapes, kRibCortex, Ellipsoid{{0.0, -84.0, 190.0}, {17.0, 6.0, 50.0}});  // sternum
  add(shapes, kRibMarrow, Ellipsoid{{0.0, -84.0, 190.0}, {15.0, 4.0, 48.0}});
}

}  // namespace seldinger::volume::phantom
