// The groin's bones: hip bones with their sockets, sacrum, femora.
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

constexpr double kHipCortex_mm = 2.0;
const Over kAroundHip{kMuscle.name, kFat.name, kVisceralFat.name};

// The wing is what two balls, one inside the other, leave between them: a curved plate, open towards belly and
// midline. The inner one holds the iliacus.
void add_wing(Shapes& shapes, double side) {
  const Ellipsoid outer{{side * 58.0, 2.0, -168.0}, {72.0, 72.0, 66.0}};
  const Ellipsoid inner{{side * 46.0, -9.0, -160.0}, {74.0, 73.0, 67.0}};
  add(shapes, kPelvisCortex, outer, kAroundHip);
  add(shapes, kPelvisMarrow, Ellipsoid{outer.center_mm, outer.radii_mm - kHipCortex_mm}, {kPelvisCortex.name});
  add(shapes, kPelvisCortex, Ellipsoid{inner.center_mm, inner.radii_mm + kHipCortex_mm}, {kPelvisMarrow.name});
  add(shapes, kMuscle, inner, {kPelvisCortex.name, kPelvisMarrow.name});
}

void add_hip(Shapes& shapes, double side) {
  const auto at = [&](double x_mm, double y_mm, double z_mm) { return glm::dvec3(side * x_mm, y_mm, z_mm); };
  const glm::dvec3 head_mm = at(88.0, 2.0, -238.0);
  // Body of the ilium above the socket, ischium, pubis.
  add_bone(shapes, kPelvisCortex, kPelvisMarrow,
           {{at(104.0, 18.0, -190.0), 9.0}, {at(96.0, 12.0, -208.0), 15.0}, {at(84.0, 10.0, -222.0), 20.0}},
           kHipCortex_mm);
  add_bone(shapes, kPelvisCortex, kPelvisMarrow,
           {{at(74.0, 26.0, -236.0), 14.0}, {at(70.0, 40.0, -264.0), 12.0}, {at(62.0, 44.0, -292.0), 14.0}},
           kHipCortex_mm);
  add_bone(shapes, kPelvisCortex, kPelvisMarrow,
           {{at(68.0, -12.0, -238.0), 10.0}, {at(44.0, -32.0, -246.0), 7.0}, {at(16.0, -38.0, -254.0), 9.0}},
           kHipCortex_mm);
  add_bone(shapes, kPelvisCortex, kPelvisMarrow, {{at(12.0, -38.0, -254.0), 8.5}, {at(11.0, -34.0, -280.0), 8.0}},
           kHipCortex_mm);
  add_bone(shapes, kPelvisCortex, kPelvisMarrow,
           {{at(13.0, -32.0, -282.0), 6.5}, {at(34.0, 2.0, -296.0), 5.5}, {at(56.0, 36.0, -298.0), 8.0}},
           kHipCortex_mm);
  // The socket: a ball that lies deeper than the head, so that its cup is open outwards and downwards.
  add_bone(shapes, kPelvisCortex, kPelvisMarrow, Ellipsoid{head_mm + at(-5.0, 3.0, 5.0), {33.0, 33.0, 33.0}},
           kHipCortex_mm);
  add(shapes, kPelvisCortex, Sphere{head_mm, 28.5}, {kPelvisMarrow.name});
  add(shapes, kJoint, Sphere{head_mm, 26.5}, {kPelvisCortex.name, kMuscle.name, kPelvisMarrow.name});
  add_bone(shapes, kFemurCortex, kFemurMarrow,
           {{at(104.0, 8.0, -250.0), 16.0}, {at(122.0, 16.0, -262.0), 17.0}, {at(130.0, 20.0, -278.0), 17.0}},
           kHipCortex_mm);
  add_bone(shapes, kFemurCortex, kFemurMarrow, Ellipsoid{at(140.0, 24.0, -252.0), {13.0, 17.0, 20.0}},
           kHipCortex_mm);
  add_bone(shapes, kFemurCortex, kFemurMarrow, Ellipsoid{at(116.0, 34.0, -296.0), {9.0, 8.0, 11.0}}, kHipCortex_mm);
  add_bone(shapes, kFemurCortex, kFemurShaftMarrow,
           {{at(130.0, 20.0, -280.0), 16.0}, {at(125.0, 16.0, -310.0), 14.5}, {at(120.0, 12.0, -350.0), 14.0}},
           6.0);
  add_bone(shapes, kFemurCortex, kFemurMarrow, Ellipsoid{head_mm, {24.0, 24.0, 24.0}}, kHipCortex_mm);
  // Neck and head are one: no plate of cortex lies between them.
  add_tube(shapes, kFemurMarrow, {{head_mm, 14.0}, {at(106.0, 9.0, -250.0), 13.0}, {at(124.0, 17.0, -263.0), 14.0}},
           {kFemurCortex.name});
}

