// Tests of the commands' contract: exit codes, errors in one line, nothing changed by what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kData;
using fixtures::kProgram;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// A small body: a 120 mm ball of soft tissue in air, so that there is skin to puncture.
const char* const kBall = R"("volume": {"analytic": {"size_voxels": [90, 90, 90], "spacing_mm": [2, 2, 2],
  "origin_mm": [-89, -89, -89], "shapes": [{"kind": "sphere", "center_mm": [0, 0, 0], "radius_mm": 60, "hu": 60}]}})";

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

void expect_refused(const fixtures::Ran& ran, const std::string& code = {}) {
  EXPECT_EQ(ran.exit_code, 3) << ran.out << ran.err;
  EXPECT_EQ(ran.err.rfind("error: " + (code.empty() ? "" : code + ": "), 0), 0U) << ran.err;
  std::istringstream lines(ran.err);
  int errors = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("error: ", 0) == 0)
      ++errors;
    else
      EXPECT_TRUE(line.rfind("finding: ", 0) == 0) << line;
  }
  EXPECT_EQ(errors, 1) << ran.err;
}

TEST(Cli, UsageErrorsAreTwo) {
  const auto scratch = fixtures::fresh_folder("cli_usage");
  for (const char* words : {"nonsense", "import", "import x --nonsense", "sample x", "case", "simulate --library x",
                            "import a b --library x", "sample x --library y --lps 1,2", "render x",
                            "render x --out y.jpg", "simulate --library x --case y --operator expert --count 0"}) {
    const auto ran = run(kProgram + " " + words, scratch);
    EXPECT_EQ(ran.exit_code, 2) << words << ": " << ran.err;
    EXPECT_EQ(ran.err.rfind("usage: ", 0), 0U) << ran.err;
    EXPECT_TRUE(ran.out.empty());
  }
  EXPECT_EQ(run(kProgram + " help", scratch).exit_code, 0);
  EXPECT_EQ(run(kProgram + " --version", scratch).exit_code, 0);
}

