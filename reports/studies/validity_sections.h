// The sections of a validity report, in their order.
#pragma once

#include "reports/markup/html.h"
#include "reports/studies/validity_report.h"

namespace seldinger::reports {

Html argument_section(const ValidityReport& report);
Html conclusions_section(const ValidityReport& report);
Html sources_section(const ValidityReport& report);  // panels by Messick's sources
// The panels of sources_section() that tell of agreement and of pass marks.
Html internal_structure_panel(const ValidityReport& report);
Html consequences_panel(const ValidityReport& report);
// A panel's beginning; whoever asks for it ends the article.
Html source_panel(std::string_view source, std::string_view title);
Html flow_section(const ValidityReport& report);
Html limits_section(const ValidityReport& report);      // what the data cannot say
Html reviewer_section(const ValidityReport& report);    // what a reviewer will ask
Html provenance_section(const ValidityReport& report);  // plan, looks, deviations
Html checklist_section(const ValidityReport& report);   // CONSORT and STROBE for simulation research
Html plan_section(const ValidityReport& report);

}  // namespace seldinger::reports
