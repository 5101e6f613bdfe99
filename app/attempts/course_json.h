// The course of an attempt, as JSON: its conditions, what became of each step, and its events.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "assessment/procedure/steps.h"
#include "casedb/attempts/conditions.h"
#include "sim/case/event.h"

namespace seldinger::app {

nlohmann::ordered_json json_of_steps(const std::vector<assessment::StepResult>& steps);
// Each condition by its name; null: not known.
nlohmann::ordered_json json_of_conditions(const casedb::Conditions& conditions);
// Null: the attempt was not listened to.
nlohmann::ordered_json json_of_events(const std::optional<std::vector<cases::Event>>& events);

}  // namespace seldinger::app
