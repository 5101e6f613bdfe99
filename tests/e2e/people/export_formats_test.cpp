// A study's export in other formats, by the built program: the SQLite file holds what the tables hold, cell by
// cell, and of nobody a name, an address or a date.
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// Of two people who made an attempt one consents to the study.
class ExportFormats : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("export_formats")};
  std::vector<std::string> planted_{"zoe.roe", "example.org", "Quagmire"};

  void SetUp() override {
    const std::string case_id = library_.demo()["case_id"];
    std::ofstream(at("text.txt")) << "May your attempts be used in Quagmire?\n";
    library_.done("study new Quagmire");
    library_.done("consent text " + at("text.txt") + " --study Quagmire");
    const Json made =
        library_.ask("simulate --operator intermediate --no-pictures --seed 4 --count 2 --case " + case_id);
    auto library = casedb::Library::open(library_.path());
    int number = 0;
    for (const char* name : {"zoe.roe@example.org", "tim.roe@example.org"}) {
      const std::string person =
          casedb::add_user(*library, name, casedb::Role::trainee, fixtures::kPassword).value();
      ASSERT_TRUE(casedb::give_fact(*library, person, "years_in_radiology", "2.5"));
      const auto row =
          casedb::find_attempt(*library, made["attempts"][static_cast<std::size_t>(number++)]["attempt_id"]);
      casedb::NewAttempt own;
      static_cast<casedb::AttemptHead&>(own) = *row;
      own.person_id = person;
      own.operator_name = casedb::kPersonOperator;
      own.metrics = row->metrics;
      own.steps = casedb::list_steps(*library, row->attempt_id);
      own.recording = casedb::load_recording(*library, row->attempt_id).value();
      own.duration_s = row->duration_s;
      own.end = row->end;
      const auto stored = casedb::add_attempt(*library, own);
      ASSERT_TRUE(stored);
      for (const std::string& id : {person, *stored, row->case_id, row->lesion_id}) planted_.push_back(id);
    }
    const std::string text = library_.ask("consent list --user zoe.roe@example.org")["consents"][0]["text_id"];
    library_.done("consent give " + text + " --user zoe.roe@example.org");
  }
  std::string at(const std::string& name) const { return (library_.folder() / name).string(); }
  int planted_in(const std::string& text) const {
    int found = 0;
    for (const std::string& word : planted_) found += text.find(word) != std::string::npos;
    static const std::regex kDate("(19|20)[0-9]{2}-[01][0-9]-[0-3][0-9]|[0-9]@[a-z]|[a-z]@[a-z]");
    return found + static_cast<int>(std::regex_search(text, kDate));
  }
};

std::string cell_text(const casedb::Statement& row, const std::string& column) {
  char digits[32];
  switch (row.kind(column)) {
    case casedb::Statement::Kind::null:
      return {};
    case casedb::Statement::Kind::real:
      return {digits, std::to_chars(std::begin(digits), std::end(digits), row.real(column)).ptr};
    case casedb::Statement::Kind::integer:
      return std::to_string(row.integer(column));
    default:
      return row.text(column);
  }
}

