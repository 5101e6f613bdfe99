// An attempt in formats of other programs: places in LPS where they were, columns as their descriptions say, verbs
// as the grade does.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "reports/export/formats/motion_bids_json.h"
#include "reports/export/formats/slicer_json.h"
#include "reports/export/formats/xapi_json.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::reports {
namespace {

using Json = nlohmann::json;

const glm::dvec3 kDirection = glm::normalize(glm::dvec3(1.0, 2.0, -2.0));

// A tip that goes straight through the skin at x = 0 to 30 mm below it, one millimetre a tenth of a second.
cases::Recording straight_in() {
  cases::Recording recording;
  for (int i = 0; i <= 400; ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {-10.0 + 0.1 * i, 3.0, -7.0};
    pose.needle_direction = kDirection;
    recording.poses.push_back(pose);
  }
  recording.endpoint = cases::Endpoint{4.0, recording.poses.back().tip_lps_mm, kDirection, std::nullopt};
  return recording;
}

const cases::MeshIndex& skin() {
  static const cases::MeshIndex index(fixtures::box_mesh({0.0, -50.0, -50.0}, {100.0, 50.0, 50.0}));
  return index;
}

glm::dvec3 position_of(const Json& point) {
  return {point.at("position")[0], point.at("position")[1], point.at("position")[2]};
}

TEST(SlicerFiles, HoldTargetEntryEndpointAndWayInLps) {
  const glm::dvec3 target{31.0, 2.0, -6.0};
  const auto files = slicer_files("A-1", false, straight_in(), target, skin());
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "slicer/A-1_points.mrk.json");
  const Json points = Json::parse(files[0].content).at("markups").at(0);
  EXPECT_EQ(points.at("type"), "Fiducial");
  EXPECT_EQ(points.at("coordinateSystem"), "LPS");
  ASSERT_EQ(points.at("controlPoints").size(), 3U);
  EXPECT_EQ(points.at("controlPoints")[0].at("label"), "target");
  EXPECT_EQ(position_of(points.at("controlPoints")[0]), target);
  EXPECT_EQ(points.at("controlPoints")[1].at("label"), "entry");
  EXPECT_LT(glm::distance(position_of(points.at("controlPoints")[1]), {0.0, 3.0, -7.0}), 1e-9);
  EXPECT_EQ(points.at("controlPoints")[2].at("label"), "endpoint");
  EXPECT_EQ(position_of(points.at("controlPoints")[2]), glm::dvec3(30.0, 3.0, -7.0));
  const Json way = Json::parse(files[1].content).at("markups").at(0);
  EXPECT_EQ(way.at("type"), "Curve");
  double length = 0.0;
  for (std::size_t i = 1; i < way.at("controlPoints").size(); ++i)
    length += glm::distance(position_of(way.at("controlPoints")[i]), position_of(way.at("controlPoints")[i - 1]));
  EXPECT_NEAR(length, 40.0, 1e-9);
  EXPECT_LT(way.at("controlPoints").size(), 90U) << "points lie half a millimetre apart";
  EXPECT_TRUE(slicer_files("A-1", false, cases::Recording{}, target, skin()).empty());
}

// What Slicer reads from such a file takes the patient's points to the needle's: the tip to 0, a place ahead to +z.
TEST(SlicerFiles, TheTransformTakesThePatientToTheNeedle) {
  const std::string text = slicer_files("A-1", false, straight_in(), {}, skin())[2].content;
  ASSERT_EQ(text.rfind("#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n", 0),
            0U);
  std::istringstream numbers(text.substr(text.find("Parameters: ") + 12));
  double m[12];
  for (double& one : m) ASSERT_TRUE(numbers >> one);
  EXPECT_NE(text.find("\nFixedParameters: 0 0 0\n"), std::string::npos);
  const auto needle_from_patient = [&](const glm::dvec3& p) {
    glm::dvec3 at{0.0};
    for (int i = 0; i < 3; ++i) at[i] = m[3 * i] * p.x + m[3 * i + 1] * p.y + m[3 * i + 2] * p.z + m[9 + i];
    return at;
  };
  const glm::dvec3 tip{30.0, 3.0, -7.0};
  EXPECT_LT(glm::length(needle_from_patient(tip)), 1e-12);
  EXPECT_LT(glm::distance(needle_from_patient(tip + 5.0 * kDirection), {0.0, 0.0, 5.0}), 1e-12);
  const glm::dvec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
  EXPECT_LT(glm::distance(glm::cross(x, y), z), 1e-12) << "a rotation, not a mirror";
}

