// Mutated DICOM files given to `deidentify`: refused or written whole, whatever they do to their reader.
#include <gtest/gtest.h>

#include <fstream>

#include "casedb/export/deidentify.h"
#include "casedb/import/jail/jail.h"
#include "tests/casedb/export/planted_dicom.h"
#include "tests/casedb/import/mutate.h"
#include "tests/casedb/import/peak_memory.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/mutate.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

TEST(DeidentifyFuzz, MutatedFilesAreRefusedOrWrittenWhole) {
  const fs::path folder = fixtures::fresh_test_folder("deidentify_fuzz"), in = folder / "in.dcm",
                 out = folder / "out.dcm";
  std::vector<std::string> seeds;
  std::size_t longest = 0;
  for (const PlantedSyntax syntax : kPlantedSyntaxes) {
    if (syntax == PlantedSyntax::j2k && !fixtures::shared_data_is_there())
      continue;  // its pixels are a real slice's
    seeds.push_back(planted_bytes(planted_slice(0, syntax).elements, syntax));
    longest = std::max(longest, seeds.back().size());
  }
  HashKey key{};
  std::mt19937_64 random(19);
  int written = 0, refused = 0;
  const int rounds = fixtures::fuzz_rounds(250);
  for (int round = 0; round < rounds; ++round) {
    const std::string bytes = mutated(seeds[random() % seeds.size()], seeds, 2 * longest, random);
    std::ofstream(in, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const auto done = deidentify(in, out, key);
    const JailUse jail = last_jail_use();
    ASSERT_LE(jail.peak_bytes, allowed_bytes(jail.announced_bytes)) << "round " << round;
    ASSERT_LT(jail.cpu_s, 5.0) << "round " << round;
    ASSERT_EQ(fs::exists(out), done.has_value()) << "round " << round;
    if (done) {
      ++written;
      fs::remove(out);
    } else {
      ++refused;
      ASSERT_NE(done.error().code, "reader_died") << "round " << round;
    }
  }
  EXPECT_GT(written, rounds / 20);
  EXPECT_GT(refused, rounds / 20);
}

}  // namespace
}  // namespace seldinger::casedb
