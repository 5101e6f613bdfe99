// Keeping a library by the commands: the routine of docs/keeping.md as it stands there, and what the commands
// answer.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;
namespace fs = std::filesystem;

using fixtures::kData;
using fixtures::kProgram;

class KeepTest : public testing::Test {
 protected:
  fs::path scratch_ =
      fixtures::fresh_folder(std::string("keep_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string library_ = (scratch_ / "library").string(), case_id_;

  void SetUp() override {
    SELDINGER_NEEDS_SHARED_DATA();
    const auto imported =
        command("import " + kData + "/dicom-samples/CT_small.dcm --title Small --json --library " + library_);
    ASSERT_EQ(imported.exit_code, 0) << imported.err;
    case_id_ = Json::parse(imported.out).at("case_id").get<std::string>();
    ASSERT_EQ(
        run("echo a-long-password | " + kProgram + " user add ann --role mentor --library " + library_, scratch_)
            .exit_code,
        0);
  }
  fixtures::Ran command(const std::string& words) { return run(kProgram + " " + words, scratch_); }
  std::string at(const char* name) const { return (scratch_ / name).string(); }
  void expect_refused(const std::string& words, const std::string& code) {
    const auto ran = command(words);
    EXPECT_EQ(ran.exit_code, 3) << words;
    EXPECT_EQ(ran.err.rfind("error: " + code + ": ", 0), 0U) << ran.err;
  }
};

TEST_F(KeepTest, BackupComesBack) {
  const auto copied = command("backup " + at("monday") + " --json --library " + library_);
  ASSERT_EQ(copied.exit_code, 0) << copied.err;
  EXPECT_GE(Json::parse(copied.out).at("files").get<int>(), 5);
  expect_refused("backup " + at("monday") + " --library " + library_, "exists");
  expect_refused("restore " + at("monday") + " --library " + library_, "exists");
  expect_refused("restore " + at("nowhere") + " --library " + at("again"), "no_backup");
  expect_refused("backup " + at("x") + " --library " + at("nowhere"), "no_library");
  ASSERT_EQ(command("restore " + at("monday") + " --library " + at("again")).exit_code, 0);
  EXPECT_EQ(command("case list --json --library " + at("again")).out,
            command("case list --json --library " + library_).out);
  EXPECT_EQ(command("user list --library " + at("again")).out, command("user list --library " + library_).out);
}

TEST_F(KeepTest, CheckTellsAndRepairs) {
  EXPECT_EQ(command("check --library " + library_).exit_code, 0);
  const fs::path assets = fs::path(library_) / "assets";
  std::ofstream(assets / std::string(64, 'a')) << "nobody's";
  const auto found = command("check --json --library " + library_);
  EXPECT_EQ(found.exit_code, 1);
  EXPECT_EQ(Json::parse(found.out).at("findings").at(0).at("code"), "asset_orphaned");
  EXPECT_FALSE(Json::parse(found.out).at("holds").get<bool>());
  const auto repaired = command("check --repair --library " + library_);
  EXPECT_EQ(repaired.exit_code, 0);
  EXPECT_NE(repaired.out.find("removed: asset_orphaned"), std::string::npos);
  EXPECT_EQ(command("check --library " + library_).exit_code, 0);
  fs::remove(fs::directory_iterator(assets)->path());
  EXPECT_EQ(command("check --repair --library " + library_).exit_code, 1);
  expect_refused("check --library " + at("nowhere"), "no_library");
}

TEST_F(KeepTest, WhatIsHurtIsNamedAndComesBack) {
  ASSERT_EQ(command("backup " + at("monday") + " --library " + library_).exit_code, 0);
  const fs::path asset = fs::directory_iterator(fs::path(library_) / "assets")->path();
  std::string bytes = fixtures::whole_file(asset);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(asset, std::ios::binary) << bytes;
  expect_refused("backup " + at("tuesday") + " --library " + library_, "asset_damaged");
  EXPECT_FALSE(fs::exists(at("tuesday")));
  EXPECT_EQ(command("check --from " + at("monday") + " --library " + library_).exit_code, 2);
  expect_refused("check --repair --from " + at("nowhere") + " --library " + library_, "no_backup");
  const auto healed = command("check --repair --from " + at("monday") + " --library " + library_);
  EXPECT_EQ(healed.exit_code, 0) << healed.err;
  EXPECT_NE(healed.out.find("healed: asset_damaged: the file " + asset.filename().string()), std::string::npos);
  EXPECT_EQ(command("backup " + at("tuesday") + " --library " + library_).exit_code, 0);
}

TEST_F(KeepTest, ACaseGoesToAnotherSite) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto written =
      command("case bundle " + case_id_ + " --out " + at("a.sdbundle") + " --json --library " + library_);
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(Json::parse(written.out).at("cases").at(0), case_id_);
  EXPECT_EQ(command("bundle check " + at("a.sdbundle")).exit_code, 0);
  EXPECT_EQ(command("bundle export --out " + at("all.sdbundle") + " --library " + library_).exit_code, 0);
  const std::string other = " --library " + at("other");
  ASSERT_EQ(
      run("echo a-long-password | " + kProgram + " user add bob --role mentor --new-library" + other, scratch_)
          .exit_code,
      0);
  const auto taken = command("bundle import " + at("a.sdbundle") + " --json" + other);
  ASSERT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_EQ(Json::parse(taken.out).at("stored").at(0), case_id_);
  const auto again = command("bundle import " + at("all.sdbundle") + " --json" + other);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out).at("present").at(0), case_id_);
  Json here = Json::parse(command("case show " + case_id_ + " --json --library " + library_).out);
  Json there = Json::parse(command("case show " + case_id_ + " --json" + other).out);
  EXPECT_TRUE(here.at("received").is_null());
  EXPECT_EQ(there.at("received").at("sender_says").at("face_state"), here.at("face_state"));
  EXPECT_EQ(there.at("face_state"), "unchecked");
  for (const char* own : {"received", "face_state"}) {
    here.erase(own);
    there.erase(own);
  }
  EXPECT_EQ(there, here);
  EXPECT_EQ(command("check" + other).exit_code, 0);

  const auto before = fixtures::fingerprint(scratch_ / "other");
  std::ofstream(scratch_ / "a.sdbundle", std::ios::app) << "x";
  expect_refused("bundle import " + at("a.sdbundle") + other, "damaged");
  expect_refused("bundle check " + at("a.sdbundle"), "damaged");
  expect_refused("bundle import " + kData + "/dicom-samples/CT_small.dcm" + other, "not_a_bundle");
  expect_refused("bundle import " + at("nowhere") + other, "not_found");
  expect_refused("case bundle " + std::string(36, '0') + " --out " + at("b") + other, "no_case");
  EXPECT_EQ(fixtures::fingerprint(scratch_ / "other"), before);
  EXPECT_FALSE(fs::exists(scratch_ / "b"));
}

