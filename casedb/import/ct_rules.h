// What a source must be to be taken for a CT of a patient: stated rules, one table, which docs/import.md shows. Not
// asked of label maps and of volumes that scenes are made of.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "casedb/import/files/source.h"
#include "sim/base/result.h"
#include "sim/case/fluoroscope.h"

namespace seldinger::casedb {

// Diagnostic CT is reconstructed at 10 mm and less.
constexpr double kThickMm = 10.0;

enum class CtVerdict { warns, refuses };

struct CtRule {
  CtVerdict verdict;
  const char* code;
  std::string when;                       // in words, with its numbers
  std::string (*finding)(const Source&);  // what is found; empty: nothing. None: found while the source is read
};
std::span<const CtRule> ct_rules();

// Adds warnings; refused with every rule's reason that refuses. Of one code only the refusal is told.
base::Result<void> judge_ct(Source& source);

// What was refused because of what the values show (a face, no body), where a missing rescale may have made them
// wrong: that is named first.
base::Error with_doubted_hu(base::Error refused, const Source& source);

// `thin_slab`: the volume does not fill the smallest field of the fluoroscope along one of its axes.
std::optional<base::Problem> thin_slab(const volume::Volume& volume, const cases::Fluoroscope& machine = {});

// The table of docs/import.md.
std::string ct_rules_markdown();

}  // namespace seldinger::casedb
