// Small made-up content for libraries in tests, and ways to compare it bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/database/library.h"
#include "casedb/database/sqlite.h"
#include "sim/base/rng.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger::casedb {

// An empty place of its own for the running test.
inline std::filesystem::path fresh_folder() {
  return fixtures::fresh_test_folder("casedb");
}

inline Library open_library(const std::filesystem::path& folder) {
  auto library = Library::open_or_create(folder);
  if (!library) throw std::runtime_error(library.error().code);
  return std::move(library.value());
}

// Every file below the folder with its bytes. Only while no library there is open in this process: closing a file
// that SQLite also has open would drop SQLite's locks.
inline std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    contents[std::filesystem::relative(entry.path(), folder).string()] =
        entry.is_regular_file() ? fixtures::whole_file(entry.path()) : std::string("folder");
  return contents;
}

// Oblique and left-handed, with noise so that it does not compress.
inline volume::Volume sample_volume(glm::ivec3 size = {9, 7, 5}, std::uint64_t seed = 1) {
  const double c = 0.8, s = 0.6;
  const glm::dmat3 direction(glm::dvec3(c, s, 0.0), glm::dvec3(-s, c, 0.0), glm::dvec3(0.0, 0.0, -1.0));
  volume::Volume volume = volume::make_volume(size, {0.7, 0.7, 1.0 / 3.0}, direction, {-123.456, 78.9, 1e-3});
  base::Rng rng(seed);
  for (auto& hu : volume.hu) hu = static_cast<std::int16_t>(rng.uniform() * 4000.0 - 1024.0);
  return volume;
}

inline cases::Mesh sample_mesh() {
  cases::Mesh mesh;
  mesh.vertices_lps_mm = {{0.0F, 0.0F, 0.0F}, {1.5F, 0.0F, 0.0F}, {0.0F, 1.5F, 0.0F}, {0.0F, 0.0F, 1.0F / 3.0F}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  mesh.cut = {1, 0, 0, 1};
  return mesh;
}

inline NewCase sample_case(const std::string& title = "Kidney A") {
  NewCase sample;
  sample.title = title;
  sample.origin = "import";
  sample.volume = sample_volume();
  sample.skin = sample_mesh();
  sample.attributes = {{"modality", "CT"}, {"kvp", "120"}, {"body_part", "ABDOMEN"}};
  sample.warnings = {{"single_slice", "one slice only"}, {"spacing", "slices 3 and 4 are 1.1 mm apart"}};
  sample.slices_used = 5;
  return sample;
}

// A point inside sample_volume().
inline cases::Lesion sample_lesion() {
  const glm::dvec4 center = sample_volume().lps_from_voxel * glm::dvec4(4.25, 3.0, 2.0, 1.0);
  return {glm::dvec3(center), 1.0 / 3.0, 20.5};
}

// Every double is another one, with signed zeros and the smallest and largest among them.
inline cases::Recording sample_recording(std::size_t ticks = 4321, std::uint64_t seed = 7) {
  base::Rng rng(seed);
  const auto point = [&] { return glm::dvec3(rng.normal(), rng.normal(), rng.normal()); };
  cases::Recording recording;
  recording.step_version = 3;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    cases::Inputs inputs;
    inputs.needle = {point(), point(), point()};
    inputs.probe = {point(), point(), point()};
    inputs.fire = tick + 100 > ticks;
    inputs.freeze = tick % 3 == 0;
    recording.inputs.push_back(inputs);
    recording.hashes.push_back(static_cast<std::uint32_t>(rng.bits()));
    if (tick % 10 == 0)
      recording.poses.push_back({static_cast<double>(tick) * 0.001, point(), point(), point(), point(), point()});
    if (tick % 33 == 0)
      recording.frames.push_back(
          {static_cast<double>(tick) * 0.001, tick % 2 == 0, tick % 5 == 0, tick % 7 == 0, rng.uniform()});
  }
  if (ticks > 1) {
    recording.inputs[0].needle.position_lps_mm = {-0.0, 5e-324, 1.7976931348623157e308};
    recording.endpoint = cases::Endpoint{static_cast<double>(ticks - 1) * 0.001, point(), point()};
  }
  return recording;
}