TEST(Cli, BadSourcesAreRefusedAndTheLibraryStaysByteIdentical) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("cli_bad_sources");
  const std::string library = (scratch / "library").string();
  ASSERT_EQ(
      run(kProgram + " import " + kData + "/dicom-samples/CT_small.dcm --title Small --library " + library, scratch)
          .exit_code,
      0);
  std::filesystem::create_directories(scratch / "empty");
  std::string noise(200'000, '\0');
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>((i * 2654435761U) >> 13);
  for (const char* name :
       {"noise.dcm", "noise.nii", "noise.nii.gz", "noise.nrrd", "noise.mha", "noise.mhd", "noise.bin"})
    write(scratch / name, noise);
  const std::string mha = fixtures::whole_file(kData + "/ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  write(scratch / "cut.mha", mha.substr(0, mha.size() / 2));
  const std::string nii = fixtures::whole_file(kData + "/ct-abdomen-pelvis/abdomen_pelvis.nii.gz");
  write(scratch / "cut.nii.gz", nii.substr(0, nii.size() / 2));
  write(scratch / "cut1.nii.gz", nii.substr(0, nii.size() - 1));
  const std::string nrrd = fixtures::whole_file(kData + "/ct-neck/neck.nrrd");
  write(scratch / "cut.nrrd", nrrd.substr(0, nrrd.size() / 2));
  const std::string dcm = fixtures::whole_file(kData + "/dicom-samples/CT_small.dcm");
  write(scratch / "cut.dcm", dcm.substr(0, dcm.size() / 2));
  std::vector<std::string> sources = {"/nowhere/at/all"};
  for (const char* name : {"empty", "noise.dcm", "noise.nii", "noise.nii.gz", "noise.nrrd", "noise.mha",
                           "noise.mhd", "noise.bin", "cut.mha", "cut.nii.gz", "cut1.nii.gz", "cut.nrrd", "cut.dcm"})
    sources.push_back((scratch / name).string());
  for (const char* name :
       {"MR_small", "MR_small_bigendian", "emri_small", "rtstruct", "rtdose", "liver_1frame", "sr_no_pixel_data",
        "us_no_pixel_spacing", "SC_rgb_rle", "no_meta_group_length", "priv_SQ"})
    sources.push_back(kData + "/dicom-samples/" + name + ".dcm");
  const std::string before = fixtures::fingerprint(library);
  for (const std::string& source : sources) {
    SCOPED_TRACE(source);
    const auto ran = run(kProgram + " import '" + source + "' --library " + library, scratch);
    expect_refused(ran);
    EXPECT_NE(ran.err.find("SOURCE \"" + source + "\": "), std::string::npos) << "as it was typed";
    EXPECT_EQ(fixtures::fingerprint(library), before);
    const auto fresh = run(kProgram + " import '" + source + "' --library " + library + "_new", scratch);
    EXPECT_EQ(fresh.exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(library + "_new")) << "a refused import makes no library";
  }
}

TEST(Cli, ALostSliceIsNeverLeftOutInSilence) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("cli_lost_slice");
  const auto import = [&](const std::string& folder) {
    return run(
        kProgram + " import " + (scratch / folder).string() + " --json --library " + (scratch / "library").string(),
        scratch);
  };
  const auto copy = [&](const std::string& folder) {
    std::filesystem::copy(kData + "/ct-abdomen-contrast-dicom", scratch / folder);
    std::filesystem::permissions(scratch / folder, std::filesystem::perms::owner_all);
    for (const auto& entry : std::filesystem::directory_iterator(scratch / folder))
      std::filesystem::permissions(entry.path(), std::filesystem::perms::owner_all);
    return scratch / folder;
  };
  write(copy("empty") / "1-35.dcm", "");
  expect_refused(import("empty"), "damaged");
  write(copy("short") / "1-01.dcm", std::string(100, '\0'));
  expect_refused(import("short"), "damaged");
  const auto linked = copy("linked");
  std::filesystem::rename(linked / "1-35.dcm", scratch / "elsewhere");
  std::filesystem::create_symlink(scratch / "elsewhere", linked / "1-35.dcm");
  write(linked / "README.txt", "junk beside a series is left out");
  const auto followed = import("linked");
  ASSERT_EQ(followed.exit_code, 0) << followed.err;
  EXPECT_EQ(Json::parse(followed.out).at("slices_used"), 35);
  std::filesystem::remove(scratch / "elsewhere");
  expect_refused(import("linked"), "not_readable");
}

TEST(Cli, AFullDiskIsFourAndChangesNothing) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("cli_full_disk");
  const std::string library = (scratch / "library").string(), small = kData + "/dicom-samples/CT_small.dcm";
  ASSERT_EQ(run(kProgram + " import " + small + " --library " + library, scratch).exit_code, 0);
  const std::string before = fixtures::fingerprint(library);
  // So full that SQLite could not even begin: nothing is left beside the databases.
  const auto fuller = run("ulimit -f 8; " + kProgram + " case list --library " + library, scratch);
  EXPECT_EQ(fuller.exit_code, 4) << fuller.out << fuller.err;
  EXPECT_EQ(fixtures::fingerprint(library), before);
  // A file-size limit stops writes as a full disk does, and needs no rights; 2000 blocks of 512 bytes.
  const auto ran =
      run("ulimit -f 2000; " + kProgram + " import " + kData + "/ct-neck/neck.nrrd --library " + library, scratch);
  EXPECT_EQ(ran.exit_code, 4) << ran.out << ran.err;
  EXPECT_EQ(first_line(ran.err).rfind("error: disk: ", 0), 0U) << ran.err;
  EXPECT_EQ(fixtures::fingerprint(library), before);
  EXPECT_EQ(
      run("ulimit -f 2000; " + kProgram + " import " + kData + "/ct-neck/neck.nrrd --library " + library + "_new",
          scratch)
          .exit_code,
      4);
  EXPECT_EQ(fixtures::fingerprint(library + "_new").find("assets/"), std::string::npos) << "no case, no asset";
}

