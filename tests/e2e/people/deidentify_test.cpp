// No identifier of a source comes into a library or out of a program: more than 750 different ones, planted in
// every element of the standard's de-identification table, in six transfer syntaxes, are looked for in every byte
// that is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <iostream>
#include <nlohmann/json.hpp>

#include "sim/base/codec.h"
#include "tests/casedb/export/planted_dicom.h"
#include "tests/casedb/import/head_phantom.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using fixtures::run;

using fixtures::kData;
using fixtures::kProgram;

std::string quoted(const fs::path& path) {
  std::string text = path.string();
  text.insert(text.begin(), '\'');
  text.push_back('\'');
  return text;
}

// All bytes below a folder, names of files, and what packed assets hold.
std::string everything_in(const fs::path& folder) {
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    all += fs::relative(entry.path(), folder).string() + "\n";
    if (!entry.is_regular_file()) continue;
    const std::string bytes = fixtures::whole_file(entry.path());
    all += bytes + "\n";
    const auto unpacked = base::decompress(std::as_bytes(std::span(bytes)), std::size_t{1} << 30);
    if (!unpacked) continue;
    for (const std::byte byte : *unpacked) all += static_cast<char>(byte);
  }
  return all;
}

class NoIdentifier : public testing::Test {
 protected:
  void expect_none(const std::string& bytes, const std::vector<std::string>& identifiers,
                   const std::string& where) {
    const auto found = survivors(bytes, identifiers);
    EXPECT_TRUE(found.empty()) << found.size() << " in " << where << ", as " << found.front();
    survived_ += found.size();
    searched_ += bytes.size();
  }
  fs::path folder_ = fixtures::fresh_folder(std::string("e2e_deidentify_") +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
  std::size_t survived_ = 0, searched_ = 0;
};

TEST_F(NoIdentifier, ComesIntoALibrary) {
  SELDINGER_NEEDS_SHARED_DATA();
  std::size_t planted = 0;
  for (const PlantedSyntax syntax : kPlantedSyntaxes) {
    const std::string number = std::to_string(static_cast<int>(syntax));
    const fs::path source = folder_ / ("PLNTSOURCE" + number), library = folder_ / ("library" + number);
    auto identifiers = plant_series(source, syntax);
    identifiers.emplace_back("PLNTSOURCE");
    planted += identifiers.size();
    ASSERT_GE(identifiers.size(), 750U);
    const auto imported = run(
        kProgram + " import " + quoted(source) + " --library " + quoted(library) + " --no-burned-in-text --json",
        folder_ / "run");
    ASSERT_EQ(imported.exit_code, 0) << imported.err;
    const Json answer = Json::parse(imported.out);
    EXPECT_LE(answer.at("attributes").size(), 25U);
    EXPECT_EQ(answer.at("face_state"), "none");
    EXPECT_FALSE(answer.at("burned_in_checked").is_null());
    EXPECT_GT(answer.at("burned_in_checked").at("checked_us").get<std::int64_t>(), 0);
    // What stayed outside is counted: every top-level element of the table, over three slices.
    std::map<std::string, std::int64_t> reasons;
    bool name = false, kernel = false;
    for (const Json& one : answer.at("dropped")) {
      reasons[one.at("reason")] += one.at("count").get<std::int64_t>();
      name = name || (one.at("keyword") == "PatientName" && one.at("tag") == "0010,0010" && one.at("count") == 3);
      kernel = kernel || (one.at("tag") == "0018,1210" && one.at("reason") == "value_not_accepted");
    }
    EXPECT_TRUE(name && kernel) << imported.out;
    EXPECT_GT(reasons["not_on_the_list"], 3 * 500);
    EXPECT_EQ(reasons["private"], 3 * 6);
    const std::string case_id = answer.at("case_id");
    std::string said = imported.out + imported.err;
    for (const std::string& command : {"case show " + case_id, "case show " + case_id + " --json",
                                       std::string("case list"), std::string("case list --json")}) {
      const auto ran = run(kProgram + " " + command + " --library " + quoted(library), folder_ / "run");
      EXPECT_EQ(ran.exit_code, 0);
      said += ran.out + ran.err;
    }
    expect_none(said, identifiers, "what is printed");
    expect_none(everything_in(library), identifiers, "the library");
  }
  std::cout << "[ import ] " << survived_ << " of " << planted << " identifiers survive in " << searched_
            << " bytes, 6 transfer syntaxes\n";
}

TEST_F(NoIdentifier, IsInARefusal) {
  const fs::path source = folder_ / "PLNTSOURCE", library = folder_ / "library";
  auto identifiers = plant_series(source, PlantedSyntax::explicit_le);
  identifiers.emplace_back("PLNTSOURCE");
  const fs::path slice = source / "PLNTFILE^NAME^1.dcm";
  const std::string whole = fixtures::whole_file(slice);
  for (const double share : {0.02, 0.3, 0.6, 0.9, 0.97}) {
    std::ofstream(slice, std::ios::binary)
        << whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
    const std::pair<std::string, fs::path> calls[] = {
        {"import " + quoted(source) + " --library " + quoted(library), source},
        {"import " + quoted(slice) + " --library " + quoted(library), slice},
        {"deidentify " + quoted(source) + " " + quoted(folder_ / "out"), source},
        {"deidentify " + quoted(slice) + " " + quoted(folder_ / "out.dcm"), slice}};
    for (const auto& [command, typed] : calls) {
      const auto ran = run(kProgram + " " + command, folder_ / "run");
      EXPECT_EQ(ran.exit_code, 3) << command << ran.out;
      EXPECT_FALSE(ran.err.empty());
      // What was typed may be said again, once, to whoever typed it; of what lies in a folder nothing is named.
      std::string said = ran.out + ran.err;
      const std::string again = '"' + typed.string() + "\": ";
      if (const std::size_t at = said.find(again); at != said.npos) said.erase(at, again.size());
      expect_none(said, identifiers, "a refusal");
    }
    EXPECT_FALSE(fs::exists(library));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(NoIdentifier, IsInWhatDeidentifyWrites) {
  SELDINGER_NEEDS_SHARED_DATA();
  // A key of our own: among thousands of digits drawn anew each time, a planted date of eight turns up by chance.
  const fs::path key = folder_ / "key";
  std::ofstream(key) << std::string(64, '5') << "\n";
  for (const PlantedSyntax syntax : kPlantedSyntaxes) {
    const std::string number = std::to_string(static_cast<int>(syntax));
    const fs::path source = folder_ / ("PLNTSOURCE" + number), out = folder_ / ("out" + number);
    const auto identifiers = plant_series(source, syntax);
    const auto ran =
        run(kProgram + " deidentify " + quoted(source) + " " + quoted(out) + " --json --key " + quoted(key),
            folder_ / "run");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(Json::parse(ran.out).at("files"), 3);
    expect_none(ran.out + ran.err + everything_in(out), identifiers, "what deidentify writes");
    // It still is the series that it was.
    const auto imported =
        run(kProgram + " import " + quoted(out) + " --library " + quoted(folder_ / "library") + " --json",
            folder_ / "run");
    ASSERT_EQ(imported.exit_code, 0) << imported.err;
    EXPECT_EQ(Json::parse(imported.out).at("slices_used"), 3);
    EXPECT_TRUE(Json::parse(imported.out).at("burned_in_checked").is_null());
  }
}

TEST_F(NoIdentifier, KeysKeepUidsConsistentOnlyWhenTheyAreKept) {
  const fs::path source = folder_ / "in";
  plant_series(source, PlantedSyntax::explicit_le);
  const auto bytes = [&](const std::string& out, const std::string& options) {
    const auto ran =
        run(kProgram + " deidentify " + quoted(source) + " " + quoted(folder_ / out) + options, folder_ / "run");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return fixtures::whole_file(folder_ / out / "image_000001.dcm");
  };
  const std::string key = " --key " + quoted(folder_ / "key");
  const std::string first = bytes("a", key), again = bytes("b", key), fresh = bytes("c", ""),
                    other = bytes("d", "");
  EXPECT_EQ(first, again);
  EXPECT_NE(first, fresh);
  EXPECT_NE(fresh, other);
  EXPECT_EQ(fs::status(folder_ / "key").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  std::ofstream(folder_ / "key") << "short";
  EXPECT_EQ(run(kProgram + " deidentify " + quoted(source) + " " + quoted(folder_ / "e") + key, folder_ / "run")
                .exit_code,
            3);
}

// A phantom of a head, as a MetaImage.
volume::Volume write_head(const fs::path& file) {
  HeadView view;
  view.from_z_mm = -260.0;
  volume::Volume head = head_volume(view);
  const glm::dvec4& origin = head.lps_from_voxel[3];
  std::ofstream out(file, std::ios::binary);
  out << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      << "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = " << origin.x << " " << origin.y << " " << origin.z
      << "\nElementSpacing = 2.5 2.5 3\nDimSize = " << head.size_voxels.x << " " << head.size_voxels.y << " "
      << head.size_voxels.z << "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  const auto bytes = std::as_bytes(std::span(head.hu));
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return head;
}

TEST_F(NoIdentifier, AFaceIsRefusedCroppedOrTakenAway) {
  const volume::Volume head = write_head(folder_ / "head.mha");
  const auto import = [&](const std::string& options) {
    return run(kProgram + " import " + quoted(folder_ / "head.mha") + " --library " + quoted(folder_ / "library") +
                   options + " --json",
               folder_ / "run");
  };
  const auto refused = import("");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.err.rfind("error: face: ", 0), 0U) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "library"));
  EXPECT_EQ(import(" --face keep").exit_code, 2);
  const auto cropped = import(" --face crop"), defaced = import(" --face deface");
  ASSERT_EQ(cropped.exit_code, 0) << cropped.err;
  ASSERT_EQ(defaced.exit_code, 0) << defaced.err;
  EXPECT_EQ(Json::parse(cropped.out).at("face_state"), "cropped");
  EXPECT_LT(Json::parse(cropped.out).at("size_voxels").at(2).get<int>(), head.size_voxels.z / 2);
  EXPECT_EQ(Json::parse(defaced.out).at("face_state"), "defaced");
  EXPECT_EQ(Json::parse(defaced.out).at("size_voxels").at(2).get<int>(), head.size_voxels.z);
}

// Knees and infants' trunks look like faces to the detector (docs/decisions/0017): an admin may say so.
TEST_F(NoIdentifier, AnAdminOverrulesTheDetectorOfFacesWithAReason) {
  const volume::Volume head = write_head(folder_ / "knees.mha");
  const std::string to = " --library " + quoted(folder_ / "library");
  const auto import = [&](const std::string& options) {
    return run(kProgram + " import " + quoted(folder_ / "knees.mha") + to + options + " --json", folder_ / "run");
  };
  // Nobody is known where there is no library.
  EXPECT_EQ(import(" --face overrule --reason knees --by ada").exit_code, 3);
  EXPECT_FALSE(fs::exists(folder_ / "library"));
  ASSERT_EQ(import(" --face deface").exit_code, 0);
  for (const std::string account : {"ada --role admin", "mona --role mentor"})
    ASSERT_EQ(
        run("printf 'a long password' | " + kProgram + " user add " + account + to, folder_ / "run").exit_code, 0);
  EXPECT_EQ(import(" --face overrule --reason knees").exit_code, 2) << "by whom";
  EXPECT_EQ(import(" --face overrule --by ada").exit_code, 2) << "why";
  EXPECT_EQ(import(" --face overrule --reason '  ' --by ada").exit_code, 2) << "why";
  EXPECT_EQ(import(" --face crop --reason knees --by ada").exit_code, 2);
  const auto by_mentor = import(" --face overrule --reason knees --by mona");
  EXPECT_EQ(by_mentor.exit_code, 3);
  EXPECT_EQ(by_mentor.err.rfind("error: not_allowed: ", 0), 0U) << by_mentor.err;
  EXPECT_EQ(import(" --face overrule --reason \"$(printf 'a\\nb')\" --by ada").err.rfind("error: bad_note: ", 0),
            0U);
  const auto by_admin = import(" --face overrule --reason 'both knees, no head' --by ada");
  ASSERT_EQ(by_admin.exit_code, 0) << by_admin.err;
  const Json made = Json::parse(by_admin.out);
  EXPECT_EQ(made.at("face_state"), "none");
  EXPECT_EQ(made.at("hu_max"), *std::max_element(head.hu.begin(), head.hu.end())) << "nothing is taken away";
  const Json kept = {{"code", "face_overruled"}, {"text", "both knees, no head"}};
  EXPECT_NE(std::find(made.at("warnings").begin(), made.at("warnings").end(), kept), made.at("warnings").end());
  const std::string case_id = made.at("case_id").get<std::string>();
  const auto shown = run(kProgram + " case show " + case_id + to, folder_ / "run");
  EXPECT_NE(shown.out.find("overruled by an admin"), std::string::npos) << shown.out;
  const auto log = run(kProgram + " audit --json" + to, folder_ / "run");
  int overruled = 0;
  const Json rows = Json::parse(log.out).at("audit");
  for (const Json& row : rows)
    if (row.at("act") == "overrule_face") {
      ++overruled;
      EXPECT_EQ(row.at("object_id"), case_id);
      EXPECT_TRUE(row.at("person_id").is_string());
    }
  EXPECT_EQ(overruled, 1);
  EXPECT_EQ(log.out.find("knees"), std::string::npos) << "numbers and codes only";
}

TEST_F(NoIdentifier, SomebodyWhoMayConfirmsThatNoTextIsBurnedIn) {
  SELDINGER_NEEDS_SHARED_DATA();
  const fs::path library = folder_ / "library";
  const std::string source = quoted(fs::path(kData) / "dicom-samples/CT_small.dcm"),
                    to = " --library " + quoted(library);
  const auto add = [&](const std::string& name, const std::string& role) {
    EXPECT_EQ(run("printf 'a long password' | " + kProgram + " user add " + name + " --role " + role +
                      " --new-library" + to,
                  folder_ / "run")
                  .exit_code,
              0);
  };
  add("olga", "mentor");
  add("tom", "trainee");
  const auto import = [&](const std::string& options) {
    return run(kProgram + " import " + source + to + options + " --json", folder_ / "run");
  };
  const auto by_olga = import(" --no-burned-in-text --by olga");
  ASSERT_EQ(by_olga.exit_code, 0) << by_olga.err;
  EXPECT_TRUE(Json::parse(by_olga.out).at("burned_in_checked").at("person_id").is_string());
  EXPECT_EQ(by_olga.out.find("olga"), std::string::npos);
  const Json later = Json::parse(import(" --denoise 5").out);
  EXPECT_TRUE(later.at("burned_in_checked").is_null());
  const auto& warnings = later.at("warnings");
  EXPECT_TRUE(
      std::any_of(warnings.begin(), warnings.end(), [](const Json& one) { return one.at("code") == "denoised"; }));
  const std::string confirm = kProgram + " case confirm " + later.at("case_id").get<std::string>() + to + " --by ";
  EXPECT_EQ(run(confirm + "olga", folder_ / "run").exit_code, 2) << "what is confirmed is said";
  EXPECT_EQ(run(confirm + "tom --no-burned-in-text", folder_ / "run").exit_code, 3);
  EXPECT_EQ(run(confirm + "olga --no-burned-in-text", folder_ / "run").exit_code, 0);
  const auto shown =
      run(kProgram + " case show " + later.at("case_id").get<std::string>() + to + " --json", folder_ / "run");
  EXPECT_TRUE(Json::parse(shown.out).at("burned_in_checked").at("person_id").is_string());
  const auto by_tom = import(" --no-burned-in-text --by tom"), by_nobody = import(" --no-burned-in-text --by eve");
  EXPECT_EQ(by_tom.exit_code, 3);
  EXPECT_EQ(by_tom.err.rfind("error: not_allowed: ", 0), 0U) << by_tom.err;
  EXPECT_EQ(by_nobody.err.rfind("error: no_user: ", 0), 0U) << by_nobody.err;
  EXPECT_EQ(import(" --by olga").exit_code, 0) << "without looking at the slices";
  EXPECT_EQ(Json::parse(by_olga.out).at("burned_in_checked").at("by_operator"), true)
      << "nobody has proven to be olga";
}

}  // namespace
}  // namespace seldinger::casedb
