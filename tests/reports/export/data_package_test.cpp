// The export's data package: every table that is named, with the columns of its header, in their order and types.
#include "reports/export/data_package_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/export/raw_tables.h"

namespace seldinger::reports {
namespace {

using Json = nlohmann::json;

TEST(DataPackage, DescribesTheTablesThatAreThere) {
  const Json package = Json::parse(data_package({"attempts.csv", "metrics.csv", "facts.csv"}));
  EXPECT_EQ(package.at("profile"), "tabular-data-package");
  ASSERT_EQ(package.at("resources").size(), 3U);
  for (const Json& resource : package.at("resources")) {
    const auto table = std::find_if(raw_tables().begin(), raw_tables().end(),
                                    [&](const TableInfo& one) { return one.file == resource.at("path"); });
    ASSERT_NE(table, raw_tables().end()) << resource.at("path");
    EXPECT_EQ(resource.at("name").get<std::string>() + ".csv", table->file);
    const Json& schema = resource.at("schema");
    EXPECT_EQ(schema.at("missingValues"), Json::array({""}));
    ASSERT_EQ(schema.at("fields").size(), table->columns.size());
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      const Json& field = schema.at("fields")[i];
      const ColumnInfo& column = table->columns[i];
      EXPECT_EQ(field.at("name"), column.name);
      EXPECT_EQ(field.at("description"), column.what);
      EXPECT_EQ(field.at("type"), column.type == "flag"   ? "boolean"
                                  : column.type == "text" ? "string"
                                                          : column.type);
      EXPECT_EQ(field.contains("constraints"), column.missing.empty()) << "never empty: required";
      if (column.type == "flag") {
        EXPECT_EQ(field.at("trueValues"), Json::array({"1"}));
      }
    }
  }
  EXPECT_EQ(package.at("resources")[0].at("schema").at("primaryKey"), "attempt");
  EXPECT_EQ(package.at("resources")[1].at("schema").at("foreignKeys")[0].at("reference").at("resource"),
            "attempts");
  EXPECT_FALSE(package.at("resources")[2].at("schema").contains("foreignKeys")) << "answers are of persons";
}

// Table Schema's own types, and no table of one file an attempt.
TEST(DataPackage, HasNoTypeOfItsOwn) {
  const Json package =
      Json::parse(data_package({"attempts.csv", "metrics.csv", "steps.csv", "facts.csv", "events.csv"}));
  EXPECT_EQ(package.at("resources").size(), 5U);
  for (const Json& resource : package.at("resources"))
    for (const Json& field : resource.at("schema").at("fields")) {
      const std::string type = field.at("type");
      EXPECT_TRUE(type == "string" || type == "number" || type == "integer" || type == "boolean") << type;
    }
}

}  // namespace
}  // namespace seldinger::reports
