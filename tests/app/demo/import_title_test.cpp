// What `import` refuses before it reads.
#include <gtest/gtest.h>

#include "app/cases/import_case.h"

namespace seldinger::app {
namespace {

// A title was stored as it was given; a bundle with it was refused everywhere.
TEST(ImportTitle, IsThatOfACase) {
  const auto refusal = [](const std::string& title) {
    return import_case("there is no such file", {}, title, "import").error().code;
  };
  for (const std::string& title :
       {std::string(1500, 'x'), std::string("a\nb"), std::string(" a"), std::string("\xE4"),
        std::string("a\xC2\x9B"
                    "31m")})
    EXPECT_EQ(refusal(title), "bad_title") << title;
  EXPECT_EQ(refusal("Kidney, left"), "not_found");
}

}  // namespace
}  // namespace seldinger::app
