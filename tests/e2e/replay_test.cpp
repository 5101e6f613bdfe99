// A replay to look at, as its user asks for it: a sheet, frames, a film; compared while it is drawn.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/database/sqlite.h"
#include "sim/case/record/recording.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;
using fixtures::whole_file;
namespace fs = std::filesystem;

using fixtures::kProgram;

struct Made {
  fs::path scratch = fixtures::fresh_folder("replay_output");
  std::string library = (scratch / "library").string();
  std::map<std::string, std::string> attempt;  // of the expert, by modality
  std::map<std::string, double> duration_s;

  fixtures::Ran command(const std::string& words, const std::string& before = "") const {
    return run(before + kProgram + " " + words + " --library " + library, scratch);
  }
  Json ask(const std::string& words) const {
    const auto ran = command(words + " --json");
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out);
  }
  std::string at(const std::string& name) const { return (scratch / name).string(); }
  Made() {
    for (const std::string modality : {"ultrasound", "xray", "mpr"}) {
      const std::string words = "--modality " + modality;
      const Json answer =
          attempt.empty() ? fixtures::demo_library(words, library) : ask("demo --no-serve " + words);
      attempt[modality] = answer.at("attempts").at(2).at("attempt_id").get<std::string>();
      const Json shown = ask("attempt show " + attempt[modality]);
      duration_s[modality] = shown.at("duration_s").get<double>();
    }
  }
};

Made& made() {
  static Made one;
  return one;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(ReplayOutput, ASheetOfEveryModality) {
  ASSERT_EQ(made().attempt.size(), 3U);
  for (const auto& [modality, id] : made().attempt) {
    const std::string file = made().at(modality + ".html");
    const auto ran = made().command("replay " + id + " --json --out " + file);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(Json::parse(ran.out).at("verified"), true);
    const std::string page = whole_file(file);
    const std::size_t pictures = count(page, "<img ");
    EXPECT_GE(pictures, 5U) << modality;
    EXPECT_LE(pictures, 12U) << modality;
    EXPECT_EQ(count(page, "<image "), 3U);
    EXPECT_NE(page.find("s: Fired"), std::string::npos);
    EXPECT_NE(page.find("Through the skin"), std::string::npos);
    EXPECT_NE(page.find("class=\"timeline\""), std::string::npos);
    for (const char* nan : {"\"nan", " nan", " -nan", "\"-nan"})
      EXPECT_EQ(page.find(nan), std::string::npos) << nan;
    // Again is the same to the byte.
    ASSERT_EQ(made().command("replay " + id + " --out " + made().at("again.html")).exit_code, 0);
    EXPECT_EQ(whole_file(made().at("again.html")), page);
  }
}

TEST(ReplayOutput, FramesAtTheRateAsked) {
  const std::string folder = made().at("frames"), id = made().attempt.at("mpr");
  const auto ran = made().command("replay " + id + " --rate-hz 2 --out " + folder);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto expected = static_cast<std::size_t>(made().duration_s.at("mpr") * 2.0) + 1;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename());
    const std::string png = whole_file(entry.path());
    ASSERT_GT(png.size(), 24U);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    // IHDR: width and height, big endian.
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x05\0\0\0\x02\xD0", 8)) << "1280 × 720";
  }
  EXPECT_NEAR(static_cast<double>(names.size()), static_cast<double>(expected), 1.0);
  EXPECT_TRUE(names.contains("frame_000001.png"));
  EXPECT_NE(whole_file(folder + "/frame_000001.png"), whole_file(folder + "/frame_000010.png"));
  const auto again = made().command("replay " + id + " --out " + folder);
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_EQ(again.err.rfind("error: exists: ", 0), 0U) << again.err;
  for (const char* rate : {"0", "61", "nan"})
    EXPECT_EQ(made().command("replay " + id + " --out " + made().at("f") + " --rate-hz " + rate).exit_code, 2);
  EXPECT_FALSE(fs::exists(made().at("f")));
  const auto mistyped = made().command("replay " + id + " --out " + made().at("sheet.htm"));
  EXPECT_EQ(mistyped.exit_code, 2);
  EXPECT_NE(mistyped.err.find("--out ends in .html or .mp4, unlike"), std::string::npos) << mistyped.err;
  EXPECT_FALSE(fs::exists(made().at("sheet.htm")));
}

// A stand-in that keeps what it is given, under the name that it is told.
void put_ffmpeg(const fs::path& folder, const std::string& body) {
  fs::create_directories(folder);
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\necho \"$@\" > "
                                   << (folder / "words").string() << "\n"
                                   << body << "\n";
  fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
}

