#include "reports/export/redcap.h"

#include "reports/export/raw_tables.h"

namespace seldinger::reports {
namespace {

// As REDCap 13 writes them.
constexpr const char* kColumns[] = {"Variable / Field Name",
                                    "Form Name",
                                    "Section Header",
                                    "Field Type",
                                    "Field Label",
                                    "Choices, Calculations, OR Slider Labels",
                                    "Field Note",
                                    "Text Validation Type OR Show Slider Number",
                                    "Text Validation Min",
                                    "Text Validation Max",
                                    "Identifier?",
                                    "Branching Logic (Show field only if...)",
                                    "Required Field?",
                                    "Custom Alignment",
                                    "Question Number (surveys only)",
                                    "Matrix Group Name",
                                    "Matrix Ranking?",
                                    "Field Annotation"};

}  // namespace

std::string redcap_dictionary() {
  CsvLine line;
  for (const char* name : kColumns) line.text(name);
  std::string text = line.take();
  for (const TableInfo& table : raw_tables()) {
    if (table.file != "attempts.csv") continue;
    for (const ColumnInfo& column : table.columns) {
      const bool flag = column.type == "flag", is_text = column.type == "text";
      line.text(column.name).text("attempts").nothing();
      line.text(flag ? "yesno" : "text").text(column.what).nothing();
      column.unit.empty() ? line.nothing() : line.text(column.unit);
      flag || is_text ? line.nothing() : line.text(column.type);
      for (int i = 0; i < 4; ++i) line.nothing();
      column.missing.empty() ? line.text("y") : line.nothing();
      for (int i = 0; i < 5; ++i) line.nothing();
      text += line.take();
    }
  }
  return text;
}

}  // namespace seldinger::reports
