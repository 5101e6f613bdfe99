#include "tests/assessment/laws/random_hands.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace seldinger::assessment {
namespace {

using Knots = std::vector<Knot>;

constexpr double kShortestS = 0.3;  // from rest to rest; in half the time still no faster than a hand can

// Knots by rising time, each way begun where the one before ended.
class Program {
 public:
  Program(Draw& draw, bool in_plane) : draw_(draw) {
    const double tilt = in_plane ? draw.in(-0.7, 0.7) : draw.side(0.2, 0.7);
    begin(ways_.depth_mm, -draw.in(15.0, 30.0));
    begin(ways_.tilt, tilt);
    begin(ways_.turn, draw.in(-0.08, 0.08));
    begin(ways_.pivot_x_mm, draw.in(-2.0, 2.0));
    begin(ways_.pivot_z_mm, draw.in(-2.0, 2.0));
    begin(ways_.probe_x_mm, in_plane ? draw.side(20.0, 40.0) : draw.side(4.0, 20.0));
    begin(ways_.probe_z_mm, in_plane ? draw.in(-1.5, 1.5) : draw.in(-6.0, 6.0));
    begin(ways_.probe_tilt, draw.in(-0.1, 0.1));
    begin(ways_.probe_fan, draw.in(-0.1, 0.1));
    ways_.sway_mm = draw.chance(0.6) ? draw.in(0.02, 0.2) : 0.0;
    ways_.sway_hz = draw.in(0.2, 0.6);
  }

  Ways make() {
    wait(draw_.in(0.4, 1.0));
    if (draw_.chance(0.4)) move_probe();
    // Beside the skin for a moment, or straight through it.
    if (draw_.chance(0.5)) go(-draw_.in(2.0, 5.0), draw_.in(8.0, 40.0)), wait(draw_.in(0.2, 0.6));
    ways_.puncture_s = now_s_;
    go(draw_.in(8.0, 22.0), draw_.in(5.0, 30.0));
    wait(draw_.in(0.3, 0.6));
    const int pushes = draw_.from(1, 4);
    for (int i = 0; i < pushes; ++i) push();
    if (draw_.chance(0.1)) go(-draw_.in(6.0, 12.0), draw_.in(10.0, 30.0));
    wait(draw_.in(0.5, 0.9));
    ways_.end_s = now_s_;
    return ways_;
  }

 private:
  static void begin(Knots& knots, double value) { knots.push_back({0.0, value}); }
  void wait(double seconds) { now_s_ += seconds; }
  void reach_in(Knots& knots, double value, double seconds) {
    knots.push_back({now_s_, knots.back().value});
    knots.push_back({now_s_ + seconds, value});
  }
  void go(double depth_mm, double mean_mm_s) {
    const double seconds = std::max(kShortestS, std::abs(depth_mm - depth()) / mean_mm_s);
    reach_in(ways_.depth_mm, depth_mm, seconds);
    now_s_ += seconds;
  }
  double depth() const { return ways_.depth_mm.back().value; }

