// The neck: from the sternum's upper end to below the jaw. Jugular veins with their valves, lateral to the carotids
// and nearer to the skin, under the sternocleidomastoids; airway, thyroid, muscles; its bones are
// phantom_neck_bones'.
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

constexpr double kNeckSkin_mm = 2.0;
constexpr double kNeckFat_mm = 7.5;

// Neck and chest as lenses, the slope from neck to shoulder as a tube: all inset alike.
void add_neck_layer(Shapes& shapes, const Tissue& tissue, double inset_mm) {
  for (const Ellipsoid& lobe :
       {Ellipsoid{{0.0, 12.0, 330.0}, {63.0, 64.0, kTall_mm}}, Ellipsoid{{0.0, 10.0, 232.0}, {168.0, 95.0, 98.0}}})
    add(shapes, tissue, Ellipsoid{lobe.center_mm, lobe.radii_mm - inset_mm});
  for (const double side : {-1.0, 1.0})
    add_tube(shapes, tissue,
             {{{side * 14.0, 26.0, 420.0}, 43.0 - inset_mm},
              {{side * 16.0, 30.0, 368.0}, 41.0 - inset_mm},
              {{side * 24.0, 36.0, 340.0}, 37.0 - inset_mm},
              {{side * 46.0, 36.0, 318.0}, 36.0 - inset_mm},
              {{side * 80.0, 30.0, 294.0}, 40.0 - inset_mm},
              {{side * 112.0, 26.0, 264.0}, 50.0 - inset_mm},
              {{side * 116.0, 24.0, 230.0}, 50.0 - inset_mm}});
}

// What of it is fat: round vessels and airway, between the muscles, in the chest.
void add_neck_spaces(Shapes& shapes) {
  const Over muscle{kMuscle.name};
  add(shapes, kVisceralFat, Ellipsoid{{0.0, -16.0, 345.0}, {42.0, 22.0, 120.0}}, muscle);
  add(shapes, kVisceralFat, Ellipsoid{{0.0, -8.0, 250.0}, {44.0, 54.0, 56.0}}, muscle);
  for (const double side : {-1.0, 1.0}) {
    // Above the clavicle, between sternocleidomastoid and trapezius.
    add_tube(
        shapes, kVisceralFat,
        {{{side * 56.0, 6.0, 352.0}, 5.0}, {{side * 60.0, -6.0, 326.0}, 10.0}, {{side * 72.0, -14.0, 308.0}, 13.0}},
        muscle);
    add_tube(
        shapes, kFat,  // under the trapezius
        {{{side * 22.0, 52.0, 394.0}, 1.6}, {{side * 42.0, 46.0, 346.0}, 1.6}, {{side * 84.0, 44.0, 300.0}, 2.0}},
        muscle);
  }
}

void add_neck_muscles(Shapes& shapes, double side) {
  const auto at = [&](double x_mm, double y_mm, double z_mm) { return glm::dvec3(side * x_mm, y_mm, z_mm); };
  const Over fat{kVisceralFat.name, kFat.name};
  const auto strap = [&](const std::vector<Knot>& knots) { add_tube(shapes, kMuscle, knots, fat); };
  // Sternocleidomastoid: three strands side by side make it flat.
  for (const double beside : {-1.0, 0.0, 1.0})
    strap({{at(52.0 + 2.0 * beside, 4.0 + 8.0 * beside, 410.0), 5.0},
           {at(46.0 + 5.0 * beside, -16.0 + 6.0 * beside, 372.0), 4.6},
           {at(37.0 + 7.0 * beside, -28.5 + 3.5 * beside, 338.0), 4.2},
           {at(29.0 + 9.0 * beside, -39.0 + 3.0 * beside, 306.0), 4.0},
           {at(23.0 + 9.0 * beside, -50.0 + 2.0 * beside, 290.0), 3.6}});
  // The straps before the airway, the scalenes, the longus colli.
  strap({{at(9.0, -39.0, 380.0), 3.4}, {at(10.0, -40.5, 345.0), 3.4}, {at(12.0, -42.0, 300.0), 3.4}});
  strap({{at(17.0, -37.5, 362.0), 2.8}, {at(18.0, -37.0, 338.0), 2.8}, {at(17.0, -41.0, 300.0), 3.0}});
  strap({{at(27.0, 8.0, 372.0), 5.0}, {at(36.0, 0.0, 334.0), 7.0}, {at(48.0, -10.0, 300.0), 7.0}});
  strap({{at(34.0, 14.0, 372.0), 7.0}, {at(44.0, 12.0, 334.0), 9.0}, {at(58.0, 8.0, 304.0), 9.0}});
  strap({{at(8.0, 0.0, 400.0), 5.0}, {at(9.0, 2.0, 345.0), 5.5}, {at(11.0, 16.0, 300.0), 5.0}});
}

