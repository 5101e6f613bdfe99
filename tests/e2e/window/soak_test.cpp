// Half an hour at the workstation, attempt after attempt, by ultrasound and by fluoroscopy, finished, begun again
// and watched: what the program holds does not grow. SELDINGER_SOAK_SECONDS makes it shorter, for trying.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using fixtures::kPassword;
using fixtures::until;

constexpr double kWarmUpShare = 0.2;  // of the time: caches, arenas and a driver's shaders fill

double wanted_s() {
  const char* told = std::getenv("SELDINGER_SOAK_SECONDS");
  return told != nullptr ? std::strtod(told, nullptr) : 1800.0;
}

// What a process holds, looked at after an attempt, where nothing runs.
struct Held {
  double t_s, resident_mib, heap_mib;
  int threads, descriptors;
};

double status_of(pid_t id, const std::string& field) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(field + ":")) return std::strtod(line.c_str() + field.size() + 1, nullptr);
  return 0.0;
}

int descriptors_of(pid_t id) {
  const std::filesystem::directory_iterator all("/proc/" + std::to_string(id) + "/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

// Theil and Sen's slope, an hour: a lone peak does not turn it.
double slope_an_hour(const std::vector<Held>& held, double Held::*what) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < held.size(); ++i)
    for (std::size_t j = i + 1; j < held.size(); ++j)
      slopes.push_back(3600.0 * (held[j].*what - held[i].*what) / (held[j].t_s - held[i].t_s));
  return median(slopes);
}

// Median of the first or the last third.
double third(const std::vector<Held>& held, double Held::*what, bool last) {
  std::vector<double> values;
  const std::size_t count = std::max<std::size_t>(1, held.size() / 3);
  for (std::size_t i = 0; i < count; ++i) values.push_back(held[last ? held.size() - 1 - i : i].*what);
  return median(values);
}

class Soak : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* words : {"demo --no-serve", "demo --no-serve --modality xray", "user add mona --role mentor"})
      library_.done(words);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_.path(), library_.folder());
  }

  void attempt(bool ultrasound) {
    const fixtures::Screen& screen = trainee_->screen();
    trainee_->press("y");
    trainee_->press("F4");
    if (ultrasound) {
      ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
    } else {
      trainee_->point_at_room();
      screen.hold("p", 1.5);
      screen.hold("Left", 0.7);
      screen.hold("p", 1.5);
    }
    ASSERT_NO_FATAL_FAILURE(trainee_->take("needle"));
    for (int i = 0; i < 6; ++i) screen.wheel(6, 60);
    ASSERT_NO_FATAL_FAILURE(trainee_->fire());
    screen.wheel(-12, 60);
  }
  // The case once more, broken off by beginning again, finished, watched; then back to the choice.
  void round(bool ultrasound) {
    ASSERT_NO_FATAL_FAILURE(trainee_->open_case(ultrasound ? 0 : 1));
    ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
    ASSERT_TRUE(until([&] { return trainee_->now().value("attempt_s", 0.0) > 1.0; }, 60.0));
    ASSERT_NO_FATAL_FAILURE(trainee_->begin_again());
    ASSERT_NO_FATAL_FAILURE(attempt(ultrasound));
    trainee_->press("F9");
    ASSERT_TRUE(trainee_->reaches("debrief", 120.0));
    trainee_->press("w");
    ASSERT_TRUE(trainee_->reaches("watch", 60.0));
    trainee_->passes(2.0);  // what is watched is drawn meanwhile
    trainee_->press("Escape");
    ASSERT_TRUE(trainee_->reaches("debrief", 60.0));
    ASSERT_NO_FATAL_FAILURE(trainee_->leave_debrief());
  }

  Held held(double t_s) {
    const pid_t id = trainee_->program().pid();
    until([&] { return trainee_->now().contains("heap_mib"); }, 5.0);
    return {t_s, status_of(id, "VmRSS") / 1024.0, trainee_->now().value("heap_mib", 0.0),
            static_cast<int>(status_of(id, "Threads")), descriptors_of(id)};
  }

  fixtures::CommandLibrary library_{fixtures::fresh_folder("soak")};
  std::unique_ptr<fixtures::Trainee> trainee_;
};

TEST_F(Soak, HalfAnHourOfAttemptsGrowsNothing) {
  const double all_s = wanted_s();
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("mona", kPassword));
  const auto begun = std::chrono::steady_clock::now();
  const auto passed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  std::vector<Held> warm;
  std::ofstream table(library_.folder() / "held.csv");
  table << "t_s,resident_mib,heap_mib,threads,descriptors\n";
  int rounds = 0;
  while (passed_s() < all_s) {
    for (const bool ultrasound : {true, false}) ASSERT_NO_FATAL_FAILURE(round(ultrasound)) << rounds;
    ++rounds;
    const Held now = held(passed_s());
    table << now.t_s << ',' << now.resident_mib << ',' << now.heap_mib << ',' << now.threads << ','
          << now.descriptors << std::endl;
    if (now.t_s >= kWarmUpShare * all_s) warm.push_back(now);
  }
  ASSERT_GE(warm.size(), 2U) << "longer, for anything to be seen";
  EXPECT_EQ(warm.back().threads, warm.front().threads);
  EXPECT_EQ(warm.back().descriptors, warm.front().descriptors);
  for (const auto& [name, what] :
       {std::pair{"resident", &Held::resident_mib}, std::pair{"heap", &Held::heap_mib}}) {
    const double before = third(warm, what, false), after = third(warm, what, true);
    std::cout << name << ": " << before << " MiB, then " << after << " MiB; " << slope_an_hour(warm, what)
              << " MiB an hour over " << rounds << " rounds\n";
    EXPECT_LE(after, 1.02 * before) << name;
  }
}

}  // namespace
}  // namespace seldinger
