// What `doctor` answers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/library/fitness.h"

namespace seldinger::app {

struct DoctorAnswer {
  std::vector<std::pair<std::string, std::string>> facts;
  Fitness fitness;
};

std::string json_of_doctor(const DoctorAnswer& doctor);

}  // namespace seldinger::app
