// Brightness by HU where no label tells tissues apart.
#include "sim/imaging/ultrasound/view/echogenicity.h"

#include <random>

#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// Soft tissue of one HU on the left and another on the right, with noise, and a tube of a third along z.
struct Organs {
  Scene s;
  double left_hu, right_hu, tube_hu;
  Organs(double left, double right, double tube, double noise_hu)
      : s(scene([](const glm::dvec3& p) { return p.y > 200.0 ? TissueClass::air : TissueClass::soft_tissue; })),
        left_hu(left),
        right_hu(right),
        tube_hu(tube) {
    std::mt19937 bits(7);
    std::normal_distribution<double> noise;
    each([&](const glm::dvec3& p, std::size_t at) {
      const double hu = in_tube(p) ? tube : (p.x < 0.0 ? left : right);
      s.volume.hu[at] = static_cast<std::int16_t>(std::lround(hu + noise_hu * noise(bits)));
    });
  }
  static bool in_tube(const glm::dvec3& p) { return std::hypot(p.x + 70.0, p.y - 70.0) < 5.0; }
  void each(const std::function<void(const glm::dvec3&, std::size_t)>& visit) const {
    const glm::ivec3 n = s.volume.size_voxels;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          visit(glm::dvec3(s.volume.lps_from_voxel * glm::dvec4(i, j, k, 1)),
                static_cast<std::size_t>(s.volume.index(i, j, k)));
  }
  double mean_db(const std::vector<std::uint8_t>& levels,
                 const std::function<bool(const glm::dvec3&)>& where) const {
    double sum = 0.0, count = 0.0;
    each([&](const glm::dvec3& p, std::size_t at) {
      if (where(p)) sum += echo_offset_db(levels[at]), count += 1.0;
    });
    return sum / count;
  }
};
bool left(const glm::dvec3& p) {
  return p.x > -130.0 && p.x < -30.0 && p.y < 190.0 && std::hypot(p.x + 70.0, p.y - 70.0) > 30.0;
}
bool right(const glm::dvec3& p) {
  return p.x > 30.0 && p.x < 130.0 && p.y < 190.0;
}

TEST(Echogenicity, PlainLiverIsBrighterThanKidneyAndItsVesselsAreDark) {
  const Organs organs(60.0, 30.0, 38.0, 8.0);
  const auto levels = echogenicity(organs.s.volume, organs.s.classes);
  const double liver_db = organs.mean_db(levels, left), kidney_db = organs.mean_db(levels, right);
  EXPECT_NEAR(liver_db, 3.0, 0.5);
  EXPECT_NEAR(kidney_db, -6.0, 0.7);
  EXPECT_LT(organs.mean_db(levels, Organs::in_tube), liver_db - 6.0);
}

TEST(Echogenicity, WithContrastVesselsAreDarkThoughTheyAreDense) {
  const Organs organs(110.0, 112.0, 170.0, 12.0);
  const auto levels = echogenicity(organs.s.volume, organs.s.classes);
  const double liver_db = organs.mean_db(levels, right);
  EXPECT_NEAR(liver_db, 2.0, 0.7);
  EXPECT_LT(organs.mean_db(levels, Organs::in_tube), liver_db - 10.0);
}

TEST(Echogenicity, LabelsAndOtherTissuesKeepTheirOwn) {
  Organs organs(60.0, 30.0, 38.0, 8.0);
  for (std::size_t i = 0; i < organs.s.classes.size(); i += 3) organs.s.classes[i] = TissueClass::liver;
  const auto levels = echogenicity(organs.s.volume, organs.s.classes);
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (organs.s.classes[i] != TissueClass::soft_tissue) {
      ASSERT_EQ(levels[i], kNoEchoOffset) << i;
    }
}

TEST(Echogenicity, SameBytesForAnyNumberOfThreads) {
  const Organs organs(60.0, 30.0, 38.0, 8.0);
  EXPECT_EQ(echogenicity(organs.s.volume, organs.s.classes, 1), echogenicity(organs.s.volume, organs.s.classes, 3));
}

// No side of a voxel counts more than another, at no edge either, with other spacing along each axis.
TEST(Echogenicity, IsTheSameInAMirror) {
  volume::Volume volume;
  volume.size_voxels = {24, 24, 24};
  volume.spacing_mm = {2.0, 1.0, 0.5};
  std::vector<TissueClass> classes;
  std::mt19937 bits(11);
  for (int i = 0; i < 24 * 24 * 24; ++i) {
    volume.hu.push_back(static_cast<std::int16_t>(bits() % 120));
    classes.push_back(bits() % 8 < 6   ? TissueClass::soft_tissue
                      : bits() % 2 < 1 ? TissueClass::fat
                                       : TissueClass::liver);
  }
  const auto levels = echogenicity(volume, classes);
  for (const glm::ivec3& flip : {glm::ivec3(1, 0, 0), glm::ivec3(0, 1, 0), glm::ivec3(0, 0, 1)}) {
    volume::Volume mirrored = volume;
    auto mirrored_classes = classes;
    const auto other = [&](int i, int j, int k) {
      return static_cast<std::size_t>(
          volume.index(flip.x == 1 ? 23 - i : i, flip.y == 1 ? 23 - j : j, flip.z == 1 ? 23 - k : k));
    };
    for (int at = 0; at < 24 * 24 * 24; ++at) {
      const std::size_t to = other(at % 24, at / 24 % 24, at / 576);
      mirrored.hu[to] = volume.hu[static_cast<std::size_t>(at)];
      mirrored_classes[to] = classes[static_cast<std::size_t>(at)];
    }
    const auto mirrored_levels = echogenicity(mirrored, mirrored_classes);
    for (int at = 0; at < 24 * 24 * 24; ++at)
      ASSERT_EQ(mirrored_levels[other(at % 24, at / 24 % 24, at / 576)], levels[static_cast<std::size_t>(at)])
          << at << ", mirrored along " << flip.x << flip.y << flip.z;
  }
}

// The picture takes it: a step of HU is a step of speckle, of the table's size.
TEST(Echogenicity, IsWhatThePictureShows) {
  const Organs organs(60.0, 30.0, 60.0, 0.0);
  const auto levels = echogenicity(organs.s.volume, organs.s.classes);
  UltrasoundView view = straight_view();
  view.origin_lps_mm.x = -60.0;
  view.attenuation_db_cm_mhz = 0.0;
  const auto picture_db = [&](double x_mm) {
    view.origin_lps_mm.x = x_mm;
    PolarPicture picture;
    ultrasound_polar({&organs.s.volume, organs.s.classes, levels}, view, {}, {}, picture);
    return level_db(picture, 0, view.beams, 100, 1000);
  };
  EXPECT_NEAR(picture_db(-90.0) - picture_db(60.0), organs.mean_db(levels, left) - organs.mean_db(levels, right),
              0.7);
}

}  // namespace
}  // namespace seldinger::imaging
