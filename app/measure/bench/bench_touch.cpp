// bench --stage haptics: segment queries beside Embree (Wald et al., ACM TOG 33, 2014) in the same run, and a tick
// of the proxies.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "app/measure/bench/bench.h"
#include "app/measure/rigs/surface_trials.h"
#include "app/measure/rigs/volume_trials.h"
#include "sim/base/failure.h"
#include "sim/base/rng.h"

namespace seldinger::measure {
namespace {

struct Segment {
  glm::dvec3 from, direction;
};

class Embree {
 public:
  explicit Embree(const cases::Mesh& mesh) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto copy = [&](RTCBufferType type, RTCFormat format, const auto& items) {
      const std::size_t size = sizeof items[0];
      std::memcpy(rtcSetNewGeometryBuffer(geometry, type, 0, format, size, items.size()), items.data(),
                  size * items.size());
    };
    copy(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices_lps_mm);
    copy(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw base::Failure("embree", "the scene was refused");
  }
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  bool hits(const Segment& segment, float length_mm) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(segment.from.x);
    ray.ray.org_y = static_cast<float>(segment.from.y);
    ray.ray.org_z = static_cast<float>(segment.from.z);
    ray.ray.dir_x = static_cast<float>(segment.direction.x);
    ray.ray.dir_y = static_cast<float>(segment.direction.y);
    ray.ray.dir_z = static_cast<float>(segment.direction.z);
    ray.ray.tfar = length_mm;
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

BenchRow row_of(const std::string& method, const std::string& setting, const std::string& size) {
  return {"haptics", method, setting, "cpu", "1 thread", size, 0, 0, 0, 0, "", "", ""};
}

void per(BenchRow& row, double count) {
  row.ms_median /= count;
  row.ms_min /= count;
  row.ms_max /= count;
}

std::string million_a_second(const BenchRow& row) {
  return bench_number(1e-3 / row.ms_median) + " M/s, at best " + bench_number(1e-3 / row.ms_min);
}

// Segments in all directions whose middles lie within 1 mm of the mean surface.
std::vector<Segment> segments(double length_mm, int n) {
  base::Rng rng(1);
  const auto direction = [&] { return glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal())); };
  std::vector<Segment> made;
  for (int i = 0; i < n; ++i) {
    const glm::dvec3 along = direction();
    const glm::dvec3 middle = direction() * (kBumpySphereMm + 2.0 * rng.uniform() - 1.0);
    made.push_back({middle - along * (0.5 * length_mm), along});
  }
  return made;
}

void measure_queries(const cases::Mesh& mesh, bool quick, std::vector<BenchRow>& rows) {
  const std::string size = std::to_string(mesh.triangles.size()) + " triangles";
  const int times = quick ? 3 : 11;
  cases::MeshIndex index;
  BenchRow build = row_of("mesh index, build", "tree and normals", size);
  time_into(build, times, [&] { index = cases::MeshIndex(mesh); });
  rows.push_back(build);
  build = row_of("Embree, build", "robust, 1 thread", size);
  time_into(build, times, [&] { const Embree embree(mesh); });
  rows.push_back(build);
  const Embree embree(mesh);
  for (const double length_mm : {1.0, 100.0}) {
    const int n = quick ? 50000 : 200000;
    const std::vector<Segment> tried = segments(length_mm, n);
    std::vector<char> ours(tried.size()), theirs(tried.size());
    BenchRow row = row_of("mesh index, segment", "", size), peer = row_of("Embree, segment", "", size);
    time_into(row, times, [&] {
      for (std::size_t i = 0; i < tried.size(); ++i)
        ours[i] = index.first_hit(tried[i].from, tried[i].direction, length_mm).has_value() ? 1 : 0;
    });
    time_into(peer, times, [&] {
      for (std::size_t i = 0; i < tried.size(); ++i)
        theirs[i] = embree.hits(tried[i], static_cast<float>(length_mm)) ? 1 : 0;
    });
    int differ = 0;
    for (std::size_t i = 0; i < tried.size(); ++i) differ += ours[i] != theirs[i] ? 1 : 0;
    for (BenchRow* one : {&row, &peer}) {
      per(*one, n);
      one->setting = bench_number(length_mm) + " mm, " + million_a_second(*one) + ", " + std::to_string(differ) +
                     " answers differ";
      rows.push_back(*one);
    }
  }
}

// A tick's own time is the least of five replays: the rest is the machine's.
void measure_glide(const cases::MeshIndex& index, const std::string& size, double radius_mm, double friction,
                   bool quick, std::vector<BenchRow>& rows) {
  const haptics::SurfaceProxy proxy(
      {.radius_mm = radius_mm, .static_friction = friction, .dynamic_friction = friction});
  const auto path = gliding_tool(proxy.radius_mm(), quick ? 5000 : 50000, 1);
  std::vector<double> least_ms(path.size(), std::numeric_limits<double>::infinity());
  for (int replay = 0; replay < 5; ++replay) {
    haptics::SurfaceTrack track;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      proxy.advance(index, path[i], track);
      const auto end = std::chrono::steady_clock::now();
      least_ms[i] = std::min(least_ms[i], std::chrono::duration<double, std::milli>(end - start).count());
    }
  }
  std::sort(least_ms.begin(), least_ms.end());
  BenchRow row = row_of("surface proxy, tick", "", size);
  row.n = static_cast<int>(path.size());
  row.ms_median = least_ms[path.size() / 2];
  row.ms_min = least_ms.front();
  row.ms_max = least_ms.back();
  row.setting = "radius " + bench_number(radius_mm) + " mm, friction " + bench_number(friction) + ", p99.9 " +
                bench_number(1e3 * least_ms[path.size() * 999 / 1000]) + " us of the least of 5 replays";
  rows.push_back(row);
}

void measure_slide(double noise_hu, bool quick, std::vector<BenchRow>& rows) {
  const SolidInCt solid{.noise_hu = noise_hu};
  const volume::Volume ct = ct_of(solid, 1);
  const int ticks = quick ? 2000 : 20000;
  BenchRow row = row_of("volume proxy, tick", "", bench_size(ct));
  Slide result;
  time_into(row, quick ? 3 : 11, [&] { result = slide(solid, ct, {}, ticks, 1); });
  per(row, ticks);
  row.setting = bench_number(noise_hu) + " HU of noise, at most " + bench_number(result.most_step_n) + " N/ms";
  row.error = bench_number(result.direction_rms_deg);
  row.error_unit = "degrees rms";
  row.reference = "the ball's own normal";
  rows.push_back(row);
}

}  // namespace

void bench_touch(bool quick, std::vector<BenchRow>& rows) {
  const cases::Mesh mesh = bumpy_sphere(448, 224);
  measure_queries(mesh, quick, rows);
  const cases::MeshIndex index(mesh);
  const std::string size = std::to_string(mesh.triangles.size()) + " triangles";
  for (const double radius_mm : {0.0, 1.0})
    for (const double friction : {0.0, 0.3}) measure_glide(index, size, radius_mm, friction, quick, rows);
  for (const double noise_hu : {0.0, 10.0, 30.0}) measure_slide(noise_hu, quick, rows);
}

}  // namespace seldinger::measure