  void push() {
    if (depth() < 60.0) {
      const bool creeps = draw_.chance(0.2);  // as slowly as a hand that trembles
      go(depth() + (creeps ? draw_.in(1.5, 4.0) : draw_.in(5.0, 16.0)),
         creeps ? draw_.in(1.0, 2.5) : draw_.in(4.0, 30.0));
    }
    wait(draw_.in(0.0, 0.6));
    if (draw_.chance(0.3)) move_probe();
    if (draw_.chance(0.25)) jiggle();
    if (draw_.chance(0.3)) withdraw();
    if (draw_.chance(0.08)) begin_again();
  }
  void jiggle() {
    const double here_mm = depth(), by_mm = draw_.in(1.5, 4.0), mm_s = draw_.in(6.0, 20.0);
    for (int i = draw_.from(1, 3); i > 0; --i) go(here_mm - by_mm, mm_s), go(here_mm, mm_s);
  }
  void withdraw() {
    go(depth() * (1.0 - draw_.in(0.3, 0.8)), draw_.in(6.0, 30.0));
    const double seconds = draw_.in(0.4, 1.0);
    if (draw_.chance(0.7)) {
      reach_in(ways_.tilt, ways_.tilt.back().value + draw_.in(-0.15, 0.15), seconds);
      reach_in(ways_.turn, ways_.turn.back().value + draw_.in(-0.06, 0.06), seconds);
    }
    wait(seconds);
    go(depth() + draw_.in(10.0, 25.0), draw_.in(5.0, 30.0));
  }
  void begin_again() {
    go(-draw_.in(4.0, 10.0), draw_.in(10.0, 30.0));
    const double seconds = draw_.in(0.4, 1.0);
    reach_in(ways_.pivot_x_mm, ways_.pivot_x_mm.back().value + draw_.in(-8.0, 8.0), seconds);
    reach_in(ways_.pivot_z_mm, ways_.pivot_z_mm.back().value + draw_.in(-8.0, 8.0), seconds);
    wait(seconds);
    go(draw_.in(10.0, 30.0), draw_.in(5.0, 30.0));
  }
  // It goes on while the needle may, too.
  void move_probe() {
    const double seconds = draw_.in(0.5, 2.0);
    if (now_s_ < probe_free_s_) return;
    if (draw_.chance(0.7)) reach_in(ways_.probe_x_mm, ways_.probe_x_mm.back().value + draw_.in(-8.0, 8.0), seconds);
    if (draw_.chance(0.5)) reach_in(ways_.probe_z_mm, ways_.probe_z_mm.back().value + draw_.in(-4.0, 4.0), seconds);
    if (draw_.chance(0.4)) reach_in(ways_.probe_tilt, ways_.probe_tilt.back().value + draw_.in(-0.3, 0.3), seconds);
    if (draw_.chance(0.3)) reach_in(ways_.probe_fan, ways_.probe_fan.back().value + draw_.in(-0.15, 0.15), seconds);
    probe_free_s_ = now_s_ + seconds;
    if (draw_.chance(0.5)) wait(seconds);
  }

  Draw& draw_;
  Ways ways_;
  double now_s_ = 0.0, probe_free_s_ = 0.0;
};

}  // namespace

glm::dvec3 Draw::direction() {
  return glm::normalize(glm::dvec3(rng_.normal(), rng_.normal(), rng_.normal()));
}

Ways random_ways(Draw& draw, bool in_plane) {
  return Program(draw, in_plane).make();
}

glm::dvec3 needle_direction(const Ways& ways, double t_s) {
  const double tilt = reach(ways.tilt, t_s), turn = reach(ways.turn, t_s);
  return glm::normalize(glm::dvec3(std::sin(tilt), std::cos(tilt), std::sin(turn)));
}

glm::dvec3 tip_at(const Ways& ways, double t_s) {
  // Sways come and go, so that the hand is at rest at both ends.
  const double envelope = reach({{0.1, 0.0}, {0.4, 1.0}, {ways.end_s - 0.45, 1.0}, {ways.end_s - 0.15, 0.0}}, t_s);
  const double phase = 2.0 * std::numbers::pi * ways.sway_hz * t_s;
  const glm::dvec3 sway =
      glm::dvec3(std::sin(phase), 0.3 * std::sin(1.7 * phase + 1.0), std::sin(1.3 * phase + 2.0)) *
      (ways.sway_mm * envelope);
  const glm::dvec3 pivot(reach(ways.pivot_x_mm, t_s), 0.0, reach(ways.pivot_z_mm, t_s));
  return pivot + needle_direction(ways, t_s) * reach(ways.depth_mm, t_s) + sway;
}

cases::PoseSample pose_at(const Ways& ways, double t_s, bool in_plane) {
  cases::PoseSample pose;
  pose.t_s = t_s;
  pose.tip_lps_mm = tip_at(ways, t_s);
  pose.needle_direction = needle_direction(ways, t_s);
  pose.probe_origin_lps_mm = {reach(ways.probe_x_mm, t_s), 0.0, reach(ways.probe_z_mm, t_s)};
  const double tilt = reach(ways.probe_tilt, t_s), fan = reach(ways.probe_fan, t_s);
  pose.probe_axial = glm::dvec3(std::sin(tilt), std::cos(tilt) * std::cos(fan), std::cos(tilt) * std::sin(fan));
  const glm::dvec3 along = in_plane ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  pose.probe_lateral = glm::normalize(along - glm::dot(along, pose.probe_axial) * pose.probe_axial);
  return pose;
}

}  // namespace seldinger::assessment
