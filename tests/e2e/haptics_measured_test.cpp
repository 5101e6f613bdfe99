// Tests of `seldinger haptics fit` and `haptics calibrate` as their users type them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using fixtures::kProgram;

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

// Standard error is one `error:` line with the code, then `finding:` lines only; nothing in the folder changed.
void expect_refused(const std::string& words, const fs::path& folder, const std::string& code, int findings) {
  const std::string before = fixtures::fingerprint(folder);
  const auto ran = fixtures::run(kProgram + " haptics " + words, folder.string() + "_said");
  EXPECT_EQ(ran.exit_code, 3) << words;
  EXPECT_EQ(ran.err.rfind("error: " + code + ": ", 0), 0U) << words << "\n" << ran.err;
  int lines = 0;
  for (std::size_t at = ran.err.find("\nfinding: "); at != std::string::npos;
       at = ran.err.find("\nfinding: ", at + 1))
    ++lines;
  EXPECT_EQ(lines, findings) << words << "\n" << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(fixtures::fingerprint(folder), before) << words;
}

TEST(HapticsFit, GivesBackTheThesisKidney) {
  const auto scratch = fixtures::fresh_folder("haptics_fit");
  const std::string csv = std::string("'").append(scratch / "kidney.csv").append("'");
  ASSERT_EQ(fixtures::run(kProgram +
                              " haptics insert --tissue kidney --speed-mm-s 8.333333 --depth-mm 60 --hold-s 1 "
                              "--retract --out " +
                              csv,
                          scratch)
                .exit_code,
            0);
  const auto ran =
      fixtures::run(kProgram + " haptics fit " + csv + " --tissue kidney --source 'a \"b\"' --json", scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto json = Json::parse(ran.out);
  EXPECT_NEAR(json.at("plateau").at("slope_n_mm").at("value").get<double>(), 0.010, 1e-5);
  EXPECT_NEAR(json.at("plateau").at("intercept_n").at("value").get<double>(), 1.53, 0.001);
  EXPECT_LE(json.at("plateau").at("rmse_n").get<double>(), 0.065);
  EXPECT_LE(json.at("gaussians").at("rmse_n").get<double>(), 0.065);
  EXPECT_EQ(json.at("gaussians").at("parts").size(), 8U);
  EXPECT_NEAR(json.at("row").at("dent_mm").get<double>(), 10.0, 0.05);
  EXPECT_NEAR(json.at("row").at("rupture_n").get<double>(), 2.6, 0.03);
  EXPECT_EQ(json.at("row").at("tip_stiffness_n_mm"), 0.25);
  const std::string page = fixtures::whole_file(scratch / "kidney.fit.html");
  for (const char* part : {"measured", "sum of Gaussians", "residual", "<svg"})
    EXPECT_NE(page.find(part), std::string::npos) << part;

  const auto text = fixtures::run(kProgram + " haptics fit " + csv + " --tissue kidney --source 'a \"b\"' --out '" +
                                      (scratch / "other.html").string() + "'",
                                  scratch);
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("    {TissueClass::kidney,\n     {0.01, 1.53, 0.25, 2.61"), std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find("\"a \\\"b\\\": fitted to"), std::string::npos) << text.out;
  EXPECT_EQ(fixtures::whole_file(scratch / "other.html"), page) << "the same every time";
  // A thicker needle's forces are made smaller for the table.
  const auto thick = Json::parse(
      fixtures::run(kProgram + " haptics fit " + csv + " --gauge 18 --gaussians 2 --json", scratch).out);
  EXPECT_NEAR(thick.at("row").at("intercept_n").get<double>(), 1.53 * 0.718 / 1.270, 0.001);
  EXPECT_EQ(thick.at("row").at("tissue"), "soft_tissue");
}

TEST(HapticsFit, RefusesWhatIsNoCurve) {
  const auto scratch = fixtures::fresh_folder("haptics_fit_refused");
  const auto refuse = [&](const std::string& text, const std::string& code, int findings) {
    write(scratch / "x.csv", text);
    expect_refused("fit '" + (scratch / "x.csv").string() + "'", scratch, code, findings);
  };
  refuse("", "bad_csv", 1);
  refuse("depth_mm,force\n1,2\n", "bad_csv", 0);
  refuse("depth_mm,force_axial_n\n1,nan\nx,2\n", "bad_csv", 1);
  refuse("depth_mm,force_axial_n\n5,-1\n6,-1\n", "too_shallow", 3);
  std::string ramp = "depth_mm,force_axial_n\n";
  for (int i = 0; i < 100; ++i) ramp += std::to_string(i * 0.5) + "," + std::to_string(i * i * 1e-3) + "\n";
  refuse(ramp, "no_plateau", 0);
  expect_refused("fit '" + (scratch / "none.csv").string() + "'", scratch, "not_found", 0);
  for (const char* words :
       {"", "x.csv --tissue glass", "x.csv --gauge 30", "x.csv --gaussians 0", "x.csv --gaussians 13"})
    EXPECT_EQ(fixtures::run(kProgram + " haptics fit " + words, scratch).exit_code, 2) << words;
}

