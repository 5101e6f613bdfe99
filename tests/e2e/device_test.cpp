// Tests of `seldinger device list`, `probe` and `simulate` as their users type them, on loopback.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/fixtures/process.h"
#include "tests/fixtures/until.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kProgram;

// `device simulate` in the background, on a port of its own choice.
class Simulated {
 public:
  explicit Simulated(const std::vector<std::string>& words, const std::filesystem::path& scratch)
      : said_(scratch / "simulated.txt") {
    std::vector<std::string> all = {kProgram, "device", "simulate", "--port", "0", "--seconds", "60"};
    all.insert(all.end(), words.begin(), words.end());
    std::fflush(stdout);  // a child would write it again
    child_ = ::fork();
    if (child_ == 0) {
      std::vector<char*> arguments;
      for (std::string& word : all) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      if (std::freopen(said_.c_str(), "w", stdout) != nullptr) ::execv(kProgram.c_str(), arguments.data());
      ::_exit(127);
    }
    EXPECT_TRUE(fixtures::until([&] {
      const std::string said = fixtures::whole_file(said_);
      if (const auto at = said.rfind(':'); at != std::string::npos && said.back() == '\n')
        port_ = said.substr(at + 1, said.size() - at - 2);
      return !port_.empty();
    }));
  }
  ~Simulated() {
    ::kill(child_, SIGTERM);
    int status = 0;
    ::waitpid(child_, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "ends when it is asked to";
  }
  Simulated(const Simulated&) = delete;
  Simulated& operator=(const Simulated&) = delete;
  const std::string& port() const { return port_; }

 private:
  std::filesystem::path said_;
  pid_t child_ = -1;
  std::string port_;
};

TEST(Device, ListAndProbeReadASimulatedService) {
  const auto scratch = fixtures::fresh_folder("device");
  const Simulated service({"--swap"}, scratch);
  auto ran = fixtures::run(kProgram + " device list --json --port " + service.port(), scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json listed = Json::parse(ran.out);
  EXPECT_EQ(listed["connected"], true);
  EXPECT_EQ(listed["arms"], (Json::array({"sim-right", "sim-left"})));
  EXPECT_EQ(listed["left"], "sim-left") << "whatever their order";
  EXPECT_EQ(listed["right"], "sim-right");
  EXPECT_TRUE(listed["space_mouse"].is_boolean());

  ran = fixtures::run(kProgram + " device probe --seconds 1 --json --port " + service.port(), scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json probed = Json::parse(ran.out);
  for (const char* side : {"left", "right"}) {
    const Json& arm = probed[side];
    EXPECT_GT(arm["readings_per_s"], 200.0) << "of 1000, on a busy machine";
    EXPECT_GT(arm["interval"]["p50_ms"], 0.0);
    EXPECT_GT(arm["round_trip"]["n"], 100);
    EXPECT_EQ(arm["orientation"].size(), 9U);
    // A circle of 20 mm about (0, 100, 0), of which a second shows a part.
    const double x = arm["position_mm"][0], y = arm["position_mm"][1];
    EXPECT_NEAR(std::hypot(x, y - 100.0), 20.0, 3.0);
    EXPECT_GT(arm["most_mm"][1].get<double>() - arm["least_mm"][1].get<double>(), 2.0);
  }
  ran = fixtures::run(kProgram + " device probe --seconds 0.5 --port " + service.port(), scratch);
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.out.find("right: arm sim-right, grip sim-grip-right"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("readings/s"), std::string::npos);
}

TEST(Device, AServiceThatFailsIsStillRead) {
  const auto scratch = fixtures::fresh_folder("device_faults");
  const Simulated service({"--lose-every", "0.4", "--damage-every", "0.15", "--delay-ms", "3"}, scratch);
  const auto ran = fixtures::run(kProgram + " device probe --seconds 2 --json --port " + service.port(), scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json probed = Json::parse(ran.out);
  EXPECT_GT(probed["left"]["readings"], 50);
  EXPECT_GE(probed["left"]["round_trip"]["p50_ms"], 3.0);
}

TEST(Device, WithoutAServiceThereIsNothingToProbe) {
  const auto scratch = fixtures::fresh_folder("device_none");
  auto ran = fixtures::run(kProgram + " device list --port 1", scratch);
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.out.find("No Haply Inverse service at 127.0.0.1:1."), std::string::npos);
  ran = fixtures::run(kProgram + " device probe --port 1", scratch);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.err.rfind("error: no_device: ", 0), 0U);
  EXPECT_EQ(fixtures::run(kProgram + " device probe --seconds 0", scratch).exit_code, 2);
  EXPECT_EQ(fixtures::run(kProgram + " device simulate --delay-ms -1", scratch).exit_code, 2);
  EXPECT_EQ(fixtures::run(kProgram + " device simulate --port 70000", scratch).exit_code, 2);
  EXPECT_EQ(fixtures::run(kProgram + " device probe --port 1 --station /nowhere.json", scratch).exit_code, 3);
}

}  // namespace
}  // namespace seldinger
