// What the tables of drills and cases are written with.
#pragma once

#include <initializer_list>

#include "app/demo/demo_cases.h"

namespace seldinger::app {

cases::Instrument core_needle();  // 18 G: throw 22, notch 18, dead tip 4 mm
// Long enough for a kidney of an obese adult.
cases::Instrument access_needle(int gauge);
// For a vessel under the skin: 7 cm, of a micropuncture set for children (21 G) 4 cm (catalogues; recalled).
cases::Instrument vessel_needle(int gauge);

cases::LesionForm sphere_form(const glm::dvec3& center_lps_mm, double radius_mm, double hu);
// A tumour, as the pictures draw it.
cases::LesionForm solid_form(cases::LesionKind kind, const glm::dvec3& center_lps_mm, double radius_mm, double hu);
// No lesion: where the needle is to go, as the CT shows it.
cases::LesionForm place_form(const glm::dvec3& center_lps_mm, const glm::dvec3& radii_mm);

// A structure by its shape (without HU: as the CT shows it), by the name of a label, by tissue class.
DemoStructure drawn(const char* name, cases::StructureRule rule, volume::TissueClass tissue, cases::Shape shape,
                    std::optional<double> hu = std::nullopt);
DemoStructure labelled(const char* label, cases::StructureRule rule);
DemoStructure of_class(const char* name, cases::StructureRule rule, volume::TissueClass tissue);

assessment::PassRule rule_of(std::initializer_list<const char*> pass, std::initializer_list<const char*> critical);

// Structures and lesions of `wanted`, put into the case; labels are found by name in the maps that the case has.
base::Result<void> add_parts(casedb::Library& library, const DemoCase& wanted, const std::string& case_id);

// The graded cases without a patient: setting and rule, the same for whoever lies on the table.
DemoCase liver_between_ribs(), kidney_cortex(), jugular_vein(), beside_a_vein(), to_be_deferred(DemoCase like);

}  // namespace seldinger::app
