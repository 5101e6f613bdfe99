// The sections of a validity report, in their order.
#pragma once

#include "reports/markup/html.h"
#include "reports/studies/validity_report.h"

namespace seldinger::reports {

// A panel of one source of validity, to be ended by </article>; and one that says why it has none.
Html evidence_panel(std::string_view source, std::string_view title);
Html no_evidence_yet(std::string_view source, std::string_view title, std::string_view what);
// A row of a table of facts.
void add_fact_row(Html& html, std::string_view name, std::string_view value);

Html argument_section(const ValidityReport& report);
Html conclusions_section(const ValidityReport& report);
Html sources_section(const ValidityReport& report);   // panels by Messick's sources
Html structure_panels(const ValidityReport& report);  // of them: internal structure
// Of them, too: how far repeated attempts agree, and what pass marks do.
Html internal_structure_panel(const ValidityReport& report);
Html consequences_panel(const ValidityReport& report);
Html relations_panel(const ValidityReport& report);  // relations to other variables: ratings, stated experience
Html subgroups_panel(const ValidityReport& report);  // consequences: for whom
Html published_panel(const ValidityReport& report);  // relations to other variables: beside published effects
Html flow_section(const ValidityReport& report);
Html limits_section(const ValidityReport& report);      // what the data cannot say
Html reviewer_section(const ValidityReport& report);    // what a reviewer will ask
Html provenance_section(const ValidityReport& report);  // plan, looks, deviations
Html checklist_section(const ValidityReport& report);   // CONSORT and STROBE for simulation research
Html plan_section(const ValidityReport& report);

}  // namespace seldinger::reports
