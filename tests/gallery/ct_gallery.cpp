// Makes pictures of what import makes of a CT: its classes and organs slice by slice, whole and in six crops, and
// the room with each crop's patient. Run by hand (`ct_gallery` is a target of the build, no test): ct_gallery
// PROGRAM FOLDER [CT …]; without a CT, of the built-in torso, whose pictures docs/gallery shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/replay/png.h"
#include "casedb/import/import.h"
#include "sim/base/rng.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/fixtures/png_picture.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using fixtures::RgbPicture;

std::string program;
fs::path folder, scratch;
std::vector<fs::path> cts;

void run(const std::string& command, std::string* out = nullptr) {
  const auto ran = fixtures::run(program + " " + command, scratch);
  EXPECT_EQ(ran.exit_code, 0) << command << "\n" << ran.err;
  if (out != nullptr) *out = ran.out;
}

void write_file(const fs::path& to, const std::string& bytes) {
  std::ofstream stream(to, std::ios::binary);
  EXPECT_TRUE(stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) << to;
}

void write(const volume::Volume& volume, const fs::path& to) {
  const glm::ivec3 n = volume.size_voxels;
  const glm::dvec3 mm = volume.spacing_mm, from(volume.lps_from_voxel[3]);
  std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n";
  text += "DimSize = " + std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z) + "\n";
  text +=
      "ElementSpacing = " + std::to_string(mm.x) + " " + std::to_string(mm.y) + " " + std::to_string(mm.z) + "\n";
  text += "Offset = " + std::to_string(from.x) + " " + std::to_string(from.y) + " " + std::to_string(from.z) + "\n";
  text += "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  text.append(reinterpret_cast<const char*>(volume.hu.data()), 2 * volume.hu.size());
  write_file(to, text);
}

RgbPicture sheet_of(const fs::path& ct) {
  const std::string library = (scratch / (ct.stem().string() + " library")).string();
  fs::remove_all(library);
  std::string made;
  run("import '" + ct.string() + "' --title Gallery --json --library '" + library + "'", &made);
  const auto case_id = nlohmann::json::parse(made).at("case_id").get<std::string>();
  run("case explain " + case_id + " --sheet '" + (scratch / "sheet.png").string() + "' --library '" + library +
      "'");
  fs::remove_all(library);
  return fixtures::read_png(scratch / "sheet.png");
}

RgbPicture room_of(const fs::path& ct) {
  const nlohmann::json scene{
      {"volume", ct.string()},
      {"view", {{"kind", "room"}, {"from", "top"}, {"size_px", {480, 420}}, {"quality", "fine"}}}};
  write_file(scratch / "room.json", scene.dump());
  run("render '" + (scratch / "room.json").string() + "' --out '" + (scratch / "room.png").string() + "'");
  return fixtures::read_png(scratch / "room.png");
}

// In rows, one beside the other as they are wide.
void write_side_by_side(const std::vector<RgbPicture>& pictures, std::size_t columns, const fs::path& to) {
  constexpr int kGap = 8;
  std::vector<glm::ivec2> corners;
  glm::ivec2 next(0), all(0);
  for (std::size_t which = 0; which < pictures.size(); ++which) {
    if (which % columns == 0) next = {0, all.y == 0 ? 0 : all.y + kGap};
    corners.push_back(next);
    all = glm::max(all, next + glm::ivec2(pictures[which].width_px, pictures[which].height_px));
    next.x += pictures[which].width_px + kGap;
  }
  std::vector<unsigned char> rgb(3 * static_cast<std::size_t>(all.x) * static_cast<std::size_t>(all.y), 0);
  for (std::size_t which = 0; which < pictures.size(); ++which)
    for (int y = 0; y < pictures[which].height_px; ++y)
      std::copy_n(pictures[which].at(0, y), 3 * pictures[which].width_px,
                  rgb.begin() + 3 * ((corners[which].y + y) * all.x + corners[which].x));
  const std::vector<std::byte> png = app::png_from_rgb(rgb, all.x, all.y);
  write_file(to, std::string(reinterpret_cast<const char*>(png.data()), png.size()));
}

// With the noise of a scanner, which the built-in torso is without.
volume::Volume noisy_torso() {
  volume::Volume made = volume::make_phantom({.spacing_mm = glm::dvec3(2, 2, 3)}).volume;
  for (std::size_t at = 0; at < made.hu.size(); ++at)
    made.hu[at] = static_cast<std::int16_t>(std::max(-1024.0, made.hu[at] + 10.0 * base::normal_at(5, at)));
  return made;
}

void make_pictures(const volume::Volume& whole, const std::string& name) {
  const fs::path ct = scratch / "ct.mha";
  write(whole, ct);
  write_side_by_side({sheet_of(ct)}, 1, folder / (name + ".png"));
  std::vector<RgbPicture> sheets, rooms;
  const std::vector<std::uint8_t> body = volume::body_mask(whole);
  for (const volume::Crop& crop : volume::crops(
           {"left deep", "front and right", "both sides", "five faces", "circle", "oblique left front"})) {
    write(volume::cropped(whole, body, crop), ct);
    sheets.push_back(sheet_of(ct));
    rooms.push_back(room_of(ct));
  }
  write_side_by_side(sheets, 2, folder / (name + "-crops.png"));
  write_side_by_side(rooms, 3, folder / (name + "-rooms.png"));
}

TEST(CtGallery, OfTheTorsoOrOfCts) {
  if (cts.empty()) make_pictures(noisy_torso(), "tissue");
  for (const fs::path& ct : cts) {
    const auto source = casedb::read_source_here(ct);
    ASSERT_TRUE(source) << source.error().text;
    make_pictures(source->volume, ct.stem().string());
  }
}

}  // namespace
}  // namespace seldinger

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  if (count < 3) {
    std::puts("ct_gallery PROGRAM FOLDER [CT …]");
    return 2;
  }
  seldinger::program = seldinger::fs::absolute(words[1]).string();
  seldinger::folder = seldinger::fs::absolute(words[2]);
  seldinger::fs::create_directories(seldinger::folder);
  seldinger::scratch = seldinger::fixtures::fresh_folder("ct_gallery");
  for (int which = 3; which < count; ++which) seldinger::cts.emplace_back(seldinger::fs::absolute(words[which]));
  return RUN_ALL_TESTS();
}