TEST(Cli, MissingLibrariesCasesAndAttemptsAreRefused) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("cli_missing");
  const std::string library = (scratch / "library").string();
  expect_refused(run(kProgram + " case list --library " + library, scratch), "no_library");
  EXPECT_FALSE(std::filesystem::exists(library));
  ASSERT_EQ(
      run(kProgram + " import " + kData + "/dicom-samples/CT_small.dcm --library " + library, scratch).exit_code,
      0);
  expect_refused(run(kProgram + " case show x --library " + library, scratch), "no_case");
  expect_refused(run(kProgram + " sample x --lps 0,0,0 --library " + library, scratch), "no_case");
  expect_refused(run(kProgram + " attempt show x --library " + library, scratch), "no_attempt");
  expect_refused(run(kProgram + " replay x --verify --library " + library, scratch), "no_attempt");
  expect_refused(run(kProgram + " simulate --case x --operator expert --library " + library, scratch), "no_case");
}

TEST(Cli, ImportAnswersTheContractAndTheTitleIsNotTheSources) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("cli_import");
  const std::string library = (scratch / "library").string();
  const auto ran =
      run(kProgram + " import " + kData + "/ct-abdomen-contrast-dicom --library " + library + " --json", scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json answer = Json::parse(ran.out);
  EXPECT_EQ(answer.at("size_voxels"), Json::parse("[512, 512, 35]"));
  EXPECT_NEAR(answer.at("spacing_mm")[0].get<double>(), 0.859375, 1e-9);
  EXPECT_NEAR(answer.at("spacing_mm")[2].get<double>(), 5.0, 1e-9);
  EXPECT_EQ(answer.at("slices_used"), 35);
  EXPECT_EQ(answer.at("hu_min"), -1024);
  EXPECT_EQ(answer.at("hu_max"), 3071);
  ASSERT_EQ(answer.at("lps_from_voxel").size(), 16U);
  EXPECT_NEAR(answer.at("lps_from_voxel")[11].get<double>(), -178.3, 0.05) << "row-major: z of the first voxel";
  EXPECT_EQ(answer.at("title").get<std::string>().find("C3L"), std::string::npos);
  EXPECT_EQ(answer.at("tissue").at("contrast_phase"), "venous");
  std::set<std::string> named;
  for (const Json& one : answer.at("organs"))
    if (one.at("named").get<bool>()) named.insert(one.at("organ").get<std::string>());
  EXPECT_TRUE(named.count("spleen") == 1 && named.count("aorta") == 1) << answer.at("organs");
  // Nothing of the DICOM's identity is anywhere in the library.
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library)) {
    if (!entry.is_regular_file()) continue;
    const std::string bytes = fixtures::whole_file(entry.path());
    for (const char* identity : {"C3L-00189", "CPTAC", "1.3.6.1.4.1.14519"})
      EXPECT_EQ(bytes.find(identity), std::string::npos) << entry.path() << " holds " << identity;
  }
  const std::string case_id = answer.at("case_id").get<std::string>();
  const auto sample =
      run(kProgram + " sample " + case_id + " --library " + library + " --lps -115,-5,-98 --lps 0,0,9999 --json",
          scratch);
  const Json samples = Json::parse(sample.out).at("samples");
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[0].at("lps_mm"), Json::parse("[-115.0, -5.0, -98.0]"));
  EXPECT_EQ(samples[0].at("class"), "soft_tissue");
  for (const char* field : {"organ", "confidence"}) EXPECT_TRUE(samples[0].contains(field)) << field;
  for (const char* field : {"class", "organ", "confidence"}) EXPECT_TRUE(samples[1].at(field).is_null()) << field;
  EXPECT_TRUE(samples[1].at("hu_nearest").is_null());
  EXPECT_TRUE(samples[1].at("hu_trilinear").is_null());
  const auto lesion = run(kProgram + " case lesion " + case_id +
                              " --center-mm -115,-5,-98 --radius-mm 7.5 --hu 20 --library " + library + " --json",
                          scratch);
  ASSERT_EQ(lesion.exit_code, 0) << lesion.err;
  EXPECT_FALSE(Json::parse(lesion.out).at("lesion_id").get<std::string>().empty());
  const Json list = Json::parse(run(kProgram + " case list --json --library " + library, scratch).out);
  EXPECT_EQ(list.at("cases")[0].at("lesions").size(), 1U);
}