// Pharynx, larynx, trachea with its rings, oesophagus; the thyroid on both sides, joined below the cricoid.
void add_airway(Shapes& shapes) {
  const Over inside{kVisceralFat.name, kMuscle.name};
  add_tube(
      shapes, kOesophagus,
      {{{0.0, -6.0, 400.0}, 8.0}, {{2.0, -10.0, 345.0}, 6.5}, {{4.0, 4.0, 300.0}, 6.5}, {{4.0, 16.0, 255.0}, 6.5}},
      inside);
  add(shapes, kBowelGas, Ellipsoid{{3.0, -4.0, 318.0}, {2.2, 1.6, 6.0}}, {kOesophagus.name});
  const std::vector<Knot> trachea{{{0.0, -25.0, 352.0}, 10.5},
                                  {{0.0, -25.0, 334.0}, 10.5},
                                  {{0.0, -16.0, 304.0}, 10.5},
                                  {{0.0, -4.0, 272.0}, 10.5},
                                  {{0.0, 2.0, 250.0}, 10.5}};
  add_tube(shapes, kAirwayCartilage, trachea, {kVisceralFat.name, kMuscle.name, kOesophagus.name});
  // The larynx: two plates that meet in front, the ring below them, the hyoid above.
  add(shapes, kThroatMuscle, Ellipsoid{{0.0, -22.0, 366.0}, {17.0, 14.0, 22.0}}, inside);
  for (const double side : {-1.0, 1.0}) {
    for (double z_mm = 355.0; z_mm <= 375.0; z_mm += 2.5)
      add_tube(shapes, kAirwayCartilage,
               {{{0.0, -39.5, z_mm}, 1.8}, {{side * 10.0, -30.0, z_mm}, 1.6}, {{side * 18.0, -16.0, z_mm}, 1.6}},
               {kVisceralFat.name, kMuscle.name, kThroatMuscle.name});
    add_tube(shapes, kHyoid,
             {{{0.0, -37.0, 388.0}, 3.0}, {{side * 14.0, -28.0, 389.0}, 2.4}, {{side * 20.0, -10.0, 392.0}, 1.8}},
             {kVisceralFat.name, kMuscle.name});
  }
  std::vector<Knot> lumen{{{0.0, -18.0, 410.0}, 9.0}, {{0.0, -20.0, 384.0}, 8.0}, {{0.0, -23.0, 366.0}, 6.0}};
  for (Knot knot : trachea) {
    knot.radius_mm -= 1.8;
    lumen.push_back(knot);
  }
  add_tube(shapes, kAirway, lumen);
  const Over beside{kVisceralFat.name, kMuscle.name, kOesophagus.name};
  for (const double side : {-1.0, 1.0})
    for (const Ellipsoid& part : {Ellipsoid{{side * 15.0, -20.0, 334.0}, {7.0, 11.0, 17.0}},
                                  Ellipsoid{{side * 16.0, -19.0, 346.0}, {6.0, 9.0, 17.0}}})
      add(shapes, kThyroid, part, beside);
  add_tube(shapes, kThyroid,
           {{{-11.0, -32.5, 331.0}, 3.4}, {{0.0, -37.0, 331.0}, 2.8}, {{11.0, -32.5, 331.0}, 3.4}}, beside);
}

