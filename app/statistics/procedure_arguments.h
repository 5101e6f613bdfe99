// How a statistical procedure is asked for on the command line: its columns of a CSV file and its options.
#pragma once

#include <string>

#include "app/cli/command.h"
#include "app/statistics/table_csv.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::app {

inline constexpr Option kCsv{
    "--csv", "FILE", "the data, a header and then one observation per line: UTF-8; empty, NA or NaN is missing"};
inline constexpr Option kValue{
    "--value", "COL", "the column of numbers; where a test takes several, their names separated by commas"};
inline constexpr Option kGroup{"--group", "COL", "the group of each line"};
inline constexpr Option kSubject{"--subject", "COL", "the person of each line: the person is the unit"};
inline constexpr Option kRater{"--rater", "COL", "who or what gave the value: a rater, a case, a judge"};
inline constexpr Option kX{
    "--x", "COL", "a second column of numbers, where the test needs one: occasion, dose, event, predictor"};
inline constexpr Option kProcedureOptions{"--options", "k=v,…", "the test's options; write a list as a:b:c"};

// "k=v,k=v" in words that the procedure knows; throws UsageError.
assessment::statistics::ProcedureOptions options_for(const assessment::statistics::Procedure& procedure,
                                                     const std::string& typed);
// The columns named by the options above, with all that the procedure needs; throws UsageError.
TableColumns columns_for(const assessment::statistics::Procedure& procedure, const Arguments& arguments);
// The file, as the procedure takes it. Refused as read_text_of, and `bad_csv`.
base::Result<ReadTable> read_for(const assessment::statistics::Procedure& procedure, const TableColumns& columns,
                                 const Arguments& arguments);

}  // namespace seldinger::app