TEST(Cli, RenderIsTheScenesClosedForm) {
  const auto scratch = fixtures::fresh_folder("cli_render");
  write(scratch / "scene.json", std::string("{") + kBall + R"(,
    "needle": {"tip_mm": [0, 10, 0], "direction": [0, 1, 0], "length_mm": 100, "radius_mm": 3},
    "lesions": [{"center_mm": [30, 0, 0], "radius_mm": 8, "hu": 20}],
    "view": {"kind": "mpr", "center_mm": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0], "pixel_mm": 1, "size_px": [81, 61]}})");
  for (const char* backend : {"gpu", "cpu", "reference"}) {
    SCOPED_TRACE(backend);
    const auto ran = run(kProgram + " render " + (scratch / "scene.json").string() + " --out " +
                             (scratch / "picture.mha").string() + " --json --backend " + backend,
                         scratch);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(Json::parse(ran.out).at("visible").at("joint"), true);
    const std::string file = fixtures::whole_file(scratch / "picture.mha");
    ASSERT_GT(file.size(), 81U * 61U * 4U);
    std::vector<float> hu(81 * 61);
    std::memcpy(hu.data(), file.data() + file.size() - hu.size() * 4, hu.size() * 4);
    const auto at = [&](int x, int y) { return hu[static_cast<std::size_t>((y + 30) * 81 + (x + 40))]; };
    EXPECT_EQ(at(0, 0), 3000.0F) << "shaft";
    EXPECT_EQ(at(0, 9), 3000.0F);
    EXPECT_EQ(at(0, 12), 60.0F) << "beyond the tip";
    EXPECT_EQ(at(30, 0), 20.0F);
    EXPECT_EQ(at(-20, -20), 60.0F);
  }
  EXPECT_EQ(
      run(kProgram + " render " + (scratch / "scene.json").string() + " --out " + (scratch / "p.png").string(),
          scratch)
          .exit_code,
      0);
  EXPECT_EQ(fixtures::whole_file(scratch / "p.png").substr(1, 3), "PNG");
}

TEST(Cli, BadScenesSayEverythingThatIsWrong) {
  const auto scratch = fixtures::fresh_folder("cli_bad_scene");
  const std::string out = " --out " + (scratch / "p.mha").string();
  write(scratch / "a.json", std::string("{") + kBall + R"(,"needle": {"tip_mm": [0, 0], "direction": [0, 2, 0]},
    "view": {"kind": "mpr", "center_mm": [0, 0, 0], "u": [1, 0, 0], "v": [1, 0, 0], "pixel_mm": -1, "size_px": [10, 0]}})");
  const auto ran = run(kProgram + " render " + (scratch / "a.json").string() + out, scratch);
  expect_refused(ran, "bad_scene");
  for (const char* part : {"needle.tip_mm", "needle.direction", "view.v", "view.pixel_mm", "view.size_px"})
    EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "p.mha"));
  for (const char* text : {"", "[]", "{", "{\"volume\": 3}", "{\"view\": {\"kind\": \"mpr\"}}"}) {
    write(scratch / "b.json", text);
    expect_refused(run(kProgram + " render " + (scratch / "b.json").string() + out, scratch), "bad_scene");
  }
  write(scratch / "d.json", R"({"volume": "none.nii.gz", "view": {"kind": "mpr", "center_mm": [0,0,0], "u": [1,0,0],
    "v": [0,1,0], "pixel_mm": 1, "size_px": [4, 4]}})");
  expect_refused(run(kProgram + " render " + (scratch / "d.json").string() + out, scratch), "not_found");
}

// One row per 10 ms: down along +y from 20 mm outside the ball into its middle.
std::string poses(double end_y_mm, double plane_z_mm) {
  std::ostringstream csv;
  csv << "t_s,needle_tip_x_mm,needle_tip_y_mm,needle_tip_z_mm,needle_dir_x,needle_dir_y,needle_dir_z,probe_origin_"
         "x_mm,"
         "probe_origin_y_mm,probe_origin_z_mm,probe_axial_x,probe_axial_y,probe_axial_z,probe_lateral_x,probe_"
         "lateral_y,"
         "probe_lateral_z,fire\n";
  const int n = static_cast<int>(std::lround((end_y_mm + 80.0) / 0.2));
  for (int i = 0; i <= n; ++i)
    csv << i * 0.01 << ",0," << -80.0 + i * 0.2 << ",0,0,1,0,0,-60," << plane_z_mm << ",0,1,0,1,0,0,"
        << (i == n ? 1 : 0) << "\n";
  return csv.str();
}

