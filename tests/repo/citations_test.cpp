// Tests of the repository: a document that a file cites is in the repository.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fixtures/places.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = seldinger::fixtures::source_dir();

// Names of documents, with or without folders, and decisions by their number. An expression is slow: it looks at
// lines that may hold one.
std::vector<std::string> citations(const std::string& text) {
  static const std::regex kCited(R"([A-Za-z0-9_./-]*[A-Za-z0-9_]\.md\b|\bdocs/decisions/[0-9]{4}\b)");
  std::vector<std::string> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(".md") != line.npos || line.find("docs/decisions/") != line.npos)
      for (std::sregex_iterator it(line.begin(), line.end(), kCited), end; it != end; ++it)
        out.push_back(it->str());
  return out;
}

// From the root, from the citing file, or among the documents: where a reader looks.
bool is_there(const std::string& cited, const fs::path& citing_folder) {
  const std::string path = cited.substr(cited.find_first_not_of('/'));
  if (!path.ends_with(".md")) {
    const std::string number = fs::path(path).filename();
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/decisions"))
      if (entry.path().filename().string().rfind(number + "-", 0) == 0) return true;
    return false;
  }
  return fs::exists(kRoot / path) || fs::exists(citing_folder / path) || fs::exists(kRoot / "docs" / path);
}

// What somebody wrote: neither built nor hidden, and no picture.
std::vector<fs::path> written_files() {
  const std::set<std::string> no_text = {".png", ".gz", ".mha", ".nrrd", ".dcm", ".glb", ".zip"};
  std::vector<fs::path> out;
  for (const auto& top : fs::directory_iterator(kRoot)) {
    const std::string name = top.path().filename();
    if (name.front() == '.' || name.rfind("build", 0) == 0) continue;
    if (top.is_regular_file()) out.push_back(top.path());
    if (top.is_directory())
      for (const auto& entry : fs::recursive_directory_iterator(top))
        if (entry.is_regular_file() && !no_text.contains(entry.path().extension().string()))
          out.push_back(entry.path());
  }
  return out;
}

TEST(Citations, AreOfDocumentsInTheRepository) {
  std::size_t seen = 0;
  for (const fs::path& file : written_files()) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const std::string& cited : citations(text)) {
      ++seen;
      EXPECT_TRUE(is_there(cited, file.parent_path()))
          << fs::relative(file, kRoot) << " cites " << cited << ", which is not in the repository";
    }
  }
  EXPECT_GT(seen, 200U);
}

// Put together here, so that the test above does not find them.
TEST(Citations, APlantedOneIsMissed) {
  const std::string md = ".md", decisions = std::string("docs/") + "decisions/";
  const auto found = citations("// (knowledge" + md + " §3; docs/metrics" + md + "), " + decisions + "9999 and " +
                               decisions + "0016");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_FALSE(is_there(found[0], kRoot / "sim"));
  EXPECT_TRUE(is_there(found[1], kRoot / "sim"));
  EXPECT_FALSE(is_there(found[2], kRoot / "sim"));
  EXPECT_TRUE(is_there(found[3], kRoot / "sim"));
}

}  // namespace
