// Tests of app/hands/station: what is written is read back, and what is no station's file is refused.
#include "app/hands/station.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/fixtures/process.h"

namespace seldinger::app {
namespace {

devices::Calibration calibration() {
  std::vector<devices::TakenPoint> taken;
  for (const devices::TemplatePoint& point : devices::template_points()) {
    const glm::dvec3& p = point.template_mm;
    taken.push_back({point.name, {0.9 * p.z + 3.0, 0.9 * p.x + 0.1 * (p.z > 0.0), 0.9 * p.y - 7.0}});
  }
  return *devices::calibrate(taken);
}

std::filesystem::path file_with(const std::string& text) {
  const auto path = fixtures::fresh_folder("station") / "station.json";
  std::ofstream(path) << text;
  return path;
}

TEST(Station, IsReadBackToTheLastBit) {
  const devices::Calibration one = calibration();
  EXPECT_GT(one.residual_max_mm, 0.0);
  const auto read = read_station(file_with(json_of_station({{"right", {one, {"04BA", "61576"}}}})));
  ASSERT_TRUE(read) << read.error().text;
  ASSERT_EQ(read->size(), 1U);
  EXPECT_EQ(read->at("right").ids.arm, "04BA");
  EXPECT_EQ(read->at("right").ids.grip, "61576");
  const devices::Calibration& again = read->at("right").calibration;
  EXPECT_EQ(again.template_from_device.rotation, one.template_from_device.rotation);
  EXPECT_EQ(again.template_from_device.scale, one.template_from_device.scale);
  EXPECT_EQ(again.template_from_device.translation_mm, one.template_from_device.translation_mm);
  EXPECT_EQ(again.residual_rms_mm, one.residual_rms_mm);
  EXPECT_EQ(again.residual_max_mm, one.residual_max_mm);
  ASSERT_EQ(again.points.size(), one.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(again.points[i].taken.name, one.points[i].taken.name);
    EXPECT_EQ(again.points[i].taken.device_mm, one.points[i].taken.device_mm);
    EXPECT_EQ(again.points[i].residual_mm, one.points[i].residual_mm);
  }
}

TEST(Station, GainsAreKeptAndOneSideIsChangedWithoutTheOther) {
  const auto file = fixtures::fresh_folder("station_change") / "station.json";
  const devices::DeviceGains gains{1.5, 0.5, 4.0};
  ASSERT_TRUE(change_station(file, [&](Station& station) {
    station["left"].gains = gains;
    station["left"].ids = {"one", "two"};
  }));
  const auto changed = change_station(file, [](Station& station) { station["right"].calibration = calibration(); });
  ASSERT_TRUE(changed);
  const auto read = read_station(file);
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(read->at("left").gains, gains);
  EXPECT_EQ(read->at("left").ids.grip, "two");
  EXPECT_TRUE(read->at("left").calibration.points.empty()) << "nobody calibrated it";
  EXPECT_EQ(read->at("right").gains, devices::DeviceGains{});
  EXPECT_EQ(read->at("right").calibration.points.size(), 6U);
  std::ofstream(file) << "{}";
  EXPECT_FALSE(change_station(file, [](Station&) {}));
  EXPECT_EQ(fixtures::whole_file(file), "{}") << "what is none of ours stays";
}

TEST(Station, RefusesWhatIsNoneOfOurs) {
  const std::string good = json_of_station({{"left", {calibration()}}});
  ASSERT_TRUE(read_station(file_with(good)));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string("{\"format\": 1}"), good.substr(0, 300),
        with("\"format\": 1", "\"format\": 2"), with("\"left\"", "\"middle\""),
        with("\"scale\": 1.", "\"scale\": 91."), with("\"scale\"", "\"stale\""),
        with("\"rotation\": [", "\"rotation\": [7,"), with("\"residual_max_mm\": ", "\"residual_max_mm\": 2"),
        with("\"device_mm\": [", "\"device_mm\": [\"1\","),
        with("\"residual_rms_mm\"", "\"grip_id\": 7, \"residual_rms_mm\"")}) {
    const auto read = read_station(file_with(text));
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, "bad_station");
  }
  const std::string set = json_of_station({{"left", {calibration(), {}, {2.0, 0.5, 4.0}}}});
  ASSERT_TRUE(read_station(file_with(set)));
  for (const char* gain : {"\"motion_scale\": 2", "\"force_share\": 0", "\"most_force_n\": 4"}) {
    const std::size_t at = set.find(gain) + std::string(gain).size() - 1;
    const std::string text = set.substr(0, at) + "7" + set.substr(at);
    EXPECT_FALSE(read_station(file_with(text))) << text;
  }
  // A reflection is no rotation.
  devices::Calibration mirrored = calibration();
  mirrored.template_from_device.rotation[0] *= -1.0;
  EXPECT_FALSE(read_station(file_with(json_of_station({{"left", {mirrored}}}))));
  EXPECT_EQ(read_station("/nowhere/station.json").error().code, "not_found");
}

}  // namespace
}  // namespace seldinger::app
