// Every example of help and of docs/commands.md, typed one after the other as they stand there, in an empty folder
// with a home of its own: each command of the program has one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "casedb/export/dicom_series.h"
#include "sim/volume/phantom.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/page_commands.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using fixtures::kProgram;
using fixtures::with;

// What cannot end well here, and how it ends; where it does is said beside it.
const std::map<std::string, std::string> kRefused = {
    {"train --library first-hour", "error: display: "},    // tests/e2e/window/train_test.cpp
    {"simulate answers CODE", "error: round_in_use: "},    // tests/casedb/ratings
    {"standard set Built --by dora", "error: no_rule: "},  // tests/casedb/grading
    {"device probe --seconds 1", "error: no_device: "},    // tests/e2e/device_test.cpp
};

class Examples : public testing::Test {
 protected:
  const fs::path folder_ = fixtures::fresh_folder("examples"), at_ = folder_ / "here", home_ = folder_ / "home";
  std::string case_, text_, key_, code_, rated_, day_;

  void SetUp() override {
    for (const fs::path& one : {at_ / "ct", at_ / "docs", home_}) fs::create_directories(one);
    fs::copy(fixtures::source_dir() / "docs" / "scenes", at_ / "docs" / "scenes", fs::copy_options::recursive);
    // A torso as a scanner would give it, so coarse that it is read at once.
    volume::PhantomOptions coarse;
    coarse.spacing_mm = {3.0, 3.0, 6.0};
    ASSERT_TRUE(casedb::write_dicom_series(volume::make_phantom(coarse).volume, {"a torso"}, at_ / "ct"));
    std::ofstream(at_ / "consent.txt") << "May your attempts be used?\n";
    std::ofstream(at_ / "password.txt") << "a password\n";
    std::ofstream(at_ / "labels.mha", std::ios::binary)
        << "ObjectType = Image\nBinaryData = True\nNDims = 3\nDimSize = 2 2 2\nElementSpacing = 4 4 4\nOffset = 0 "
           "0 0\n"
           "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        << std::string(8, '\1');
    std::ofstream(at_ / "meeting.csv") << "mm,rating\n9,1\n8,1\n7,2\n6.5,2\n5,3\n4,3\n3,4\n2,4\n";
    std::ofstream(at_ / "scores.csv") << "score,experience,before,after\n61,novice,50,61\n55,novice,48,55\n"
                                         "80,expert,79,80\n91,expert,83,91\n";
    for (const char* typed : {"first.csv", "second.csv"})
      std::ofstream(at_ / typed) << "respondent,version,group,1,2,3,4,5,6a,6b,7,8a,8b,8c,8d,8e,8f,8g,8h,9\n"
                                    "A1,1,trainee,SpR,female,31,2,4,12,3,2,4,3,2,3,3,n/a,4,,good\n";
    // As the template of a device's calibration has them (docs/devices.md), 50 mm off along one axis.
    std::ofstream(at_ / "points.csv") << "point,x_mm,y_mm,z_mm\na,5,-64,-50\nb,5,64,-50\nc,-59,0,-50\nd,69,0,-50\n"
                                         "e,5,0,-50\nf,-12,11,93\n";
  }
  fixtures::Ran type(const std::string& line, const std::string& before = "", const std::string& after = "") {
    return fixtures::run("cd '" + at_.string() + "' && printf 'a password\\n' | env -u SELDINGER_LIBRARY HOME='" +
                             home_.string() + "' XDG_STATE_HOME='" + home_.string() +
                             "' XDG_DATA_HOME= DISPLAY= WAYLAND_DISPLAY= " + before + "'" + kProgram + "' " + line +
                             after,
                         folder_ / "said");
  }
  std::string settled(std::string line) {
    line = with(with(with(line, " CASE", " " + case_), " TEXT", " " + text_), " KEY", " " + key_);
    line = with(with(line, " CODE", " " + code_), " RATED", " " + rated_);
    line = with(line, " DAY", " " + day_);
    if (line.find(" CUT") != std::string::npos) {
      const Json cuts = Json::parse(type("standard cuts Built --json").out, nullptr, false);
      line = with(line, " CUT", " " + cuts["cuts"].at(0)["cut_id"].get<std::string>());
    }
    if (line.find(" ATTEMPT") == std::string::npos) return line;
    const Json listed = Json::parse(type("attempt list --json").out, nullptr, false);
    return with(line, "ATTEMPT", listed["attempts"].at(0)["attempt_id"].get<std::string>().substr(0, 30));
  }
};

TEST_F(Examples, AreTypedOneAfterTheOther) {
  for (const std::string_view example : app::examples()) {
    const std::string line(example);
    SCOPED_TRACE(line);
    std::string before, after;
    if (line.rfind("serve ", 0) == 0) before = "timeout --preserve-status -s INT 2 ", after = " --port 0";
    if (line.rfind("device probe", 0) == 0) after = " --port 1";
    if (line.rfind("device simulate", 0) == 0) after = " --port 0";
    const auto ran = type(line.rfind("serve ", 0) == 0 ? "serve" : settled(line), before, after);
    if (const auto refused = kRefused.find(line); refused != kRefused.end()) {
      EXPECT_EQ(ran.err.rfind(refused->second, 0), 0U) << ran.exit_code << ran.err;
      continue;
    }
    // There is no display here; whether of so few attempts a surrogate is off by more than chance, chance tells;
    // and how many ticks of hands are missed, whatever else the machine does.
    const bool by_chance =
        ran.exit_code == 1 && (line.rfind("surrogate check", 0) == 0 || line.rfind("haptics selftest", 0) == 0);
    EXPECT_EQ(ran.exit_code, line == "doctor" || by_chance ? 1 : 0) << ran.out << ran.err;
    if (line.rfind("recovery ", 0) == 0) {
      EXPECT_NE(ran.out.find("\n| Cuts between novices and experts |"), ran.out.npos) << ran.out;
    }
    if (line.rfind("study template", 0) == 0) {  // whoever plans puts words in
      const fs::path plan =
          at_ / line.substr(line.find("--out ") + 6, line.find(".json") + 5 - line.find("--out ") - 6);
      const std::string words = fixtures::answered(fixtures::whole_file(plan));
      std::ofstream(plan) << words;
    }
    if (line.rfind("case version", 0) == 0) case_ = ran.out.substr(5, 36);
    if (line.rfind("questionnaire open", 0) == 0) code_ = ran.out.substr(0, 6);
    if (line.rfind("workshop open", 0) == 0) day_ = ran.out.substr(0, 6);
    if (line.rfind("rating open", 0) == 0) rated_ = ran.out.substr(0, 6);
    if (line.rfind("bundle key", 0) == 0) key_ = ran.out.substr(0, 64);
    if (line.rfind("consent list", 0) == 0)
      text_ = Json::parse(type(line + " --json").out, nullptr, false)["consents"].at(0)["text_id"];
  }
}

}  // namespace
}  // namespace seldinger