// Device coordinates: x_mm = z + 5, y_mm = x, z_mm = y - 50 of the template, stretched by 1 / scale.
std::string points(double scale, const std::string& but = "", double off_mm = 0.0) {
  std::string text = "point,x_mm,y_mm,z_mm\n";
  const auto add = [&](const std::string& name, double x, double y, double z) {
    char line[128];
    std::snprintf(line, sizeof line, "%s,%.9f,%.9f,%.9f\n", name.c_str(),
                  (z + 5.0) / scale + (name == but ? off_mm : 0.0), x / scale, (y - 50.0) / scale);
    text += line;
  };
  add("a", -64, 0, 0);
  add("b", 64, 0, 0);
  add("c", 0, 0, -64);
  add("d", 0, 0, 64);
  add("e", 0, 0, 0);
  add("f", 11, 143, -17);
  return text;
}

TEST(HapticsCalibrate, KeepsBothDevicesOfAStation) {
  const auto scratch = fixtures::fresh_folder("haptics_calibrate");
  const auto calibrate = [&](const std::string& text, const std::string& device) {
    write(scratch / "points.csv", text);
    return fixtures::run(kProgram + " haptics calibrate '" + (scratch / "points.csv").string() + "' --device " +
                             device + " --station '" + (scratch / "station.json").string() + "'",
                         scratch);
  };
  EXPECT_EQ(calibrate(points(1.0), "left").exit_code, 0);
  const auto right = calibrate(points(1.25), "right");
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_NE(right.out.find("scale 1.2500"), std::string::npos) << right.out;
  EXPECT_EQ(calibrate(points(1.1, "a", 0.3), "left").exit_code, 0) << "renewed";
  const auto station = Json::parse(fixtures::whole_file(scratch / "station.json"));
  const auto scale = [&](const char* device) {
    return station.at("devices").at(device).at("template_from_device").at("scale").get<double>();
  };
  EXPECT_NEAR(scale("left"), 1.1, 0.005);
  EXPECT_NEAR(scale("right"), 1.25, 1e-6);
  const auto& there = station.at("devices").at("right").at("template_from_device");
  const double rotation[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0}, translation_mm[3] = {0, 50, -5};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(there.at("rotation").at(i).get<double>(), rotation[i], 1e-7) << i;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(there.at("translation_mm").at(i).get<double>(), translation_mm[i], 1e-6) << i;
  EXPECT_LE(station.at("devices").at("right").at("residual_max_mm").get<double>(), 1e-6);
  EXPECT_GT(station.at("devices").at("left").at("residual_max_mm").get<double>(), 0.1);
}

TEST(HapticsCalibrate, RefusesAndLeavesTheStationAsItWas) {
  const auto scratch = fixtures::fresh_folder("haptics_calibrate_refused");
  const std::string csv = (scratch / "points.csv").string(), station = (scratch / "station.json").string();
  const std::string words = "calibrate '" + csv + "' --device left --station '" + station + "'";
  write(csv, points(1.0));
  ASSERT_EQ(fixtures::run(kProgram + " haptics " + words, scratch).exit_code, 0);
  write(csv, points(1.0, "c", 8.0));
  const std::string before = fixtures::fingerprint(scratch);
  const auto wrong = fixtures::run(kProgram + " haptics " + words, scratch.string() + "_said");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_EQ(wrong.err.rfind("error: wrong_point: ", 0), 0U) << wrong.err;
  EXPECT_NE(wrong.err.find("without point c the others agree"), std::string::npos) << wrong.err;
  EXPECT_EQ(fixtures::fingerprint(scratch), before);
  write(csv, points(-1.0));
  expect_refused(words, scratch, "mirrored", 0);
  write(csv, "point,x_mm,y_mm,z_mm\na,1,2,3\na,1,2,3\n");
  expect_refused(words, scratch, "bad_points", 4);
  write(csv, points(1.0));
  write(station, "{}");
  expect_refused(words, scratch, "bad_station", 0);
  for (const char* bad : {"--device middle --station s.json", "--station s.json", "--device left"})
    EXPECT_EQ(fixtures::run(kProgram + " haptics calibrate '" + csv + "' " + bad, scratch).exit_code, 2) << bad;
  EXPECT_EQ(
      fixtures::run(kProgram + " haptics calibrate '" + csv + "' --device left --station /nowhere/s.json", scratch)
          .exit_code,
      4);
}

}  // namespace
}  // namespace seldinger
