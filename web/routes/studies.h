// On which studies a reader works: asked by every page about them.
#pragma once

#include <vector>

#include "reports/pages/people/studies_page.h"
#include "web/site/site.h"

namespace seldinger::web {

std::vector<reports::StudyView> studies_of(Site& site, const Reader& reader);

}  // namespace seldinger::web
