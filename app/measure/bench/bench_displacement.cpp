// bench --stage displacement: time against error of what moves tissue under a probe, of the way back, and of whole
// pictures.
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>

#include "app/measure/bench/bench.h"
#include "app/measure/rigs/contact_peers.h"
#include "sim/base/failure.h"
#include "sim/base/rng.h"
#include "sim/imaging/displacement/points_gpu.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/tissue/displacement.h"
#include "sim/tissue/rest_plane.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {
namespace {

constexpr double kRadiusMm = 20.0;  // the probe's head, as touch feels it

tissue::Displacement pressed(double depth_mm) {
  const tissue::SkinPress press{
      .at_lps_mm = glm::dvec3(0.0), .inward = {0.0, 0.0, 1.0}, .radius_mm = kRadiusMm, .depth_mm = depth_mm};
  return tissue::displacement_of({.presses = {&press, 1}});
}

BenchRow row_of(const std::string& method, const std::string& setting, const std::string& size) {
  return {"displacement", method, setting, "cpu", "1 thread", size, 0, 0, 0, 0, "", "", ""};
}

void per(BenchRow& row, std::size_t count) {
  const auto n = static_cast<double>(count);
  row.ms_median /= n;
  row.ms_min /= n;
  row.ms_max /= n;
}

// Places around a contact of radius a, out to 4a and down to 6a, each as probable as its volume; and where Hertz
// puts them.
struct Places {
  std::vector<glm::dvec3> rest_mm, expected_mm;
};
Places places(const BallContact& contact, int n) {
  base::Rng rng(1);
  const double a = contact_radius_mm(contact);
  Places made;
  for (int i = 0; i < n; ++i) {
    const double r = 4.0 * std::sqrt(rng.uniform()), angle = 2.0 * std::numbers::pi * rng.uniform();
    const double z = 6.0 * rng.uniform();
    const auto u = hertz_reference(contact, r * a, z * a);
    const glm::dvec2 away(std::cos(angle), std::sin(angle));
    made.rest_mm.push_back(a * glm::dvec3(r * away, z));
    made.expected_mm.push_back(glm::dvec3(u.outwards_mm * away, u.inwards_mm));
  }
  return made;
}

struct Miss {
  double squares = 0.0, most = 0.0;
  int n = 0;
  void add(const glm::dvec3& apart) {
    const double square = glm::dot(apart, apart);
    squares += square;
    if (!(square <= most * most)) most = std::sqrt(square);
    ++n;
  }
  double rms() const { return std::sqrt(squares / n); }
};

void measure_models(double depth_mm, bool quick, std::vector<BenchRow>& rows) {
  const BallContact contact{kRadiusMm, depth_mm};
  const Places tried = places(contact, quick ? 2000 : 20000);
  auto models = contact_peers(contact);
  models.push_back({"Hertz' potential", [displacement = pressed(depth_mm)](const glm::dvec3& at_mm) {
                      return tissue::displaced(displacement, at_mm) - at_mm;
                    }});
  for (const ContactPeer& model : models) {
    BenchRow row = row_of(model.name, "", "press " + bench_number(depth_mm) + " mm");
    Miss miss;
    for (std::size_t i = 0; i < tried.rest_mm.size(); ++i)
      miss.add((model.displacement_mm(tried.rest_mm[i]) - tried.expected_mm[i]) / depth_mm);
    glm::dvec3 sum(0.0);  // so that nothing is left out
    time_into(row, quick ? 5 : 31, [&] {
      for (const glm::dvec3& at_mm : tried.rest_mm) sum += model.displacement_mm(at_mm);
    });
    per(row, tried.rest_mm.size());
    row.setting = "per point, at most " + bench_number(100.0 * miss.most) + " %";
    row.error = std::isfinite(sum.x) ? bench_number(100.0 * miss.rms()) : "nan";
    row.error_unit = "% of depth rms in 4a x 6a";
    row.reference = "Boussinesq added up over Hertz' pressure";
    rows.push_back(row);
  }
}

// A picture's samples under the probe: 100 mm square in the plane of the axis, from the skin down, at rest and
// where they are now.
struct Samples {
  std::vector<glm::dvec3> rest_mm, at_mm;
};
Samples samples(const tissue::Displacement& displacement, int side_px) {
  Samples made;
  for (int j = 0; j < side_px; ++j)
    for (int i = 0; i < side_px; ++i) {
      const glm::dvec3 rest_mm(100.0 * ((i + 0.5) / side_px - 0.5), 0.0, 100.0 * (j + 0.5) / side_px);
      made.rest_mm.push_back(rest_mm);
      made.at_mm.push_back(tissue::displaced(displacement, rest_mm));
    }
  return made;
}

void finish(BenchRow& row, const Miss& miss, const std::string& steps) {
  row.setting = steps + ", at most " + bench_number(miss.most) + " mm";
  row.error = bench_number(miss.rms());
  row.error_unit = "mm rms";
  row.reference = "where each sample came from";
}

void measure_inverse(double depth_mm, bool quick, std::vector<BenchRow>& rows) {
  const tissue::Displacement displacement = pressed(depth_mm);
  const int side_px = quick ? 128 : 256;
  const Samples picture = samples(displacement, side_px);
  const std::string size = "back from a press of " + bench_number(depth_mm) + " mm";
  const std::string pixels = std::to_string(side_px) + "x" + std::to_string(side_px);
  std::optional<gpu::Context> context;
  std::optional<imaging::DisplacedPointsGpu> on_gpu;
  std::vector<glm::vec4> given_mm;
  for (const glm::dvec3& at_mm : picture.at_mm) given_mm.push_back(glm::vec4(glm::dvec4(at_mm, 0.0)));
  try {
    context.emplace();
    on_gpu.emplace(*context, given_mm.size());
  } catch (const base::Failure& failure) {
    std::fprintf(stderr, "no GL here: %s\n", failure.what());
  }
  for (const double spacing_mm : {1.0, 2.0, 4.0, 8.0}) {
    BenchRow row = row_of("grid", "", size);
    std::vector<glm::dvec3> found_mm(picture.at_mm.size());
    time_into(row, quick ? 3 : 11, [&] {
      const tissue::RestPlane plane(
          displacement, {.first_lps_mm = {-60.0, 0.0, 0.0}, .v = {0.0, 0.0, 1.0}, .size_mm = {120.0, 110.0}},
          spacing_mm);
      for (std::size_t i = 0; i < found_mm.size(); ++i)
        found_mm[i] = plane.rest_of(picture.at_mm[i].x + 60.0, picture.at_mm[i].z);
    });
    Miss miss;
    for (std::size_t i = 0; i < found_mm.size(); ++i) miss.add(found_mm[i] - picture.rest_mm[i]);
    finish(row, miss, "every " + bench_number(spacing_mm) + " mm, " + pixels);
    rows.push_back(row);
  }
  for (const int newton : {0, 1, 2})
    for (int fixed = 1; fixed <= (newton == 0 ? 8 : 4); ++fixed) {
      const std::string method = newton == 0 ? "fixed point" : "fixed point, then Newton " + std::to_string(newton);
      const std::string steps = std::to_string(fixed) + " steps, " + pixels;
      BenchRow row = row_of(method, "", size);
      std::vector<glm::dvec3> found_mm(picture.at_mm.size());
      time_into(row, quick ? 3 : 5, [&] {
        for (std::size_t i = 0; i < found_mm.size(); ++i)
          found_mm[i] = tissue::rest_of(displacement, picture.at_mm[i], {fixed, newton});
      });
      Miss miss;
      for (std::size_t i = 0; i < found_mm.size(); ++i) miss.add(found_mm[i] - picture.rest_mm[i]);
      finish(row, miss, steps);
      rows.push_back(row);
      if (!on_gpu) continue;
      BenchRow gpu_row = row_of(method, "", size);
      gpu_row.backend = "gpu";
      gpu_row.device = context->renderer();
      Miss gpu_miss;
      const auto of_gpu = on_gpu->rest_of(displacement, given_mm, {fixed, newton});
      for (std::size_t i = 0; i < of_gpu.size(); ++i) gpu_miss.add(glm::dvec3(of_gpu[i]) - picture.rest_mm[i]);
      time_into(gpu_row, quick ? 5 : 21, [&] { on_gpu->again_ms(); });
      finish(gpu_row, gpu_miss, steps);
      rows.push_back(gpu_row);
    }
}

// A whole MPR picture of the torso in a breath under a probe, beside that of one who lies still.
void measure_pictures(bool quick, std::vector<BenchRow>& rows) {
  const volume::Volume volume = volume::make_phantom().volume;
  imaging::MprView view;
  view.center_lps_mm =
      glm::dvec3(volume.lps_from_voxel * glm::dvec4(glm::dvec3(volume.size_voxels - 1) * 0.5, 1.0));
  view.u = {0.8, 0.0, 0.6};
  view.v = {0.0, 1.0, 0.0};
  view.pixel_mm = 0.5;
  view.width_px = view.height_px = quick ? 128 : 512;
  const tissue::SkinPress press{.at_lps_mm = view.center_lps_mm - glm::dvec3(0.0, 60.0, 0.0),
                                .inward = {0.0, 1.0, 0.0},
                                .radius_mm = kRadiusMm,
                                .depth_mm = 8.0};
  const tissue::Breath breath{{.middle_x_mm = view.center_lps_mm.x,
                               .back_y_mm = view.center_lps_mm.y + 110.0,
                               .dome_z_mm = view.center_lps_mm.z},
                              {2.0, 15.0, 16.0}};
  const auto moving = tissue::displacement_of({.presses = {&press, 1}, .breath = breath});
  const imaging::HuImage exact = imaging::mpr_reference(volume, view, {}, moving);
  const std::string pixels = std::to_string(view.width_px) + "x" + std::to_string(view.height_px);
  const auto add = [&](const std::string& method, const std::string& backend, const std::string& device,
                       const std::function<imaging::HuImage()>& make, bool moves) {
    imaging::HuImage picture = make();  // warm
    BenchRow row = row_of(method, pixels + ", linear", "MPR " + bench_size(volume));
    row.backend = backend;
    row.device = device;
    time_into(row, quick ? 3 : 11, [&] { picture = make(); });
    if (moves) {
      double sum = 0.0;
      for (std::size_t i = 0; i < picture.size(); ++i)
        sum += std::abs(static_cast<double>(picture[i]) - static_cast<double>(exact[i]));
      row.error = bench_number(sum / static_cast<double>(picture.size()));
      row.error_unit = "HU mean abs";
      row.reference = "linear, double, plain, 6 fixed-point and 4 Newton steps";
    }
    rows.push_back(row);
  };
  add(
      "still", "cpu", "all cores", [&] { return imaging::mpr_cpu(volume, view, {}); }, false);
  add(
      "moving, grid", "cpu", "all cores", [&] { return imaging::mpr_cpu(volume, view, {}, moving); }, true);
  try {
    gpu::Context context;
    imaging::MprGpu each(context, volume, imaging::WayBack::each_pixel);
    imaging::MprGpu grid(context, volume, imaging::WayBack::grid);
    add(
        "still", "gpu", context.renderer(), [&] { return each.render(view, {}); }, false);
    add(
        "moving, each pixel", "gpu", context.renderer(), [&] { return each.render(view, {}, moving); }, true);
    add(
        "moving, grid", "gpu", context.renderer(), [&] { return grid.render(view, {}, moving); }, true);
  } catch (const base::Failure& failure) {
    std::fprintf(stderr, "no GL here: %s\n", failure.what());
  }
}

}  // namespace

base::Result<void> bench_displacement(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  for (const double depth_mm : {8.0, 12.0}) {
    measure_models(depth_mm, quick, rows);
    measure_inverse(depth_mm, quick, rows);
  }
  measure_pictures(quick, rows);
  bench_moving_ultrasound(quick, rows);
  return {};
}

}  // namespace seldinger::measure
