// The torso's solid organs and great vessels: liver, gallbladder, spleen, pancreas, kidneys, aorta, vena cava.
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

using Tree = std::vector<std::vector<Knot>>;

// Radii: main portal vein 13 mm and hepatic veins 9 mm across near the vena cava, thinning towards the margin.
const Tree& portal_tree() {
  static const Tree tree{
      {{{-2.0, -2.0, 4.0}, 6.5},
       {{-20.0, -3.0, 24.0}, 6.5},
       {{-38.0, -6.0, 40.0}, 6.0},
       {{-54.0, -3.0, 46.0}, 5.0}},
      {{{-54.0, -3.0, 46.0}, 5.0},
       {{-76.0, -16.0, 55.0}, 3.8},
       {{-98.0, -28.0, 60.0}, 2.6},
       {{-114.0, -34.0, 62.0}, 1.5}},
      {{{-76.0, -16.0, 55.0}, 3.2}, {{-84.0, -34.0, 42.0}, 2.2}, {{-90.0, -48.0, 32.0}, 1.4}},
      {{{-76.0, -16.0, 55.0}, 3.0}, {{-80.0, -30.0, 76.0}, 2.2}, {{-86.0, -36.0, 94.0}, 1.4}},
      {{{-54.0, -3.0, 46.0}, 4.8},
       {{-74.0, 14.0, 42.0}, 3.6},
       {{-96.0, 24.0, 36.0}, 2.4},
       {{-112.0, 24.0, 28.0}, 1.4}},
      {{{-74.0, 14.0, 42.0}, 2.8}, {{-88.0, 30.0, 62.0}, 2.2}, {{-98.0, 32.0, 82.0}, 1.4}},
      {{{-38.0, -6.0, 40.0}, 4.8},
       {{-18.0, -24.0, 58.0}, 4.2},
       {{-6.0, -44.0, 66.0}, 3.4},
       {{-4.0, -58.0, 62.0}, 2.0}},
      {{{-8.0, -38.0, 64.0}, 3.0}, {{18.0, -40.0, 72.0}, 2.2}, {{42.0, -40.0, 76.0}, 1.4}},
  };
  return tree;
}

const Tree& hepatic_tree() {
  static const Tree tree{
      {{{-22.0, 18.0, 100.0}, 5.0},
       {{-50.0, 16.0, 92.0}, 4.5},
       {{-78.0, 6.0, 76.0}, 3.6},
       {{-98.0, 0.0, 48.0}, 2.8},
       {{-106.0, -6.0, 18.0}, 1.6}},
      {{{-78.0, 6.0, 76.0}, 2.6}, {{-102.0, 8.0, 80.0}, 2.0}, {{-116.0, 6.0, 76.0}, 1.4}},
      {{{-22.0, 14.0, 100.0}, 4.5},
       {{-42.0, -12.0, 88.0}, 4.0},
       {{-54.0, -34.0, 66.0}, 3.0},
       {{-60.0, -50.0, 44.0}, 1.6}},
      {{{-20.0, 12.0, 99.0}, 4.2},
       {{2.0, -14.0, 90.0}, 3.4},
       {{28.0, -34.0, 82.0}, 2.2},
       {{46.0, -42.0, 78.0}, 1.4}},
  };
  return tree;
}

struct Kidney {
  double side;
  double z_mm;
};
constexpr Kidney kKidneys[] = {{-1.0, -24.0}, {1.0, -8.0}};
constexpr double kNormalCalyx_mm = 4.0, kDilatedCalyx_mm = 7.5;