// What was simulated cannot be taken for somebody's, whichever file is looked at.
TEST(SlicerFiles, SayWhatIsSimulated) {
  for (const bool synthetic : {false, true}) {
    const auto files = slicer_files("A-1", synthetic, straight_in(), {}, skin());
    const std::string end = synthetic ? ", simulated" : "";
    const Json points = Json::parse(files[0].content).at("markups").at(0);
    const Json way = Json::parse(files[1].content).at("markups").at(0);
    EXPECT_EQ(points.at("name"), "A-1 points" + end);
    EXPECT_EQ(way.at("name"), "A-1 path" + end);
    for (const Json* one : {&points, &way}) EXPECT_EQ(one->at("synthetic"), synthetic);
    EXPECT_EQ(files[2].content.find("\n# SIMULATED: ") != std::string::npos, synthetic);
  }
}

TEST(XapiStatements, SayWhatTheGradeSays) {
  const std::string id = "0123abcd-0123-8123-9123-0123456789ab";
  const Json all =
      Json::parse(xapi_statements({{id, "P-1", "A-1", "C-1", false, assessment::Verdict::passed, false, 12.5},
                                   {id, "P-1", "A-2", "C-1", false, assessment::Verdict::failed, true, 3.0},
                                   {id, "", "A-3", "C-1", true, assessment::Verdict::no_rule, false, 1.0},
                                   {id, "", "A-4", "C-1", true, assessment::Verdict::not_gradable, true, 1.0}}));
  ASSERT_EQ(all.size(), 4U);
  const char* verbs[] = {"passed", "failed", "completed", "terminated"};
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& one = all[i];
    EXPECT_EQ(one.at("id"), id);
    EXPECT_EQ(one.at("verb").at("id"), std::string("http://adlnet.gov/expapi/verbs/") + verbs[i]);
    EXPECT_EQ(one.at("result").at("completion"), i < 3) << "what was cut off is not completed";
    EXPECT_EQ(one.at("result").contains("success"), i < 2);
    EXPECT_FALSE(one.contains("timestamp")) << "an export tells no dates";
    // One identifier of one agent, by account: no mail.
    EXPECT_EQ(one.at("actor").size(), 2U);
    EXPECT_EQ(one.at("context").at("extensions").at("https://seldinger.invalid/synthetic"), i >= 2);
  }
  EXPECT_EQ(all[0].at("actor").at("account").at("name"), "P-1");
  EXPECT_EQ(all[0].at("result").at("success"), true);
  EXPECT_EQ(all[1].at("result").at("success"), false);
  EXPECT_EQ(all[0].at("result").at("duration"), "PT12.50S");
  EXPECT_EQ(xapi_statements({}), "[]\n");
}

TEST(MotionBids, EveryChannelIsAColumn) {
  const cases::Recording recording = straight_in();
  const auto files = motion_bids_files("P-a1", "A-b2", recording);
  ASSERT_EQ(files.size(), 4U);
  const std::regex name(
      "motion-bids/(sub-[a-zA-Z0-9]+)/motion/(sub-[a-zA-Z0-9]+)_task-[a-z]+_tracksys-[a-z]+_acq-[a-zA-Z0-9]+_"
      "(motion|channels)\\.(tsv|json)");
  std::smatch parts;
  for (const FormatFile& one : files) {
    ASSERT_TRUE(std::regex_match(one.name, parts, name)) << one.name;
    EXPECT_EQ(parts[1], "sub-Pa1");
    EXPECT_EQ(parts[1], parts[2]);
  }
  std::istringstream rows(files[0].content), channels(files[2].content);
  std::string line;
  std::getline(channels, line);
  EXPECT_EQ(line, "name\tcomponent\ttype\ttracked_point\tunits\treference_frame");
  std::map<std::string, int> types;
  int count = 0;
  for (; std::getline(channels, line); ++count) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 3; ++i) std::getline(cells, cell, '\t');
    ++types[cell];
  }
  const Json about = Json::parse(files[1].content);
  EXPECT_EQ(about.at("MotionChannelCount"), count);
  for (const auto& [type, many] : types) EXPECT_EQ(about.at(type + "ChannelCount"), many) << type;
  for (const char* needed : {"TaskName", "SamplingFrequency"}) EXPECT_TRUE(about.contains(needed)) << needed;
  std::size_t row = 0;
  for (; std::getline(rows, line); ++row) {
    std::istringstream cells(line);
    std::vector<double> numbers;
    for (double one = 0.0; cells >> one;) numbers.push_back(one);
    ASSERT_EQ(static_cast<int>(numbers.size()), count);
    EXPECT_EQ(numbers[0], recording.poses[row].tip_lps_mm.x) << "bit for bit";
    EXPECT_EQ(numbers[6], recording.poses[row].t_s);
  }
  EXPECT_EQ(row, recording.poses.size());
  const auto head = motion_bids_head({"sub-b", "sub-a", "sub-b"});
  EXPECT_EQ(head[1].content, "participant_id\nsub-a\nsub-b\n");
  EXPECT_EQ(Json::parse(head[0].content).at("BIDSVersion"), "1.9.0");
}

}  // namespace
}  // namespace seldinger::reports
