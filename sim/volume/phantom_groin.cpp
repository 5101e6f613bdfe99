// The groin: from below the iliac spines to the thighs. Femoral vessels with their valves, nerve and ligament as
// they lie before the head of the femur; about it muscles, bladder, rectum; its bones are phantom_groin_bones'.
#include "sim/volume/phantom_parts.h"

namespace seldinger::volume::phantom {
namespace {

constexpr double kGroinSkin_mm = 2.0;
constexpr double kGroinFat_mm = 14.0;  // over the muscles of thigh and buttock

// The lower belly, buttocks and thighs, as their skin runs.
std::vector<Ellipsoid> groin_outline() {
  std::vector<Ellipsoid> lobes{{{0.0, 4.0, -170.0}, {170.0, 98.0, 140.0}},
                               {{0.0, -2.0, -160.0}, {160.0, 104.0, 96.0}},
                               {{0.0, 8.0, -190.0}, {118.0, 98.0, 121.0}},
                               {{0.0, -8.0, -250.0}, {62.0, 66.0, 62.0}}};
  for (const double side : {-1.0, 1.0}) {
    lobes.push_back({{side * 86.0, 18.0, -230.0}, {88.0, 92.0, kTall_mm}});  // thigh
    lobes.push_back({{side * 84.0, 46.0, -250.0}, {88.0, 76.0, 90.0}});      // buttock
  }
  return lobes;
}

void add_groin_layers(Shapes& shapes, double less_fat_mm) {
  const auto layer = [&](const Tissue& tissue, double inset_mm) {
    for (const Ellipsoid& lobe : groin_outline())
      add(shapes, tissue, Ellipsoid{lobe.center_mm, lobe.radii_mm - inset_mm});
  };
  layer(kSkin, less_fat_mm);
  layer(kFat, less_fat_mm + kGroinSkin_mm);
  layer(kMuscle, kGroinSkin_mm + kGroinFat_mm);
}

// What is not muscle inside: the pelvis, its floor, and the seams between muscles.
void add_pelvic_inside(Shapes& shapes) {
  const Over muscle{kMuscle.name}, inside{kVisceralFat.name};
  add(shapes, kVisceralFat, Ellipsoid{{0.0, 6.0, -176.0}, {98.0, 74.0, 86.0}}, muscle);
  add(shapes, kFat, Box{{-1.5, -140.0, -400.0}, {1.5, 140.0, -290.0}}, muscle);
  for (const double side : {-1.0, 1.0}) {
    // Between gluteus and hip, beneath the gluteus maximus: seams of fat; the ischiorectal fossa.
    add(shapes, kFat, Ellipsoid{{side * 40.0, 62.0, -282.0}, {22.0, 24.0, 30.0}}, muscle);
    add_tube(shapes, kFat,
             {{{side * 70.0, 74.0, -160.0}, 2.5},
              {{side * 104.0, 66.0, -200.0}, 2.5},
              {{side * 120.0, 60.0, -250.0}, 3.0},
              {{side * 96.0, 72.0, -300.0}, 4.0},
              {{side * 78.0, 62.0, -345.0}, 4.0}},
             muscle);
    // Iliopsoas on its way over the head of the femur to the lesser trochanter.
    add_tube(shapes, kMuscle,
             {{{side * 55.0, 22.0, -150.0}, 24.0},
              {{side * 70.0, -2.0, -190.0}, 21.0},
              {{side * 92.0, -34.0, -226.0}, 15.0},
              {{side * 100.0, -26.0, -255.0}, 13.0},
              {{side * 108.0, 14.0, -292.0}, 9.0}},
             {kVisceralFat.name, kFat.name});
  }
  // Bladder, and the rectum with gas before its content.
  add(shapes, kBladderWall, Ellipsoid{{0.0, -18.0, -216.0}, {42.0, 30.0, 32.0}}, inside);
  add(shapes, kBladder, Ellipsoid{{0.0, -18.0, -216.0}, {38.5, 26.5, 28.5}}, {kBladderWall.name});
  const std::vector<Knot> rectum{{{16.0, 16.0, -158.0}, 14.0},
                                 {{4.0, 28.0, -190.0}, 17.0},
                                 {{0.0, 35.0, -222.0}, 18.0},
                                 {{0.0, 36.0, -250.0}, 13.0},
                                 {{0.0, 32.0, -282.0}, 8.0}};
  add_tube(shapes, kColon, rectum, {kVisceralFat.name, kMuscle.name});
  std::vector<Knot> lumen = rectum;
  for (Knot& knot : lumen) knot.radius_mm -= 4.0;
  add_tube(shapes, kBowelContent, lumen, {kColon.name});
  add(shapes, kBowelGas, Ellipsoid{{3.0, 22.0, -198.0}, {9.0, 6.0, 22.0}}, {kBowelContent.name});
  // Loops of the ileum above the bladder.
  for (const double y_mm : {-56.0, -30.0, -4.0}) {
    const std::vector<Knot> loop{{{-66.0, y_mm, -162.0}, 12.0},
                                 {{-28.0, y_mm + 6.0, -172.0}, 13.0},
                                 {{8.0, y_mm - 4.0, -164.0}, 12.0},
                                 {{44.0, y_mm + 4.0, -172.0}, 13.0},
                                 {{70.0, y_mm, -160.0}, 11.0}};
    add_tube(shapes, kSmallBowel, loop, inside);
    add_tube(shapes, kBowelContent, with_radius(loop, 9.0), {kSmallBowel.name});
  }
}

void add_femoral_vessels(Shapes& shapes, double side) {
  const auto at = [&](double x_mm, double y_mm, double z_mm) { return glm::dvec3(side * x_mm, y_mm, z_mm); };
  const Over through{kMuscle.name, kFat.name, kVisceralFat.name, kSmallBowel.name, kBowelContent.name};
  // The femoral triangle: what lies in it lies in fat, under the fascia.
  add_tube(shapes, kFat,
           {{at(64.0, -38.0, -206.0), 10.0},
            {at(72.0, -50.0, -236.0), 14.0},
            {at(74.0, -48.0, -266.0), 15.0},
            {at(80.0, -44.0, -300.0), 12.0},
            {at(82.0, -36.0, -345.0), 8.0}},
           {kMuscle.name});
  for (const glm::dvec3& node : {at(58.0, -56.0, -262.0), at(86.0, -60.0, -256.0), at(66.0, -59.0, -284.0)})
    add(shapes, kLymphNode, Ellipsoid{node, {4.0, 3.0, 8.0}}, {kFat.name});
  // External iliac, common femoral, then femoral and deep femoral; the vein medial, and behind below the fork.
  add_tube(shapes, kFemoralVein,
           {{at(42.0, 30.0, -158.0), 7.0},
            {at(52.0, -6.0, -190.0), 6.5},
            {at(58.0, -36.0, -218.0), 6.0},
            {at(61.5, -43.5, -240.0), 6.0},
            {at(64.0, -42.0, -264.0), 5.5},
            {at(70.0, -34.0, -292.0), 5.0},
            {at(78.0, -24.0, -345.0), 4.5}},
           through);
  add_tube(shapes, kVein,  // the great saphenous
           {{at(63.0, -46.0, -262.0), 2.4},
            {at(59.0, -57.0, -274.0), 2.4},
            {at(54.0, -60.0, -300.0), 2.2},
            {at(44.0, -58.0, -345.0), 2.0}},
           through);
  add_valve(shapes, kFemoralVein, at(61.8, -43.4, -246.0), 5.9);
  add_valve(shapes, kFemoralVein, at(68.5, -36.0, -286.0), 5.1);
  const Over artery_through{kMuscle.name,     kFat.name,          kVisceralFat.name, kFemoralVein.name,
                            kSmallBowel.name, kBowelContent.name, kLymphNode.name};
  add_tube(shapes, kFemoralArtery,
           {{at(40.0, 14.0, -158.0), 5.0},
            {at(56.0, -18.0, -190.0), 4.8},
            {at(69.0, -43.0, -218.0), 4.6},
            {at(75.0, -48.0, -240.0), 4.6},
            {at(77.0, -48.0, -266.0), 4.6},
            {at(79.0, -46.0, -292.0), 3.6},
            {at(82.0, -38.0, -345.0), 3.4}},
           artery_through);
  add_tube(shapes, kFemoralArtery,
           {{at(77.5, -47.0, -264.0), 3.2},
            {at(86.0, -38.0, -280.0), 3.0},
            {at(94.0, -24.0, -310.0), 2.8},
            {at(98.0, -14.0, -345.0), 2.4}},
           artery_through);
  // The femoral nerve on the iliopsoas, lateral to the artery; branches below.
  add_tube(shapes, kNerve,
           {{at(84.0, -30.0, -205.0), 2.4},
            {at(89.0, -49.0, -232.0), 2.6},
            {at(91.0, -47.0, -256.0), 2.4},
            {at(96.0, -44.0, -285.0), 1.8}},
           through);
  add_tube(shapes, kNerve, {{at(91.0, -47.0, -256.0), 1.6}, {at(88.0, -46.0, -290.0), 1.4}}, through);
  // The inguinal ligament, from the iliac spine to the pubic tubercle, over the vessels.
  add_tube(shapes, kLigament,
           with_radius({{at(120.0, -52.0, -170.0), 0.0},
                        {at(96.0, -60.0, -196.0), 0.0},
                        {at(70.0, -60.0, -218.0), 0.0},
                        {at(46.0, -56.0, -236.0), 0.0},
                        {at(24.0, -48.0, -248.0), 0.0}},
                       2.6),
           {kMuscle.name, kFat.name, kVisceralFat.name});
}

}  // namespace

void add_groin(Shapes& shapes, double less_fat_mm) {
  add_groin_layers(shapes, less_fat_mm);
  add_iliac_wings(shapes);
  add_pelvic_inside(shapes);
  add_groin_bones(shapes);
  for (const double side : {-1.0, 1.0}) add_femoral_vessels(shapes, side);
}

}  // namespace seldinger::volume::phantom