// The right jugular is the wider one, as in most people.
void add_neck_vessels(Shapes& shapes, double side) {
  const auto at = [&](double x_mm, double y_mm, double z_mm) { return glm::dvec3(side * x_mm, y_mm, z_mm); };
  const Over open{kVisceralFat.name, kMuscle.name, kFat.name, kThyroid.name, kLung.name, kOesophagus.name};
  const double jugular_mm = side < 0.0 ? 6.5 : 5.5;
  add_tube(shapes, kJugular,
           {{at(37.0, -4.0, 410.0), 0.85 * jugular_mm},
            {at(35.5, -12.0, 376.0), 0.95 * jugular_mm},
            {at(33.5, -18.0, 345.0), jugular_mm},
            {at(31.5, -22.0, 322.0), 1.05 * jugular_mm},
            {at(29.0, -28.0, 300.0), 1.1 * jugular_mm}},
           open);
  add_valve(shapes, kJugular, at(30.2, -25.6, 309.0), 1.05 * jugular_mm);
  add_tube(shapes, kVein,
           {{at(29.0, -28.0, 300.0), 6.5}, {at(52.0, -26.0, 297.0), 6.0}, {at(92.0, -8.0, 290.0), 5.5}},
           open);  // subclavian
  if (side < 0.0)
    add_tube(shapes, kVein, {{at(29.0, -28.0, 300.0), 7.5}, {at(24.0, -24.0, 252.0), 8.0}}, open);
  else
    add_tube(shapes, kVein,
             {{at(29.0, -28.0, 300.0), 7.0}, {at(4.0, -34.0, 280.0), 7.0}, {at(-22.0, -26.0, 264.0), 7.5}}, open);
  add_tube(shapes, kVein,  // external jugular, over the sternocleidomastoid
           {{at(50.0, -19.0, 385.0), 1.8}, {at(51.0, -20.0, 350.0), 1.8}, {at(53.0, -18.0, 305.0), 2.2}},
           {kFat.name, kMuscle.name, kVisceralFat.name});
  add_tube(shapes, kCarotid,
           {{at(16.0, 0.0, 262.0), 3.8},
            {at(22.0, -6.0, 306.0), 3.5},
            {at(24.0, -11.0, 340.0), 3.4},
            {at(26.0, -9.0, 372.0), 4.2}},
           open);
  add_tube(shapes, kCarotid, {{at(26.0, -9.0, 372.0), 3.2}, {at(30.0, 0.0, 410.0), 2.6}}, open);
  add_tube(shapes, kCarotid, {{at(26.0, -9.0, 372.0), 2.8}, {at(24.0, -16.0, 410.0), 2.2}}, open);
  add_tube(shapes, kArtery,  // subclavian, behind the anterior scalene
           {{at(16.0, 0.0, 270.0), 5.0},
            {at(34.0, -4.0, 300.0), 4.5},
            {at(54.0, -2.0, 302.0), 4.2},
            {at(94.0, 4.0, 288.0), 4.0}},
           open);
  add_tube(shapes, kNerve,
           {{at(29.5, -10.5, 400.0), 1.4}, {at(28.6, -8.5, 345.0), 1.4}, {at(26.0, -14.0, 300.0), 1.4}},
           {kVisceralFat.name, kMuscle.name});  // vagus
  for (const double up_mm : {0.0, 9.0, 18.0})   // the brachial plexus, between the scalenes
    add_tube(shapes, kNerve,
             {{at(24.0, 12.0, 348.0 + up_mm), 1.6},
              {at(42.0, 3.0, 324.0 + 0.6 * up_mm), 1.8},
              {at(62.0, -2.0, 308.0 + 0.4 * up_mm), 1.8}},
             {kVisceralFat.name, kMuscle.name});
  for (const glm::dvec3& node : {at(47.0, -6.0, 366.0), at(50.0, -4.0, 344.0), at(44.0, -8.0, 384.0)})
    add(shapes, kLymphNode, Ellipsoid{node, {3.0, 3.0, 5.0}}, {kMuscle.name, kVisceralFat.name});
}

}  // namespace

void add_neck(Shapes& shapes, double less_fat_mm) {
  add_neck_layer(shapes, kSkin, less_fat_mm);
  add_neck_layer(shapes, kFat, less_fat_mm + kNeckSkin_mm);
  add_neck_layer(shapes, kMuscle, kNeckSkin_mm + kNeckFat_mm);
  add_neck_spaces(shapes);
  for (const double side : {-1.0, 1.0})
    add(shapes, kLung, Ellipsoid{{side * 46.0, 12.0, 260.0}, {35.0, 44.0, 50.0}},
        {kMuscle.name, kVisceralFat.name});
  for (const double side : {-1.0, 1.0}) add_neck_muscles(shapes, side);
  add_airway(shapes);
  add_neck_bones(shapes);
  for (const double side : {-1.0, 1.0}) add_neck_vessels(shapes, side);
}

}  // namespace seldinger::volume::phantom
