// case mesh.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "casedb/cases/cases.h"
#include "casedb/export/gltf_json.h"

namespace seldinger::app {
namespace {

int run_case_mesh(const Arguments& arguments) {
  const std::filesystem::path out = file_of("--out", arguments.required("--out"), {".glb"});
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto skin = casedb::load_skin(*library, *row);
  if (!skin) return refuse(skin.error());
  const std::vector<std::byte> file = casedb::glb_of(*skin);
  write_file(out, std::string(reinterpret_cast<const char*>(file.data()), file.size()));
  std::printf("%zu triangles, %zu bytes\n", skin->triangles.size(), file.size());
  return kDone;
}

constexpr Option kMeshOptions[] = {kLibrary, {"--out", "FILE.glb", "the file to write"}};

}  // namespace

Command case_mesh_command() {
  return {.name = "case mesh",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kMeshOptions,
          .summary = "Writes a case's skin as binary glTF, for browsers and other programs.",
          .run = &run_case_mesh};
}

}  // namespace seldinger::app