TEST(ReplayOutput, AFilmIsGivenToFfmpegFrameByFrame) {
  const fs::path tools = made().scratch / "tools";
  put_ffmpeg(tools, "cat > \"${last#file:}\"");
  const std::string film = made().at("film of mine;$(touch hacked).mp4");
  const auto ran = made().command("replay " + made().attempt.at("xray") + " --rate-hz 1 --out '" + film + "'",
                                  "PATH=" + tools.string() + ":$PATH ");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const std::size_t frame = 1280 * 720 * 3, size = fs::file_size(film);
  EXPECT_EQ(size % frame, 0U);
  EXPECT_NEAR(static_cast<double>(size / frame), made().duration_s.at("xray"), 1.5);
  const std::string words = whole_file(tools / "words");
  EXPECT_NE(words.find("-s 1280x720 -r 1 -i pipe:0"), std::string::npos) << words;
  EXPECT_FALSE(fs::exists(made().scratch / "hacked"));
  EXPECT_FALSE(fs::exists(film + ".unfinished"));
}

TEST(ReplayOutput, WithoutFfmpegOrWhenItFailsThereIsNoFilm) {
  fs::create_directories(made().scratch / "empty");
  const std::string film = made().at("none.mp4"), words = "replay " + made().attempt.at("mpr") + " --out " + film;
  const auto without = made().command(words, "PATH=" + made().at("empty") + " ");
  EXPECT_EQ(without.exit_code, 4);
  EXPECT_EQ(without.err.rfind("error: ffmpeg: ", 0), 0U) << without.err;
  EXPECT_NE(without.err.find("install"), std::string::npos);
  put_ffmpeg(made().scratch / "broken", "echo x > \"${last#file:}\"\nexit 3");
  const auto broken = made().command(words, "PATH=" + made().at("broken") + ":$PATH ");
  EXPECT_EQ(broken.exit_code, 4);
  EXPECT_EQ(broken.err.find("error: ffmpeg: "), broken.err.rfind("error: ")) << broken.err;
  EXPECT_FALSE(fs::exists(film));
  EXPECT_FALSE(fs::exists(film + ".unfinished"));
}

// Inputs that somebody changed behind the library's back: nothing is drawn.
TEST(ReplayOutput, WhatDiffersIsNotDrawn) {
  const std::string id = made().attempt.at("mpr"), copy = made().at("changed");
  fs::copy(made().library, copy, fs::copy_options::recursive);
  {
    auto library = casedb::Library::open(copy);
    ASSERT_TRUE(library);
    auto recording = casedb::load_recording(*library, id);
    ASSERT_TRUE(recording);
    recording->inputs[1500].needle.position_lps_mm.x += 1.0;
    casedb::Sqlite& database = library->database();
    for (casedb::Statement triggers = database.prepare(
             "SELECT name FROM sqlite_schema WHERE type = 'trigger' AND tbl_name = 'recording_chunk'");
         triggers.step();)
      database.run("DROP TRIGGER " + triggers.text("name"));
    casedb::Statement update = database.prepare(
        "UPDATE recording_chunk SET data = :data, checksum = :checksum WHERE attempt_id = :id AND sequence = :at");
    for (const cases::RecordingChunk& chunk : cases::chunks_from_recording(*recording))
      update.bind("data", std::span(chunk.data))
          .bind("checksum", static_cast<std::int64_t>(chunk.checksum))
          .bind("id", id)
          .bind("at", std::int64_t{chunk.sequence})
          .run();
  }
  const fs::path tools = made().scratch / "tools_again";
  put_ffmpeg(tools, "cat > \"${last#file:}\"");
  for (const char* name : {"changed.html", "changed.mp4", "changed_frames"}) {
    const auto ran = run("PATH=" + tools.string() + ":$PATH " + kProgram + " replay " + id +
                             " --json --rate-hz 1 " + "--out " + made().at(name) + " --library " + copy,
                         made().scratch);
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    const Json answer = Json::parse(ran.out);
    EXPECT_EQ(answer.at("verified"), false);
    EXPECT_EQ(answer.at("first_difference_tick"), 1501);
    EXPECT_FALSE(fs::exists(made().at(name))) << name;
    EXPECT_FALSE(fs::exists(made().at(name) + ".unfinished")) << name;
  }
}

}  // namespace
}  // namespace seldinger