// In a fixed X-ray view: an opaque target is seen all the way, the needle too; what the beam did is not known.
TEST(Cli, ScoreOfAPoseFileInAnXrayView) {
  const auto scratch = fixtures::fresh_folder("cli_score_xray");
  write(scratch / "scene.json",
        std::string("{") + kBall + R"(, "needle": {"tip_mm": [0, 0, 0], "direction": [0, 1, 0]},
    "lesions": [{"center_mm": [0, 0, 0], "radius_mm": 8, "hu": 600}],
    "view": {"kind": "xray", "source_mm": [700, 0, 0], "detector_center_mm": [-300, 0, 0], "u": [0, 1, 0],
             "v": [0, 0, -1], "pixel_mm": 1, "size_px": [256, 256]}})");
  write(scratch / "poses.csv", poses(0.0, 0.0));
  const auto ran = run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                           (scratch / "scene.json").string() + " --json",
                       scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::map<std::string, Json> metrics;
  const Json answer = Json::parse(ran.out);
  for (const Json& metric : answer.at("metrics")) metrics[metric.at("id")] = metric;
  EXPECT_EQ(metrics.at("hit").at("value"), 1.0);
  EXPECT_EQ(metrics.at("vis_target").at("value"), 1.0);
  EXPECT_EQ(metrics.at("vis_needle").at("value"), 1.0);
  EXPECT_TRUE(metrics.at("dap").at("value").is_null());
  EXPECT_EQ(metrics.at("dap").at("reason"), "beam_not_recorded");
}

TEST(Cli, ScoreOfAPoseFileIsItsClosedForm) {
  const auto scratch = fixtures::fresh_folder("cli_score");
  write(scratch / "scene.json",
        std::string("{") + kBall + R"(, "needle": {"tip_mm": [0, 0, 0], "direction": [0, 1, 0]},
    "lesions": [{"center_mm": [0, 5, 0], "radius_mm": 8, "hu": 20}],
    "view": {"kind": "mpr", "center_mm": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0], "pixel_mm": 0.5, "size_px": [200, 200]}})");
  const auto score = [&](double end_y_mm, double plane_z_mm) {
    write(scratch / "poses.csv", poses(end_y_mm, plane_z_mm));
    const auto ran = run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                             (scratch / "scene.json").string() + " --json",
                         scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    std::map<std::string, Json> values;
    const Json answer = Json::parse(ran.out);
    for (const Json& metric : answer.at("metrics")) values[metric.at("id")] = metric.at("value");
    return values;
  };
  auto values = score(0.0, 0.0);
  EXPECT_EQ(values.at("hit"), 1.0);
  EXPECT_NEAR(values.at("tip_target_dist").get<double>(), 5.0, 1e-6);
  EXPECT_NEAR(values.at("tip_target_surface").get<double>(), -3.0, 1e-6);
  EXPECT_NEAR(values.at("time_total").get<double>(), 4.0, 1e-6);
  EXPECT_NEAR(values.at("path_tip").get<double>(), 80.0, 0.08);
  EXPECT_EQ(values.at("skin_punctures"), 1.0);
  EXPECT_EQ(values.at("withdrawals_partial"), 0.0);
  EXPECT_EQ(values.at("withdrawals_full"), 0.0);
  EXPECT_NEAR(values.at("vis_joint").get<double>(), 1.0, 0.01);
  values = score(-20.0, 3.0);
  EXPECT_EQ(values.at("hit"), 0.0);
  EXPECT_NEAR(values.at("vis_needle").get<double>(), 0.0, 1e-9) << "the plane is 3 mm beside";
  write(scratch / "poses.csv", "t_s,fire\n0,1\n");
  expect_refused(run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                         (scratch / "scene.json").string(),
                     scratch),
                 "bad_csv");
}

