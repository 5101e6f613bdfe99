// Whose learning a reader may see: asked by every page about it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/pages/people/learner_view.h"
#include "web/site/site.h"

namespace seldinger::web {

// Those whom the reader may see, by name, each with the cohorts in which they may be seen.
std::vector<reports::LearnerView> visible_learners(Site& site, const Reader& reader);

// A learner with nothing that the reader may not see; none: there is nobody, or they are not the reader's to see.
std::optional<reports::LearnerView> visible_learner(Site& site, const Reader& reader, const std::string& person_id);

}  // namespace seldinger::web