// Upper pole medial and towards the back, lower pole lateral and towards the front: three lenses, since ellipsoids
// do not tilt. 108 mm long.
void add_kidney(Shapes& shapes, const Kidney& kidney, Calyces calyces) {
  const auto at = [&](double x_mm, double y_mm, double dz_mm) {
    return glm::dvec3(kidney.side * x_mm, y_mm, kidney.z_mm + dz_mm);
  };
  const auto lens = [&](const Tissue& tissue, const glm::dvec3& center_mm, const glm::dvec3& radii_mm,
                        const Over& over) {
    add(shapes, tissue, Ellipsoid{center_mm, radii_mm}, over);
  };
  const glm::dvec3 fat_mm{5.0, 5.0, 6.0};
  const struct {
    glm::dvec3 center_mm, radii_mm;
  } lobes[] = {{at(57.0, 44.0, 22.0), {24.0, 22.0, 32.0}},
               {at(63.0, 42.0, 0.0), {27.0, 24.0, 36.0}},
               {at(68.0, 39.0, -22.0), {25.0, 23.0, 32.0}}};
  const Over around{kLiver.name,       kSpleen.name,     kPancreas.name,     kStomach.name, kColon.name,
                    kHepaticVein.name, kPortalVein.name, kBowelContent.name, kBowelGas.name};
  for (const auto& lobe : lobes) lens(kVisceralFat, lobe.center_mm, lobe.radii_mm + fat_mm, around);
  for (const auto& lobe : lobes) lens(kKidneyCortex, lobe.center_mm, lobe.radii_mm, {});
  const Over kidney_only{kKidneyCortex.name};
  for (const double dz_mm : {-30.0, -20.0, -8.0, 6.0, 18.0, 29.0})  // pyramids, two rows
    for (const double dy_mm : {-8.0, 8.0})
      lens(kKidneyMedulla, at(64.0 - 0.2 * dz_mm + 4.0, 41.5 + 0.09 * dz_mm + dy_mm, dz_mm), {8.0, 6.0, 5.0},
           kidney_only);
  lens(kRenalSinus, at(57.0, 42.0, 10.0), {12.0, 9.0, 20.0}, kidney_only);
  lens(kRenalSinus, at(57.0, 41.0, -6.0), {13.0, 10.0, 22.0}, kidney_only);
  lens(kRenalSinus, at(44.0, 38.0, 0.0), {14.0, 9.0, 15.0}, kidney_only);

  // Opacified calyces are normal ones filled with contrast.
  const Tissue& urine = calyces == Calyces::opacified ? kOpacifiedUrine : kUrine;
  const double lower_mm = calyces == Calyces::dilated ? kDilatedCalyx_mm : kNormalCalyx_mm;
  const glm::dvec3 pelvis_mm = at(48.0, 38.0, -3.0);
  lens(urine, pelvis_mm, {9.0, 6.0, 10.0}, {});
  const struct {
    glm::dvec3 center_mm;
    double radius_mm;
  } ends[] = {{at(60.0, 44.0, 26.0), kNormalCalyx_mm},
              {at(67.0, 42.0, -1.0), kNormalCalyx_mm},
              {at(68.0, 40.0, -26.0), lower_mm}};
  for (const auto& end : ends) {
    add(shapes, urine, Sphere{end.center_mm, end.radius_mm});
    add_tube(shapes, urine, {{pelvis_mm, 3.5}, {end.center_mm, 2.2}});
  }
  add_tube(shapes, urine,
           {{at(44.0, 37.0, -10.0), 3.5},
            {at(41.0, 28.0, -26.0), 2.2},
            {at(38.0, 18.0, -60.0), 2.0},
            {at(36.0, 8.0, -110.0), 2.0},
            {at(42.0, 0.0, -160.0), 2.0}});
}

}  // namespace

void add_liver(Shapes& shapes) {
  const Over inside{kVisceralFat.name}, liver{kLiver.name};
  constexpr Ellipsoid kLobes[] = {
      {{-72.0, -3.0, 50.0}, {66.0, 74.0, 70.0}},   // right, up to the dome
      {{-62.0, -24.0, 64.0}, {60.0, 56.0, 50.0}},  // its front
      {{-92.0, -4.0, -2.0}, {44.0, 56.0, 52.0}},   // right, its lower tip
      {{-30.0, -36.0, 62.0}, {56.0, 44.0, 46.0}},  // middle
      {{20.0, -40.0, 72.0}, {52.0, 30.0, 30.0}},   // left
      {{-18.0, 14.0, 64.0}, {20.0, 20.0, 28.0}},   // caudate
  };
  for (const Ellipsoid& lobe : kLobes) add(shapes, kLiver, lobe, inside);
  add(shapes, kVisceralFat, Ellipsoid{{-30.0, -8.0, 22.0}, {22.0, 13.0, 18.0}}, liver);  // the hilum
  add(shapes, kVisceralFat, Ellipsoid{{4.0, -66.0, 52.0}, {2.5, 22.0, 24.0}}, liver);    // the falciform fissure
  for (const std::vector<Knot>& branch : hepatic_tree()) add_tube(shapes, kHepaticVein, branch, liver);
  const Over portal{kLiver.name, kVisceralFat.name, kHepaticVein.name};
  for (const std::vector<Knot>& branch : portal_tree()) add_tube(shapes, kPortalVein, branch, portal);
  for (const Ellipsoid& part :
       {Ellipsoid{{-44.0, -34.0, 16.0}, {12.0, 15.0, 20.0}}, Ellipsoid{{-50.0, -46.0, -6.0}, {14.0, 15.0, 24.0}}})
    add(shapes, kGallbladder, part, {kLiver.name, kVisceralFat.name});
}

