// case structure, case label.
#include <array>
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cases/case_answers_json.h"
#include "app/cases/label_file.h"
#include "app/cli/command.h"
#include "app/cli/words.h"

namespace seldinger::app {
namespace {

// Where the structure is; throws UsageError when it is not told, or twice.
void read_drawn(const Arguments& arguments, casedb::StructureRow& row) {
  std::optional<glm::dvec3> center;
  if (arguments.has("--center-mm")) {
    center = point_of("--center-mm", arguments.text("--center-mm"));
  }
  if (arguments.has("--tube")) {
    cases::Tube tube;
    for (const std::string& text : arguments.all("--tube")) {
      tube.points_lps_mm.push_back(point_of("--tube", text));
    }
    arguments.required("--radius-mm");
    tube.radius_mm = arguments.number("--radius-mm", 0.0);
    row.drawn = std::move(tube);
  } else if (arguments.has("--radii-mm")) {
    const glm::dvec3 radii = point_of("--radii-mm", arguments.text("--radii-mm"));
    if (!center) throw UsageError("an ellipsoid needs --center-mm X,Y,Z and --radii-mm A,B,C");
    row.drawn = cases::Ellipsoid{*center, radii};
  } else {
    arguments.required("--radius-mm");
    if (!center) throw UsageError("a sphere needs --center-mm X,Y,Z and --radius-mm R");
    row.drawn = cases::Sphere{*center, arguments.number("--radius-mm", 0.0)};
  }
}

volume::TissueClass tissue_of(const Arguments& arguments, const char* option) {
  const std::string name = arguments.required(option);
  const auto tissue = volume::tissue_of_name(name);
  if (!tissue) throw UsageError(std::string(option) + " must be a tissue class: liver, vessel, bone, …");
  return *tissue;
}

// By the label's name or number, of the newest map that has it.
base::Result<void> find_label(casedb::Library& library, const std::string& wanted, casedb::StructureRow& row,
                              std::string& name) {
  const auto found = casedb::find_case(library, row.case_id);
  if (!found) return found.error();
  const auto maps = casedb::load_label_maps(library, *found);
  if (!maps) return maps.error();
  for (const casedb::StoredLabels& map : *maps)
    for (std::size_t label = 1; label < map.labels.names.size(); ++label)
      if (map.labels.names[label] == wanted || std::to_string(label) == wanted) {
        row.labels_sha256 = map.sha256;
        row.label = static_cast<int>(label);
        name = map.labels.names[label];
      }
  if (row.label == 0) return base::Error{"no_label", "no label map of the case has this label"};
  return {};
}

int run_case_structure(const Arguments& arguments) {
  if (arguments.has("--remove")) {
    auto library = open_acting(arguments);
    if (!library) return refuse(library.error());
    if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
    const auto removed = casedb::remove_structure(*library, arguments.positional(0), arguments.text("--remove"));
    return removed ? kDone : refuse(removed.error());
  }
  casedb::StructureRow row;
  row.name = arguments.required("--name");
  const auto rule = cases::structure_rule_from(arguments.required("--rule"));
  if (!rule) throw UsageError("--rule is advisory, major, critical, must_cross, organ or target");
  row.rule = *rule;
  const bool by_class = arguments.has("--class"), by_label = arguments.has("--label");
  const bool drawn = arguments.has("--center-mm") || arguments.has("--tube") || arguments.has("--radius-mm");
  if (by_class + by_label + drawn != 1)
    throw UsageError(
        "a structure is a --class, a --label, or drawn: --center-mm and --radius-mm or --radii-mm, or --tube");
  if (by_class) {
    row.kind = casedb::StructureKind::tissue_class;
    row.tissue = tissue_of(arguments, "--class");
  } else if (by_label) {
    row.kind = casedb::StructureKind::label;
    if (arguments.has("--tissue")) row.tissue = tissue_of(arguments, "--tissue");
  } else {
    read_drawn(arguments, row);
    row.tissue = tissue_of(arguments, "--tissue");
    if (arguments.text("--hu") != "as_ct") row.hu = arguments.number("--hu", volume::typical_hu(row.tissue));
  }
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
  row.case_id = arguments.positional(0);
  if (by_label) {
    std::string label_name;
    if (const auto found = find_label(*library, arguments.text("--label"), row, label_name); !found)
      return refuse(found.error());
    if (!arguments.has("--tissue")) {
      const auto tissue = volume::tissue_of_name(label_name);
      if (!tissue) throw UsageError("--tissue is needed: the label's name is not known, so give its tissue");
      row.tissue = *tissue;
    }
  }
  const auto structure_id = casedb::add_structure(*library, row);
  if (!structure_id) return refuse(structure_id.error());
  if (arguments.has("--json"))
    std::fputs(json_of_structure(*structure_id).c_str(), stdout);
  else
    std::printf("structure %s\n", structure_id->c_str());
  return kDone;
}

int run_case_label(const Arguments& arguments) {
  std::vector<std::pair<int, std::string>> names;
  for (const std::string& text : arguments.all("--name")) {
    const std::size_t at = text.find('=');
    const auto number = at == text.npos ? std::nullopt : parse_number(text.substr(0, at));
    if (!number || *number != static_cast<int>(*number) || *number < 1 || *number > 255 || at + 1 >= text.size())
      throw UsageError("--name is N=NAME, N from 1 to 255");
    names.emplace_back(static_cast<int>(*number), text.substr(at + 1));
  }
  const std::string numbering = arguments.text("--numbering", "own");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto may = may_work_on(*library, arguments); !may) return refuse(may.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto read = read_label_file(arguments.positional(1), *row, names,
                                    numbering == "own" ? Numbering::own : Numbering::total_segmentator);
  if (!read) return refuse(error_of("FILE", arguments.positional(1), read.error()));
  const auto sha256 = casedb::add_label_map(*library, row->case_id, read->labels);
  if (!sha256) return refuse(sha256.error());
  std::array<std::size_t, 256> voxels{};
  for (const std::uint8_t label : read->labels.label) ++voxels[label];
  std::vector<LabelCount> counts;
  for (std::size_t label = 1; label < read->labels.names.size(); ++label)
    if (voxels[label] > 0)
      counts.push_back({static_cast<int>(label), read->labels.names[label], voxels[label],
                        volume::tissue_of_name(read->labels.names[label])});
  if (arguments.has("--json")) {
    std::fputs(json_of_labels(counts, read->resampled).c_str(), stdout);
    return kDone;
  }
  std::printf("%zu labels%s\n", counts.size(), read->resampled ? ", resampled to the case's grid" : "");
  for (const LabelCount& one : counts)
    std::printf("%4d  %-30s %zu voxels%s\n", one.label, one.name.c_str(), one.voxels,
                one.tissue ? (std::string(", now ") + volume::about(*one.tissue).name).c_str() : "");
  return kDone;
}

constexpr Option kStructureOptions[] = {
    kLibrary,
    {"--name", "TEXT", "what it is called"},
    {"--rule", "advisory|major|critical|must_cross|organ|target", "what a needle in it means"},
    {"--class", "TISSUE", "all voxels of the case's tissue class"},
    {"--label", "NAME|N", "a label of the case's label maps"},
    {"--center-mm", "X,Y,Z", "drawn: a sphere or an ellipsoid"},
    {"--radius-mm", "R", "drawn: of a sphere or a tube"},
    {"--radii-mm", "A,B,C", "drawn: of an ellipsoid, along LPS"},
    {"--tube", "X,Y,Z", "drawn: a point of a tube's middle line; give them in order", true},
    {"--tissue", "TISSUE", "drawn, or a label: the tissue class that every picture shows and the hand feels"},
    {"--hu", "H|as_ct",
     "drawn: its HU in the CT; as_ct: as the CT is there; default what is typical of its class "
     "(docs/decisions/0018)"},
    {"--remove", "NAME", "removes one again"},
    kJson};

constexpr Option kLabelOptions[] = {
    kLibrary,
    {"--name", "N=TEXT", "what label N is called", true},
    {"--numbering", "own|totalsegmentator",
     "whose numbering the labels use: names and tissues follow from it; default own"},
    kJson};

}  // namespace

Command case_structure_command() {
  return {
      .name = "case structure",
      .positionals = "CASE",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kStructureOptions,
      .acts = true,
      .summary =
          "Adds a structure to a case: a tissue class, a label or a drawn shape; and says what touching it means.",
      .run = &run_case_structure};
}

Command case_label_command() {
  return {.name = "case label",
          .positionals = "CASE FILE",
          .min_positionals = 2,
          .max_positionals = 2,
          .options = kLabelOptions,
          .acts = true,
          .summary =
              "Adds a label map (NIfTI, NRRD, MetaImage) to a case; another grid is resampled by the nearest "
              "voxel. A label with the name of a tissue or an organ is the tissue of its voxels from then on.",
          .run = &run_case_label};
}

}  // namespace seldinger::app
