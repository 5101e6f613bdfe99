// How the servo kept time, as part of a document.
#pragma once

#include <nlohmann/json.hpp>

#include "sim/case/record/servo_record.h"

namespace seldinger::app {

nlohmann::ordered_json json_of_servo_record(const cases::ServoRecord& record);

}  // namespace seldinger::app
