// What a scene file may name as its volume.
#include "app/pictures/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "sim/volume/phantom.h"

namespace seldinger::app {
namespace {

TEST(Scene, NamesTheBuiltInTorso) {
  std::vector<std::string> unused;
  const auto scene = scene_from_json(R"({"volume": {"built_in": "torso"}})", ".", unused);
  ASSERT_TRUE(scene.has_value()) << scene.error().text;
  EXPECT_TRUE(unused.empty());
  const auto volume = volume_of(*scene, "");
  ASSERT_TRUE(volume.has_value());
  const volume::Phantom torso = volume::make_phantom();
  EXPECT_EQ(volume->size_voxels, torso.volume.size_voxels);
  EXPECT_EQ(volume->lps_from_voxel, torso.volume.lps_from_voxel);
  EXPECT_EQ(volume->hu, torso.volume.hu);
  // Classes come from its labels: HU alone cannot tell liver from spleen.
  const auto tissue = tissue_of(*scene, *volume, "");
  ASSERT_TRUE(tissue.has_value());
  const auto class_at = [&](const glm::dvec3& p_lps_mm) {
    const glm::dvec3 at = glm::dvec3(volume::voxel_from_lps(*volume) * glm::dvec4(p_lps_mm, 1.0)) + 0.5;
    return tissue->classes[volume->index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))];
  };
  EXPECT_EQ(class_at({-100.0, 0.0, 10.0}), volume::TissueClass::liver);
  EXPECT_EQ(class_at({104.0, 34.0, 58.0}), volume::TissueClass::spleen);
  EXPECT_EQ(class_at({0.0, 39.0, 3.0}), volume::TissueClass::bone);
}

TEST(Scene, DrawsStructuresThatHaveATissue) {
  std::vector<std::string> unused;
  const auto with = [&](const std::string& more) {
    return scene_from_json(R"({"volume": {"built_in": "torso"}, "structures": [{"name": "portal_vein",
        "rule": "critical", "kind": "tube", "radius_mm": 6, "points_mm": [[-110, 0, 10], [-90, 0, 10]])" +
                               more + "}]}",
                           ".", unused);
  };
  const auto at = [](const volume::Volume& volume, const glm::dvec3& p_lps_mm) {
    const glm::dvec3 v = glm::dvec3(volume::voxel_from_lps(volume) * glm::dvec4(p_lps_mm, 1.0)) + 0.5;
    return volume.index(static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z));
  };
  const glm::dvec3 inside(-100.0, 0.0, 10.0), outside(-100.0, 0.0, 20.0);
  // Without one a structure is told by its name alone, and the volume stays as it is.
  const auto named = with("");
  ASSERT_TRUE(named.has_value()) << named.error().text;
  EXPECT_TRUE(named->drawn.empty());
  const volume::Phantom torso = volume::make_phantom();
  EXPECT_EQ(volume_of(*named, "")->hu, torso.volume.hu);
  for (const auto& [more, hu] : {std::pair{std::string(R"(, "tissue": "vessel")"), 43},
                                 std::pair{std::string(R"(, "tissue": "vessel", "hu": 170)"), 170}}) {
    const auto drawn = with(more);
    ASSERT_TRUE(drawn.has_value()) << drawn.error().text;
    EXPECT_EQ(drawn->structures.at(0).tissue, volume::TissueClass::vessel);
    const auto volume = volume_of(*drawn, "");
    ASSERT_TRUE(volume.has_value());
    EXPECT_EQ(volume->hu[at(*volume, inside)], hu);
    EXPECT_EQ(volume->hu[at(*volume, outside)], torso.volume.hu[at(*volume, outside)]);
    const auto tissue = tissue_of(*drawn, *volume, "");
    ASSERT_TRUE(tissue.has_value());
    EXPECT_EQ(tissue->classes[at(*volume, inside)], volume::TissueClass::vessel);
    EXPECT_EQ(tissue->classes[at(*volume, outside)], volume::TissueClass::liver);
  }
  // A portal vein that is drawn has walls, one that is only named has none.
  const auto levels = [&](const Scene& scene) { return tissue_of(scene, *volume_of(scene, ""), "")->echogenicity; };
  const auto with_walls = levels(*with(R"(, "tissue": "vessel")"));
  Scene hepatic = *with(R"(, "tissue": "vessel")");
  hepatic.structures[0].name = "hepatic_vein";
  EXPECT_NE(with_walls, levels(hepatic));
  EXPECT_TRUE(unused.empty());
  for (const char* wrong :
       {R"(, "tissue": "blood!")", R"(, "tissue": 12)", R"(, "tissue": "vessel", "hu": "170")"}) {
    const auto refused = with(wrong);
    ASSERT_FALSE(refused.has_value()) << wrong;
    EXPECT_EQ(refused.error().code, "bad_scene");
  }
  // An HU without a tissue draws nothing, and says so.
  EXPECT_TRUE(with(R"(, "hu": 170)")->drawn.empty());
  EXPECT_EQ(unused.size(), 1U);
}

