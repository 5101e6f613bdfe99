// The course of an attempt, as JSON: what became of each step, and its events.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "assessment/procedure/steps.h"
#include "sim/case/event.h"

namespace seldinger::app {

nlohmann::ordered_json json_of_steps(const std::vector<assessment::StepResult>& steps);
// Null: the attempt was not listened to.
nlohmann::ordered_json json_of_events(const std::optional<std::vector<cases::Event>>& events);

}  // namespace seldinger::app