TEST(Cli, ScoreHoldsTheWayAgainstAScenesStructures) {
  const auto scratch = fixtures::fresh_folder("cli_score_structures");
  const auto scene = [&](const std::string& rule) {
    write(scratch / "scene.json",
          std::string("{") + kBall + R"(, "needle": {"tip_mm": [0, 0, 0], "direction": [0, 1, 0]},
    "lesions": [{"center_mm": [0, 0, 0], "radius_mm": 8, "hu": 20}], "approach": "out_of_plane", "planned_entry_mm": [0, -60, 8],
    "structures": [
      {"name": "vein", "rule": ")" +
              rule + R"(", "kind": "tube", "points_mm": [[-20, -30, 3], [20, -30, 3]], "radius_mm": 5},
      {"name": "organ", "rule": "organ", "kind": "sphere", "center_mm": [0, 0, 0], "radius_mm": 40},
      {"name": "shell", "rule": "must_cross", "kind": "ellipsoid", "center_mm": [0, -15, 0], "radii_mm": [20, 6, 20]},
      {"name": "lumen", "rule": "target", "kind": "sphere", "center_mm": [0, 0, 0], "radius_mm": 7}],
    "view": {"kind": "mpr", "center_mm": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0], "pixel_mm": 0.5, "size_px": [200, 200]}})");
    return run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                   (scratch / "scene.json").string() + " --json",
               scratch);
  };
  write(scratch / "poses.csv", poses(0.0, 0.0));
  const auto ran = scene("critical");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::map<std::string, Json> metrics;
  const Json answer = Json::parse(ran.out);
  for (const Json& metric : answer.at("metrics")) metrics[metric.at("id")] = metric;
  const auto value = [&](const char* id) { return metrics.at(id).at("value").get<double>(); };
  EXPECT_EQ(value("nogo_contacts"), 1.0);
  EXPECT_NEAR(value("nogo_length_critical"), 8.0, 0.01) << "a chord 3 mm beside the middle";
  EXPECT_NEAR(value("clearance_min"), -2.0, 0.05);
  EXPECT_EQ(value("capsule_punctures"), 1.0);
  EXPECT_NEAR(value("must_cross_length"), 12.0, 1e-3);
  EXPECT_EQ(value("posterior_wall"), 0.0);
  EXPECT_NEAR(value("back_wall_dist"), 7.0, 1e-3);
  EXPECT_EQ(metrics.at("nogo_length_major").at("reason"), "no_major_structure");
  EXPECT_EQ(metrics.at("blind_advance").at("reason"), "not_meaningful_out_of_plane");
  EXPECT_EQ(metrics.at("force_peak_axial").at("reason"), "no_device");
  EXPECT_NEAR(value("entry_angle_error"), std::atan2(8.0, 60.0) * 180.0 / std::acos(-1.0), 1e-3);
  EXPECT_NEAR(value("entry_point_error"), 8.0, 0.5) << "the ball's skin is made of voxels of 2 mm";
  expect_refused(scene("forbidden"), "bad_scene");
}

TEST(Cli, ASceneWithoutABodyHasNullSkinMetricsOnly) {
  const auto scratch = fixtures::fresh_folder("cli_no_body");
  write(scratch / "scene.json", R"({"volume": {"analytic": {"size_voxels": [20, 20, 20], "spacing_mm": [2, 2, 2],
    "origin_mm": [0, 0, 0]}}, "lesions": [{"center_mm": [0, 5, 0], "radius_mm": 8, "hu": 20}]})");
  write(scratch / "poses.csv", poses(0.0, 0.0));
  const auto ran = run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                           (scratch / "scene.json").string() + " --json",
                       scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json answer = Json::parse(ran.out);
  for (const Json& metric : answer.at("metrics")) {
    const std::string id = metric.at("id");
    if (id == "hit") {
      EXPECT_EQ(metric.at("value"), 1.0);
    }
    if (id == "skin_punctures" || id == "vis_target") {
      EXPECT_EQ(metric.at("reason"), "no_skin") << id;
    }
  }
}

