// The frame of a report about learning: its style, and what has to be said first.
#pragma once

#include <cstdint>
#include <string>

#include "reports/markup/html.h"

namespace seldinger::reports {

// "Made 2026-03-01 14:05 UTC by version 0.9.", and that all of it is simulated where it is.
Html made_by(std::int64_t made_us, const std::string& program_version, bool simulated);
std::string learning_page(std::string_view title, const Html& content);

}  // namespace seldinger::reports