TEST_F(KeepTest, ASignedBundleTellsWhoSent) {
  const std::string other = " --library " + at("other"), to_b = "bundle import " + at("b.sdbundle");
  const auto key = command("bundle key " + at("site.key"));
  ASSERT_EQ(key.exit_code, 0) << key.err;
  const std::string open_key = key.out.substr(0, 64);
  EXPECT_EQ(key.out, open_key + "\n");
  EXPECT_EQ(command("bundle key " + at("site.key")).out, key.out) << "the same key again";
  EXPECT_EQ(fs::status(at("site.key")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const std::string write = "case bundle " + case_id_ + " --out " + at("b.sdbundle") + " --library " + library_;
  expect_refused(write + " --sign " + at("nowhere.key"), "not_found");
  const auto written = command(write + " --json --sign " + at("site.key"));
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(Json::parse(written.out).at("signing_key"), open_key);
  EXPECT_NE(command("bundle check " + at("b.sdbundle")).out.find("signed by " + open_key), std::string::npos);

  // Into a new library, which is not made for what is refused.
  expect_refused(to_b + other, "no_library");
  std::string bytes = fixtures::whole_file(at("b.sdbundle")), bad = bytes;
  bad[bad.size() - 1] = static_cast<char>(bad.back() ^ 1);
  std::ofstream(at("b.sdbundle"), std::ios::binary) << bad;
  expect_refused(to_b + " --new-library" + other, "damaged");
  EXPECT_FALSE(fs::exists(at("other")));
  std::ofstream(at("b.sdbundle"), std::ios::binary) << bytes;
  const auto unknown = command(to_b + " --new-library" + other);
  ASSERT_EQ(unknown.exit_code, 0) << unknown.err;
  EXPECT_NE(unknown.out.find("signed by " + open_key + ", which is not trusted here"), std::string::npos);

  ASSERT_EQ(command("bundle trust add " + open_key + " --label 'Site A'" + other).exit_code, 0);
  expect_refused("bundle trust add " + open_key + " --label 'Site B'" + other, "key_known");
  EXPECT_EQ(Json::parse(command("bundle trust list --json" + other).out).at("trusted_keys").at(0).at("label"),
            "Site A");
  EXPECT_EQ(Json::parse(command(to_b + " --json" + other).out).at("trusted_as"), "Site A");
  EXPECT_NE(command("case show " + case_id_ + other).out.find("signed by Site A; its sender says: draft"),
            std::string::npos);
  EXPECT_EQ(command("bundle trust remove 'Site A'" + other).exit_code, 0);
  expect_refused("bundle trust remove 'Site A'" + other, "no_key");
  EXPECT_EQ(command("bundle trust forget" + other).exit_code, 2);
  EXPECT_EQ(command("bundle trust add" + other).exit_code, 2);
}

// The page's own lines, with its paths put below the scratch folder.
TEST_F(KeepTest, TheRoutineOfTheDocumentsRuns) {
  std::istringstream page(fixtures::whole_file(fixtures::source_dir() / "docs" / "keeping.md"));
  int commands = 0;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = !inside && line == "```sh";
      continue;
    }
    if (!inside || line.empty()) continue;
    const std::string name = "seldinger ";
    ASSERT_EQ(line.rfind(name, 0), 0U) << line;
    line.replace(0, name.size(), kProgram + " ");
    for (const auto& [shown, real] : {std::pair<std::string, std::string>("/srv/seldinger", library_),
                                      {"/srv/restored", at("restored")},
                                      {"/backup/", at("")},
                                      {"CASE", case_id_}})
      for (std::size_t from = 0; (from = line.find(shown, from)) != std::string::npos; from += real.size())
        line.replace(from, shown.size(), real);
    const auto ran = run(line, scratch_);
    EXPECT_EQ(ran.exit_code, 0) << line << "\n" << ran.err;
    ++commands;
  }
  EXPECT_GE(commands, 6);
}

}  // namespace
}  // namespace seldinger
