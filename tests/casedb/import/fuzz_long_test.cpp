// The mutation driver for longer, from another seed each time it is given one: SELDINGER_FUZZ_SEED, _SECONDS.
#include <cstdlib>
#include <string>

#include "tests/casedb/import/fuzz_import.h"
#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

class FuzzLong : public ImportCase {};

TEST_F(FuzzLong, MutatedFilesNeverHarm) {
  const char *seed = std::getenv("SELDINGER_FUZZ_SEED"), *seconds = std::getenv("SELDINGER_FUZZ_SECONDS");
  fuzz_import(folder_, seed != nullptr ? std::stoull(seed) : 1,
              {100000000, seconds != nullptr ? std::stod(seconds) : 300.0});
}

}  // namespace
}  // namespace seldinger::casedb