TEST_F(ExportFormats, TheSqliteFileHoldsTheTablesAndNobody) {
  library_.done("export --study Quagmire --key " + at("a.key") + " --also sqlite,slicer,xapi,motion-bids --out " +
                at("all"));
  casedb::Sqlite database(at("all/export.sqlite"), casedb::Sqlite::Mode::read_only);
  EXPECT_EQ(database.text("PRAGMA integrity_check"), "ok");
  EXPECT_FALSE(database.prepare("PRAGMA foreign_key_check").step());
  std::size_t cells = 0;
  const auto compare = [&](const std::string& name, const std::vector<fs::path>& files) {
    casedb::Statement rows = database.prepare("SELECT * FROM " + name + " ORDER BY rowid");
    for (const fs::path& file : files) {
      const auto table = fixtures::csv_table(fixtures::whole_file(file));
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        ASSERT_TRUE(rows.step()) << name;
        for (const std::string& column : table.header) {
          const std::string& written = table.cell(i, column);  // SQLite has no -0
          ASSERT_EQ(cell_text(rows, column), written == "-0" ? "0" : written) << name << "." << column;
          ++cells;
        }
      }
    }
    EXPECT_FALSE(rows.step()) << name;
  };
  for (const char* name : {"attempts", "metrics", "steps", "events", "facts", "data_dictionary"})
    compare(name, {at(std::string("all/") + name + ".csv")});
  for (const char* name : {"poses", "forces", "frames"}) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(at(std::string("all/") + name))) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    compare(name, files);
  }
  EXPECT_GT(cells, 10'000U);
  EXPECT_EQ(database.integer("SELECT count(DISTINCT person) FROM attempts"), 1) << "the other does not consent";
  EXPECT_EQ(database.integer("SELECT count(*) FROM facts"), 1);

  // Names, mail and dates: in no text cell, and in no byte of any file.
  int scanned = 0;
  for (const auto& entry : fs::recursive_directory_iterator(at("all"))) {
    if (!entry.is_regular_file()) continue;
    ++scanned;
    EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all), fs::perms::none)
        << entry.path() << ": its owner's alone";
    EXPECT_EQ(planted_in(fs::relative(entry.path(), at("all")).string()), 0) << entry.path();
    if (entry.path().extension() == ".sqlite") continue;
    EXPECT_EQ(planted_in(fixtures::whole_file(entry.path())), 0) << entry.path();
  }
  EXPECT_GT(scanned, 20);
  const std::string bytes = fixtures::whole_file(at("all/export.sqlite"));
  for (const std::string& word : planted_) EXPECT_EQ(bytes.find(word), std::string::npos) << word;
  int texts = 0;
  casedb::Statement tables = database.prepare("SELECT name FROM sqlite_schema WHERE type = 'table'");
  while (tables.step()) {
    const std::string name = tables.text("name");
    casedb::Statement columns =
        database.prepare("SELECT name FROM pragma_table_info('" + name + "') WHERE type = 'TEXT'");
    while (columns.step()) {
      casedb::Statement words =
          database.prepare("SELECT DISTINCT \"" + columns.text("name") + "\" AS words FROM " + name);
      for (; words.step(); ++texts) EXPECT_EQ(planted_in(words.text("words")), 0) << words.text("words");
    }
  }
  EXPECT_GT(texts, 100);
}

// Read as the data dictionary says, and written again with 17 digits: file, row, column, number.
constexpr const char* kReadByR = R"(
d <- read.csv("data_dictionary.csv", colClasses = "character")
for (file in c("attempts.csv", "metrics.csv", "steps.csv", "events.csv", "facts.csv")) {
  types <- d$type[d$file == file]
  x <- read.csv(file, colClasses = ifelse(types == "text", "character", "numeric"), na.strings = "", check.names = FALSE)
  for (i in which(types != "text")) for (k in which(!is.na(x[[i]])))
    cat(file, k - 1, names(x)[i], sprintf("%.17g", x[[i]][k]), "\n")
})";
constexpr const char* kReadByPandas = R"(
import pandas as pd
d = pd.read_csv("data_dictionary.csv", dtype=str)
for file in ("attempts.csv", "metrics.csv", "steps.csv", "events.csv", "facts.csv"):
    x = pd.read_csv(file, float_precision="round_trip", keep_default_na=False, na_values=[""])
    for name, kind in zip(d[d.file == file].column, d[d.file == file].type):
        for row, value in enumerate(x[name]):
            if kind != "text" and not pd.isna(value): print(file, row, name, "%.17g" % value)
)";