TEST(Cli, RefusedDemosAndUsersMakeNoLibrary) {
  const auto scratch = fixtures::fresh_folder("cli_no_library");
  const std::string library = (scratch / "library").string();
  std::filesystem::create_directories(scratch / "empty");
  expect_refused(
      run(kProgram + " demo --no-serve --ct " + (scratch / "empty").string() + " --library " + library, scratch));
  // demo had no --series, which import tells to choose by.
  write(scratch / "ct.mha", "ObjectType = Image\n");
  const std::string demo = kProgram + " demo --no-serve --library " + library;
  const std::string ct = " --ct " + (scratch / "ct.mha").string();
  for (const std::string more : {"", " --cases"}) {
    expect_refused(run(demo + more + ct + " --series 2", scratch), "no_series");
    EXPECT_EQ(run(demo + more + " --series 2", scratch).exit_code, 2);
    EXPECT_EQ(run(demo + more + ct + ct + " --series 2", scratch).exit_code, 2);
  }
  expect_refused(
      run("echo short | " + kProgram + " user add Bob --role trainee --new-library --library " + library, scratch),
      "weak_password");
  // Only a command that says so makes a library.
  expect_refused(
      run("echo a long password | " + kProgram + " user add Bob --role trainee --library " + library, scratch),
      "no_library");
  expect_refused(run(kProgram + " doctor --library " + library, scratch), "no_library");
  EXPECT_FALSE(std::filesystem::exists(library));
}

TEST(Cli, AnObliquePlaneOfThreeDecimalsIsAccepted) {
  const auto scratch = fixtures::fresh_folder("cli_oblique");
  write(scratch / "scene.json", std::string("{") + kBall + R"(,"view": {"kind": "mpr", "center_mm": [0, 0, 0],
    "u": [0.577, 0.577, 0.578], "v": [0.707, -0.707, 0.0], "pixel_mm": 1, "size_px": [8, 8]}})");
  const auto ran =
      run(kProgram + " render " + (scratch / "scene.json").string() + " --out " + (scratch / "p.mha").string(),
          scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST(Cli, UsersNeedGoodPasswordsAndUniqueNames) {
  const auto scratch = fixtures::fresh_folder("cli_users");
  const std::string library = (scratch / "library").string();
  const auto add = [&](const std::string& name, const std::string& role, const std::string& password) {
    return run("printf '%s\\n' '" + password + "' | " + kProgram + " user add '" + name + "' --role " + role +
                   " --new-library --library " + library,
               scratch);
  };
  EXPECT_EQ(add("Ada", "mentor", "a good long password").exit_code, 0);
  expect_refused(add("ada", "trainee", "another good password"), "name_taken");
  expect_refused(add("Bob", "trainee", "short"), "weak_password");
  expect_refused(add(" Bob", "trainee", "a good long password"), "bad_name");
  EXPECT_EQ(add("Bob", "surgeon", "a good long password").exit_code, 2);
  const auto list = run(kProgram + " user list --json --library " + library, scratch);
  EXPECT_EQ(Json::parse(list.out).at("users").size(), 1U);
  EXPECT_EQ(fixtures::whole_file(library + "/seldinger.sqlite").find("Ada"), std::string::npos)
      << "names live apart from performance";
}

TEST(Cli, DoctorSaysWhatIsHere) {
  const auto scratch = fixtures::fresh_folder("cli_doctor");
  const std::string home =
      "env -u SELDINGER_LIBRARY XDG_DATA_HOME='" + scratch.string() + "/home' DISPLAY= WAYLAND_DISPLAY= ";
  const auto ran = run(home + kProgram + " doctor --json", scratch);
  EXPECT_EQ(ran.exit_code, 1) << "without a display nobody trains";
  const Json facts = Json::parse(ran.out);
  for (const char* fact : {"version", "gl", "devices", "real_time", "readers", "films", "library_folder"})
    EXPECT_TRUE(facts.contains(fact)) << fact;
  EXPECT_EQ(facts.at("display"), "none");
  EXPECT_EQ(facts.at("can_train"), "no");
  EXPECT_EQ(facts.at("why").at(0), "there is no display to open the window on");
  const auto text = run(home + kProgram + " doctor", scratch);
  EXPECT_NE(text.out.find("\ncan train: no\n  there is no display"), std::string::npos) << text.out;
  EXPECT_FALSE(std::filesystem::exists(scratch / "home")) << "looking makes no library";
}

}  // namespace
}  // namespace seldinger
