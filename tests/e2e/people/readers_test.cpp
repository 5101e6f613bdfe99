// The program given files that were made to harm: exit 3, one line, and a library that is as it was.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
using fixtures::kProgram;
using fixtures::run;

class Readers : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fixtures::fresh_test_folder("readers");
    library_ = folder_ / "library";
  }
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  // 16 x 16 x 16 voxels of air around a block of tissue.
  static std::string meta(const std::string& more, const std::string& size = "16 16 16") {
    return "ObjectType = Image\nNDims = 3\n" + more +
           "BinaryData = True\nBinaryDataByteOrderMSB = False\nElementSpacing = 2 2 2\nDimSize = " + size +
           "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  }
  static std::string voxels(int inside, int outside) {
    std::string bytes;
    for (int k = 0; k < 16; ++k)
      for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
          const bool in = std::min({i, j, k}) >= 3 && std::max({i, j, k}) < 13;
          const unsigned bits = static_cast<std::uint16_t>(in ? inside : outside);
          bytes.push_back(static_cast<char>(bits & 0xFF));
          bytes.push_back(static_cast<char>(bits >> 8));
        }
    return bytes;
  }
  fixtures::Ran seldinger(const std::string& words) const {
    return run("'" + kProgram + "' " + words + " --library '" + library_.string() + "'", folder_ / "said");
  }
  static void expect_refused(const fixtures::Ran& ran, const std::string& code) {
    EXPECT_EQ(ran.exit_code, 3) << ran.err;
    EXPECT_EQ(ran.err.rfind("error: " + code + ": ", 0), 0U) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }

  fs::path folder_, library_;
};

TEST_F(Readers, TextsThatOverflowedAreReadOrRefused) {
  // Each of the four ended the program by SIGABRT.
  const std::string ct = voxels(40, -1000), map = voxels(1, 0);
  const auto imported =
      seldinger("import '" + write("a.mha", meta("Comment = " + std::string(300, 'c') + "\n") + ct).string() + "'");
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  const std::string case_id = imported.out.substr(5, 36), before = fixtures::fingerprint(library_ / "assets");
  const fs::path key = write("k.mha", meta(std::string(255, 'K') + " = 1\n") + map),
                 line = write("l.nrrd",
                              "NRRD0004\ntype: short\ndimension: 3\nspace: LPS\nsizes: 16 16 16\nspace directions: "
                              "(2,0,0) (0,2,0) (0,0,2)\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n" +
                                  std::string(1000, 'x') + "\n\n" + map);
  for (const fs::path& file : {key, line}) {
    expect_refused(seldinger("import '" + file.string() + "'"), "damaged");
    expect_refused(seldinger("case label " + case_id + " '" + file.string() + "'"), "damaged");
  }
  EXPECT_EQ(fixtures::fingerprint(library_ / "assets"), before);
  const fs::path lawful = write("m.mha", meta("Comment = " + std::string(300, 'c') + "\n") + map);
  const auto labelled = seldinger("case label " + case_id + " '" + lawful.string() + "'");
  EXPECT_EQ(labelled.exit_code, 0) << labelled.err;
}

TEST_F(Readers, AKilledReaderIsOneRefusalAndNothingIsStored) {
  const fs::path file = write("a.mha", meta("", "512 512 300"));
  fs::resize_file(file, fs::file_size(file) + std::uintmax_t{512} * 512 * 300 * 2);  // zeros that take no disk
  const auto ran =
      run("sh -c '\"$1\" import \"$2\" --library \"$3\" & p=$!; c=; while [ -z \"$c\" ] && kill -0 $p; do "
          "c=$(cat /proc/$p/task/$p/children); done; kill -KILL $c; wait $p' sh '" +
              kProgram + "' '" + file.string() + "' '" + library_.string() + "'",
          folder_ / "said");
  expect_refused(ran, "reader_died");
  EXPECT_FALSE(fs::exists(library_));
}

}  // namespace
}  // namespace seldinger
