// Tissue at many depths of a beam at once has the bits of one at a time.
#include "sim/imaging/ultrasound/view/tissue_along.h"

#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// Layers, and lesions of which one lies over another, one has a rim and one reaches out of the volume.
TEST(TissueAlong, IsWhatEachDepthAloneTells) {
  const Scene s = scene(
      [](const glm::dvec3& p) {
        if (p.y < 12.0 + 0.3 * p.x) return TissueClass::fat;
        return p.y < 18.0 - 0.2 * p.z ? TissueClass::muscle : TissueClass::liver;
      },
      {80, 60, 30}, 1.0);
  Inserted inserted;
  cases::Lesion rimmed;
  rimmed.center_lps_mm = {0.0, 25.0, 0.0};
  rimmed.radius_mm = 8.0;
  cases::LesionEcho echo;
  echo.inside = TissueClass::fluid;
  echo.rim = TissueClass::connective;
  echo.rim_mm = 2.0;
  rimmed.echo = echo;
  inserted.lesions = {rimmed, {{6.0, 27.0, 1.0}, 9.0, 5.0}, {{-30.0, 58.0, 0.0}, 12.0, 5.0}};
  const TissueAt tissue_at(s.tissue(), inserted);
  const tissue::SkinPress press{.at_lps_mm = {0, 0, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 7.0};
  const tissue::Displacement pressed = tissue::displacement_of({.presses = {&press, 1}});
  for (const UltrasoundView& view : {curved_view(90.0), straight_view(50.0)}) {
    const auto motion = motion_of(view, pressed);
    ASSERT_TRUE(motion.has_value());
    std::array<int, volume::kTissueClasses> met{};
    for (const PictureMotion* moved : {static_cast<const PictureMotion*>(nullptr), &*motion})
      for (const double beam : {-0.4, 17.0, 44.3, 63.5, 80.0, 127.0}) {
        const BeamPath path = path_of(fan_of(view), moved, beam);
        for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 1000U}) {
          std::vector<double> depths_mm;
          for (std::size_t i = 0; i < count; ++i)
            depths_mm.push_back(-1.0 + (view.depth_mm + 5.0) * static_cast<double>(i) / static_cast<double>(count));
          std::vector<TissueClass> tissue(count);
          tissue_along(path, tissue_at, depths_mm, tissue);
          for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(tissue[i], tissue_at(path.at(depths_mm[i]))) << view.probe.name << ' ' << beam << ' ' << i;
            ++met[static_cast<std::size_t>(tissue[i])];
          }
        }
      }
    for (const TissueClass one : {TissueClass::air, TissueClass::fat, TissueClass::muscle, TissueClass::liver,
                                  TissueClass::fluid, TissueClass::connective})
      EXPECT_GT(met[static_cast<std::size_t>(one)], 0) << static_cast<int>(one);
  }
}

}  // namespace
}  // namespace seldinger::imaging