TEST(Scene, RefusesWhatIsNotBuiltIn) {
  std::vector<std::string> unused;
  for (const char* text : {R"({"volume": {"built_in": "head"}})", R"({"volume": {"built_in": 1}})"}) {
    const auto scene = scene_from_json(text, ".", unused);
    ASSERT_FALSE(scene.has_value()) << text;
    EXPECT_EQ(scene.error().code, "bad_scene");
    EXPECT_NE(scene.error().text.find("volume.built_in"), std::string::npos) << scene.error().text;
  }
  EXPECT_FALSE(scene_from_json(R"({"volume": {}})", ".", unused).has_value());
}

TEST(Scene, MayShowFlowInColour) {
  std::vector<std::string> unused;
  const auto with = [&](const std::string& colour) {
    return scene_from_json(R"({"volume": {"built_in": "neck"}, "view": {"kind": "ultrasound", "preset": "vessel",
        "origin_mm": [0, 0, 0], "axial": [0, 1, 0], "lateral": [1, 0, 0], "colour": )" +
                               colour + "}}",
                           ".", unused);
  };
  const auto scene = with(R"({"scale_cm_s": 25})");
  ASSERT_TRUE(scene.has_value()) << scene.error().text;
  EXPECT_TRUE(unused.empty());
  EXPECT_EQ(std::get<UltrasoundSceneView>(*scene->view).console.colour_mm_s, 250.0);
  const auto off = with("null");  // as a sheet's column turns it off
  ASSERT_TRUE(off.has_value());
  EXPECT_EQ(std::get<UltrasoundSceneView>(*off->view).console.colour_mm_s, 0.0);
  for (const char* colour : {"true", "{}", R"({"scale_cm_s": 0})"})
    EXPECT_FALSE(with(colour).has_value()) << colour;
  EXPECT_FALSE(with(R"({"scale_cm_s": 25}, "output": "polar_db")").has_value());
  EXPECT_FALSE(with(R"(null, "output": "polar_db", "compound_deg": 12)").has_value()) << "of one look";
  EXPECT_TRUE(with(R"(null, "output": "polar_db", "compound_deg": 0)").has_value());
  const auto aimed = with(R"({"scale_cm_s": 25, "lean_deg": -20, "box_across": 0.3, "box_down": 0.6},
      "compound_deg": 12, "sight_law": "scatter")");
  ASSERT_TRUE(aimed.has_value()) << aimed.error().text;
  const auto& view = std::get<UltrasoundSceneView>(*aimed->view);
  EXPECT_EQ(view.console.lean_deg, -20.0);
  EXPECT_EQ(view.console.box_across, 0.3);
  EXPECT_EQ(view.console.box_down, 0.6);
  EXPECT_EQ(view.view.compound_deg, 12.0);
  EXPECT_EQ(view.view.sight_law, cases::SightLaw::scatter);
  EXPECT_EQ(std::get<UltrasoundSceneView>(*scene->view).view.sight_law, cases::kNewestSightLaw);
  for (const char* wrong : {R"({"scale_cm_s": 25, "lean_deg": 21})", R"({"scale_cm_s": 25}, "compound_deg": 16)",
                            R"({"scale_cm_s": 25}, "sight_law": "none")"})
    EXPECT_FALSE(with(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace seldinger::app