// Five bodies that lean back and grow smaller, wings beside them with the foramina between, the coccyx.
void add_sacrum(Shapes& shapes) {
  struct Segment {
    double y_mm, z_mm, radius_mm, wing_mm;
  };
  constexpr Segment kSegments[] = {{38.0, -170.0, 18.0, 52.0},
                                   {48.0, -192.0, 15.0, 48.0},
                                   {56.0, -213.0, 12.0, 36.0},
                                   {61.0, -232.0, 10.0, 27.0},
                                   {63.0, -249.0, 8.0, 18.0}};
  for (const Segment& s : kSegments)
    for (const double side : {-1.0, 1.0})
      add_bone(shapes, kSacrumCortex, kSacrumMarrow,
               {{{side * 8.0, s.y_mm, s.z_mm}, 0.9 * s.radius_mm},
                {{side * s.wing_mm, s.y_mm + 8.0, s.z_mm - 2.0}, 0.72 * s.radius_mm}},
               kHipCortex_mm);
  for (const Segment& s : kSegments)
    add_bone(shapes, kSacrumCortex, kSacrumMarrow,
             Ellipsoid{{0.0, s.y_mm, s.z_mm}, {1.35 * s.radius_mm, 0.85 * s.radius_mm, 10.0}}, kHipCortex_mm);
  std::vector<Knot> canal;
  for (const Segment& s : kSegments) {
    canal.push_back({{0.0, s.y_mm + s.radius_mm + 3.0, s.z_mm - 3.0}, 0.4 * s.radius_mm});
    if (s.radius_mm > 8.0)  // the crest, down to the hiatus
      add_bone(shapes, kSacrumCortex, kSacrumMarrow,
               Ellipsoid{{0.0, s.y_mm + s.radius_mm + 8.0, s.z_mm - 4.0}, {9.0, 5.0, 9.0}}, kHipCortex_mm);
  }
  add_tube(shapes, kSpinalCanal, canal);
  for (std::size_t i = 0; i + 2 < std::size(kSegments); ++i)
    for (const double side : {-1.0, 1.0}) {
      const Segment &a = kSegments[i], &b = kSegments[i + 1];
      const double x_mm = side * (1.25 * b.radius_mm + 4.0), z_mm = 0.5 * (a.z_mm + b.z_mm);
      add(shapes, kFat, Cylinder{{x_mm, b.y_mm - 20.0, z_mm}, {x_mm, b.y_mm + 18.0, z_mm}, 4.0},
          {kSacrumCortex.name, kSacrumMarrow.name});
    }
  add_bone(shapes, kSacrumCortex, kSacrumMarrow,
           {{{0.0, 61.0, -258.0}, 6.0}, {{0.0, 54.0, -270.0}, 4.5}, {{0.0, 45.0, -280.0}, 3.5}}, kHipCortex_mm);
}

}  // namespace

void add_iliac_wings(Shapes& shapes) {
  for (const double side : {-1.0, 1.0}) add_wing(shapes, side);
}

void add_groin_bones(Shapes& shapes) {
  add_sacrum(shapes);
  for (const double side : {-1.0, 1.0}) add_hip(shapes, side);
  add(shapes, kDisc, Ellipsoid{{0.0, -37.0, -267.0}, {3.5, 8.0, 19.0}});  // the symphysis
}

}  // namespace seldinger::volume::phantom
