// deidentify.
#include <unistd.h>

#include <cstdio>

#include "app/cases/deidentify_json.h"
#include "app/cli/command.h"
#include "app/cli/key_file.h"
#include "app/cli/words.h"
#include "casedb/export/deidentify.h"

namespace seldinger::app {
namespace {
int run_deidentify(const Arguments& arguments) {
  auto key = key_from_file(arguments.text("--key"));
  if (!key) return refuse(error_of("--key", arguments.text("--key"), key.error()));
  if (::isatty(STDERR_FILENO) != 0) std::fputs("removing what identifies …\n", stderr);
  const auto done = casedb::deidentify(arguments.positional(0), arguments.positional(1), *key);
  key->fill(std::byte{0});
  if (!done) return refuse(done.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_deidentified(*done).c_str(), stdout);
    return kDone;
  }
  std::printf("%d file%s written\n", done->files, done->files == 1 ? "" : "s");
  for (const auto& [what, count] : done->counts)
    std::printf("%-10s %lld elements\n", what.c_str(), static_cast<long long>(count));
  for (const auto& [code, count] : done->left_out) std::printf("left out: %s: %d files\n", code.c_str(), count);
  std::puts("The pixels are unchanged: look through them for text and faces before you pass them on.");
  return kDone;
}

constexpr Option kDeidentifyOptions[] = {{"--key", "FILE",
                                          "keeps UIDs consistent with other runs; created if there is none. "
                                          "Whoever has it can link the new UIDs to the old ones"},
                                         kJson};

}  // namespace

Command deidentify_command() {
  return {.name = "deidentify",
          .positionals = "IN OUT",
          .min_positionals = 2,
          .max_positionals = 2,
          .options = kDeidentifyOptions,
          .summary =
              "Writes de-identified DICOM (PS3.15 Basic Profile 2024b): a file, or a folder with everything below "
              "it, into a new folder. What the pixels show stays; other bits of their cells are cleared.",
          .run = &run_deidentify};
}

}  // namespace seldinger::app