void add_upper_abdomen(Shapes& shapes) {
  const Over inside{kVisceralFat.name};
  for (const Ellipsoid& part :
       {Ellipsoid{{104.0, 34.0, 58.0}, {27.0, 38.0, 46.0}}, Ellipsoid{{98.0, 44.0, 38.0}, {26.0, 28.0, 40.0}}})
    add(shapes, kSpleen, part, inside);
  add(shapes, kVisceralFat, Ellipsoid{{76.0, 28.0, 52.0}, {12.0, 12.0, 22.0}}, {kSpleen.name});  // its hilum
  add_tube(shapes, kPancreas,
           {{{-30.0, -6.0, -22.0}, 13.0},
            {{-22.0, -12.0, -6.0}, 13.0},
            {{4.0, -22.0, 8.0}, 9.0},
            {{34.0, -12.0, 20.0}, 10.0},
            {{62.0, 10.0, 34.0}, 9.0},
            {{78.0, 22.0, 42.0}, 7.0}},
           inside);
  add_tube(
      shapes, kVein,
      {{{-2.0, -2.0, 4.0}, 4.5}, {{30.0, 0.0, 20.0}, 4.2}, {{58.0, 20.0, 36.0}, 3.8}, {{78.0, 28.0, 50.0}, 3.2}},
      {kVisceralFat.name, kPancreas.name});  // splenic
  for (const double side : {-1.0, 1.0})
    add_tube(shapes, kAdrenal,
             {{{side * 34.0, 26.0, 34.0}, 2.2}, {{side * 38.0, 36.0, 38.0}, 2.5}, {{side * 40.0, 46.0, 42.0}, 2.0}},
             inside);
}

void add_kidneys(Shapes& shapes, Calyces calyces) {
  for (const Kidney& kidney : kKidneys) add_kidney(shapes, kidney, calyces);
}

void add_great_vessels(Shapes& shapes) {
  const Over open{kLung.name,  kPleuralRecess.name, kVisceralFat.name, kDiaphragm.name,  kMuscle.name,
                  kLiver.name, kPancreas.name,      kHeart.name,       kSmallBowel.name, kBowelContent.name};
  // Veins first: the left renal vein passes in front of the aorta, the right common iliac artery before the veins.
  add_tube(shapes, kVenaCava,
           {{{-18.0, 16.0, -126.0}, 10.0},
            {{-19.0, 9.0, -60.0}, 10.5},
            {{-20.0, 11.0, 0.0}, 11.0},
            {{-22.0, 15.0, 60.0}, 11.5},
            {{-22.0, 16.0, 100.0}, 12.0},
            {{-14.0, -6.0, 136.0}, 12.0}},
           open);
  for (const double side : {-1.0, 1.0})
    add_tube(shapes, kVein,
             {{{-18.0 + side * 4.0, 16.0, -126.0}, 8.0},
              {{-6.0 + side * 26.0, 22.0, -150.0}, 7.5},
              {{side * 44.0, 26.0, -180.0}, 7.0}},
             open);
  add_tube(shapes, kVein,
           {{{52.0, 34.0, -10.0}, 4.0},
            {{30.0, 12.0, -14.0}, 4.2},
            {{8.0, -6.0, -18.0}, 4.2},
            {{-16.0, 6.0, -18.0}, 4.5}},
           open);
  add_tube(shapes, kVein, {{{-48.0, 34.0, -24.0}, 4.0}, {{-32.0, 18.0, -22.0}, 4.5}, {{-20.0, 11.0, -20.0}, 4.5}},
           open);
  add_tube(shapes, kVein,
           {{{-2.0, -2.0, 4.0}, 5.0},
            {{-8.0, -16.0, -20.0}, 4.5},
            {{-10.0, -20.0, -60.0}, 4.0},
            {{-16.0, -24.0, -100.0}, 3.0}},
           open);  // superior mesenteric
  add_tube(shapes, kAorta,
           {{{14.0, 24.0, 200.0}, 12.0},
            {{13.0, 22.0, 120.0}, 11.5},
            {{8.0, 15.0, 50.0}, 10.5},
            {{7.0, 10.0, 0.0}, 9.5},
            {{7.0, 8.0, -60.0}, 8.5},
            {{4.0, 12.0, -106.0}, 8.0}},
           open);
  for (const double side : {-1.0, 1.0})
    add_tube(shapes, kArtery,
             {{{3.0 + side * 4.0, 12.0, -108.0}, 5.5},
              {{side * 24.0, 10.0, -140.0}, 5.0},
              {{side * 40.0, 14.0, -180.0}, 5.0}},
             {kVisceralFat.name, kMuscle.name, kVein.name, kVenaCava.name, kSmallBowel.name, kBowelContent.name});
  add_tube(shapes, kArtery,
           {{{8.0, 12.0, 28.0}, 3.8},
            {{6.0, -4.0, 26.0}, 3.5},
            {{-10.0, -10.0, 32.0}, 2.8},
            {{-30.0, -12.0, 34.0}, 2.4}},
           open);  // coeliac, hepatic
  add_tube(
      shapes, kArtery,
      {{{7.0, 8.0, 10.0}, 3.8}, {{6.0, -10.0, 0.0}, 3.6}, {{4.0, -20.0, -40.0}, 3.4}, {{2.0, -24.0, -100.0}, 2.4}},
      open);  // superior mesenteric
  for (const double side : {-1.0, 1.0})
    add_tube(shapes, kArtery,
             {{{7.0 + side * 6.0, 11.0, -8.0}, 2.8},
              {{side * 32.0, 24.0, -11.0}, 2.8},
              {{side * 48.0, 36.0, -15.0}, 2.4}},
             {kVisceralFat.name, kDiaphragm.name, kMuscle.name, kRenalSinus.name});
}

}  // namespace seldinger::volume::phantom