inline NewAttempt sample_attempt(const std::string& case_id, const std::string& lesion_id) {
  NewAttempt attempt;
  attempt.case_id = case_id;
  attempt.lesion_id = lesion_id;
  attempt.operator_name = "novice";
  attempt.seed = 0xfedcba9876543210ULL;
  attempt.program_version = "0.1.0";
  attempt.instrument = {cases::InstrumentKind::core, 160.1, 0.62, 0.41, 2999.5, 21.9, 17.9, 4.1};
  attempt.picture = {cases::Modality::mpr, 120.3, 110.7, 25.0, ""};
  attempt.approach = cases::Approach::out_of_plane;
  attempt.started_us = 1'700'000'000'123'456;
  attempt.duration_s = 4.321;
  attempt.recording = sample_recording();
  attempt.metrics = {{"time_total", 1, 4.321, "s", ""},
                     {"hit", 2, 0.0, "bool", ""},
                     {"entry_angle_error", 1, std::nullopt, "deg", "no plan"},
                     {"closest_approach", 1, 0.1 + 0.2, "mm", ""}};
  attempt.picture_png = {std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}, std::byte{0}};
  return attempt;
}

inline bool same_bits(const glm::dvec3& a, const glm::dvec3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::bit_cast<std::uint64_t>(a[axis]) != std::bit_cast<std::uint64_t>(b[axis])) return false;
  return true;
}
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// The first difference in words; empty when every bit is the same.
inline std::string difference(const cases::Recording& a, const cases::Recording& b) {
  const auto same_pose = [](const cases::ToolPose& p, const cases::ToolPose& q) {
    return same_bits(p.position_lps_mm, q.position_lps_mm) && same_bits(p.axis, q.axis) &&
           same_bits(p.side, q.side);
  };
  if (a.forces != b.forces) return "forces";
  if (a.step_version != b.step_version || !same_bits(a.dt_s, b.dt_s)) return "head";
  if (a.inputs.size() != b.inputs.size() || a.hashes != b.hashes || a.poses.size() != b.poses.size() ||
      a.frames.size() != b.frames.size())
    return "sizes or hashes";
  for (std::size_t i = 0; i < a.inputs.size(); ++i)
    if (!same_pose(a.inputs[i].needle, b.inputs[i].needle) || !same_pose(a.inputs[i].probe, b.inputs[i].probe) ||
        a.inputs[i].fire != b.inputs[i].fire || a.inputs[i].freeze != b.inputs[i].freeze ||
        a.inputs[i].fluoroscope != b.inputs[i].fluoroscope || a.inputs[i].exposure != b.inputs[i].exposure)
      return "inputs of tick " + std::to_string(i);
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const cases::PoseSample &p = a.poses[i], &q = b.poses[i];
    if (!same_bits(p.t_s, q.t_s) || !same_bits(p.tip_lps_mm, q.tip_lps_mm) ||
        !same_bits(p.needle_direction, q.needle_direction) ||
        !same_bits(p.probe_origin_lps_mm, q.probe_origin_lps_mm) || !same_bits(p.probe_axial, q.probe_axial) ||
        !same_bits(p.probe_lateral, q.probe_lateral))
      return "pose " + std::to_string(i);
  }
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    const cases::FrameTruth &p = a.frames[i], &q = b.frames[i];
    if (!same_bits(p.t_s, q.t_s) || p.live != q.live || p.needle_tip != q.needle_tip || p.target != q.target ||
        !same_bits(p.needle_length_mm, q.needle_length_mm) || p.beam != q.beam || p.near_plane != q.near_plane)
      return "frame " + std::to_string(i);
  }
  if (a.endpoint.has_value() != b.endpoint.has_value()) return "endpoint";
  if (a.endpoint &&
      (!same_bits(a.endpoint->t_s, b.endpoint->t_s) || !same_bits(a.endpoint->tip_lps_mm, b.endpoint->tip_lps_mm) ||
       !same_bits(a.endpoint->direction, b.endpoint->direction)))
    return "endpoint";
  return {};
}

// What a constraint refuses is a DatabaseFailure of that kind.
template <typename Function>
testing::AssertionResult refused_by_constraint(const Function& function) {
  try {
    function();
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() == DatabaseFailure::Kind::constraint) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "failed otherwise: " << failure.what();
  }
  return testing::AssertionFailure() << "was accepted";
}

}  // namespace seldinger::casedb
