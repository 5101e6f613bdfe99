// The mutation driver for longer: 20,000 files of every reader, or SELDINGER_FUZZ; SELDINGER_FUZZ_SEED for others.
#include <cstdlib>
#include <string>

#include "tests/casedb/import/fuzz_import.h"
#include "tests/casedb/import/import_case.h"
#include "tests/fixtures/mutate.h"

namespace seldinger::casedb {
namespace {

class FuzzLong : public ImportCase {};

TEST_F(FuzzLong, MutatedFilesNeverHarm) {
  const char* seed = std::getenv("SELDINGER_FUZZ_SEED");
  for (const FuzzedReader reader : kFuzzedReaders)
    fuzz_import(folder_, reader, seed != nullptr ? std::stoull(seed) : 1, fixtures::fuzz_rounds(20000));
}

}  // namespace
}  // namespace seldinger::casedb
