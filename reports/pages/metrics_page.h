// Every metric with its definition, each under an anchor of its own: /metrics#metric-vis_joint.
#pragma once

#include <string>

#include "reports/pages/page.h"

namespace seldinger::reports {

std::string metrics_page(const Visitor& visitor);

}  // namespace seldinger::reports
