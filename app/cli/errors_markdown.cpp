#include <string>

#include "app/cli/error_codes.h"

namespace seldinger::app {
namespace {

std::string words_of(unsigned kinds) {
  std::string words;
  const auto add = [&](unsigned kind, const char* word) {
    if ((kinds & kind) != 0) words += (words.empty() ? "" : ", ") + std::string(word);
  };
  add(kWarns, "warning");
  add(kFinds, "1");
  add(kMisused, "2");
  add(kRefuses, "3");
  add(kFails, "4");
  return words;
}

}  // namespace

std::string errors_markdown() {
  std::string text =
      "# Error codes\n\nMade from the table in `app/cli/error_codes.cpp` by `seldinger help --errors`; a test "
      "compares.\n"
      "An error is one line `error: CODE: text` on standard error; further reasons follow as `finding: CODE: "
      "text`. With `--json` standard output holds `{\"error\": {\"code\", \"text\"}}`, with `findings` where there "
      "are any. "
      "Warnings are kept with the case. Codes are stable, texts are not: match on codes. No text holds patient "
      "data.\n\n"
      "Exit: 1 a check ran and found this · 2 wrong use · 3 the input is refused, nothing is changed · 4 the "
      "environment fails · "
      "warning: nothing is refused.\n";
  for (const ErrorCodeSection& section : error_codes()) {
    text += "\n## " + std::string(section.title) +
            "\n\n| code | exit | what it means | what to do |\n|---|---|---|---|\n";
    for (const ErrorCode& one : section.codes)
      text += "| `" + std::string(one.code) + "` | " + words_of(one.kinds) + " | " + one.meaning + " | " +
              (*one.remedy == '\0' ? "–" : one.remedy) + " |\n";
  }
  return text;
}

}  // namespace seldinger::app