TEST_F(ExportFormats, RAndPandasReadTheSameNumbers) {
  library_.done("export --study Quagmire --raw events --key " + at("a.key") + " --out " + at("read"));
  std::ofstream(at("read.R")) << kReadByR;
  std::ofstream(at("read.py")) << kReadByPandas;
  std::size_t numbers = 0;
  const auto dictionary = fixtures::csv_table(fixtures::whole_file(at("read/data_dictionary.csv")));
  std::map<std::string, fixtures::CsvTable> tables;
  for (std::size_t i = 0; i < dictionary.rows.size(); ++i) {
    const std::string file = dictionary.cell(i, "file"), column = dictionary.cell(i, "column");
    if (file.find('/') != std::string::npos || dictionary.cell(i, "type") == "text") continue;
    auto table = tables.find(file);
    if (table == tables.end())
      table = tables.emplace(file, fixtures::csv_table(fixtures::whole_file(at("read/" + file)))).first;
    for (std::size_t row = 0; row < table->second.rows.size(); ++row)
      numbers += table->second.cell(row, column).empty() ? 0U : 1U;
  }
  int readers = 0;
  for (const auto& [is_there, reads] : {std::pair("Rscript --version", "Rscript --vanilla ../read.R"),
                                        {"/usr/bin/python3 -c 'import pandas'", "/usr/bin/python3 ../read.py"}}) {
    if (std::system((std::string(is_there) + " >/dev/null 2>&1").c_str()) != 0) continue;
    ++readers;
    const auto ran = fixtures::run("cd '" + at("read") + "' && " + reads, at("said"));
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    std::istringstream lines(ran.out);
    std::string file, column, value;
    std::size_t row = 0, same = 0;
    while (lines >> file >> row >> column >> value) {
      ASSERT_EQ(std::stod(value), std::stod(tables.at(file).cell(row, column))) << file << " " << column;
      ++same;
    }
    EXPECT_EQ(same, numbers) << reads;
  }
  EXPECT_GT(numbers, 200U);
  if (readers < 2) GTEST_SKIP() << "there is no R, or no pandas (Debian: r-base-core, python3-pandas) to read it";
}

TEST_F(ExportFormats, EachAttemptIsThereOnceInEachFormat) {
  library_.done("export --study Quagmire --raw none --key " + at("a.key") +
                " --also slicer,xapi,motion-bids --out " + at("exact"));
  const auto attempts = fixtures::csv_table(fixtures::whole_file(at("exact/attempts.csv")));
  std::set<std::string> names, subjects;
  for (std::size_t i = 0; i < attempts.rows.size(); ++i) {
    const std::string name = attempts.cell(i, "attempt");
    names.insert(name);
    for (const char* end : {"_points.mrk.json", "_path.mrk.json", "_needle.tfm"})
      EXPECT_TRUE(fs::exists(at("exact/slicer/" + name + end))) << name << end;
    if (attempts.cell(i, "synthetic") == "0") {
      const Json points = Json::parse(fixtures::whole_file(at("exact/slicer/" + name + "_points.mrk.json")));
      std::set<std::string> labels;
      for (const Json& one : points["markups"][0]["controlPoints"]) labels.insert(one["label"]);
      EXPECT_TRUE(labels.contains("entry")) << "a puncture has one";
    }
  }
  const Json statements = Json::parse(fixtures::whole_file(at("exact/xapi.json")));
  std::set<std::string> told, ids;
  for (const Json& one : statements) {
    told.insert(one["context"]["extensions"]["https://seldinger.invalid/attempt"].get<std::string>());
    EXPECT_TRUE(
        std::regex_match(one["id"].get<std::string>(),
                         std::regex("[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")));
    ids.insert(one["id"].get<std::string>());
  }
  EXPECT_EQ(told, names);
  EXPECT_EQ(ids.size(), names.size());
  std::size_t motions = 0;
  for (const auto& entry : fs::recursive_directory_iterator(at("exact/motion-bids")))
    motions += entry.path().filename().string().ends_with("_motion.tsv");
  EXPECT_EQ(motions, names.size());

  // Without a key a person's recording stays, in every format; their statement tells no more than the table.
  library_.done("export --study Quagmire --raw none --also slicer,xapi,motion-bids,sqlite --out " + at("coarse"));
  const auto coarse = fixtures::csv_table(fixtures::whole_file(at("coarse/attempts.csv")));
  int of_people = 0;
  for (std::size_t i = 0; i < coarse.rows.size(); ++i) {
    const bool person = coarse.cell(i, "synthetic") == "0";
    of_people += person;
    EXPECT_EQ(fs::exists(at("coarse/slicer/" + coarse.cell(i, "attempt") + "_needle.tfm")), !person);
  }
  EXPECT_EQ(of_people, 1);
  for (const auto& entry : fs::directory_iterator(at("coarse/motion-bids")))
    EXPECT_EQ(entry.path().filename().string().rfind("sub-P", 0), std::string::npos) << entry.path();
  EXPECT_EQ(library_.call("export --out " + at("none") + " --also parquet").exit_code, 2);
  EXPECT_FALSE(fs::exists(at("none")));
}

}  // namespace
}  // namespace seldinger
