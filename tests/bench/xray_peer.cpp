// What xray_vs_plastimatch.sh calls:
//   xray_peer volume FILE.mha              writes the projectors' phantom
//   xray_peer ours THREADS RUNS FOLDER     times our projectors on it; compares each picture with the peer's, found
//   as
//                                          FOLDER/<exact|uniform>_<G1|G2>_0000.pfm
// A line a picture: "<exact|slab> <threads> <geometry> <backend> <median ms> <largest> <mean>", the last two the
// difference from the peer's in nepers and relative where more than 0.05 nepers are absorbed; "-" where there is
// none.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "app/measure/rigs/projector_phantom.h"
#include "sim/base/failure.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::bench {
namespace {

using imaging::Basis;
using imaging::Instructions;
using imaging::PathLengths;
using imaging::ProjectionMethod;
using imaging::XrayGeometry;

constexpr double kPeerPerMm = 0.022;  // plastimatch: μ = 0.022·(1 + HU/1000) per mm above −800 HU,
constexpr double kPeerTimes = 10.0;   // and writes a tenth of its integral

// README.md: plastimatch drr -y 7 --sad 1000 --sid 1500.
XrayGeometry geometry(int number) {
  const double cos_7 = std::cos(7.0), sin_7 = std::sin(7.0);
  XrayGeometry g;
  g.source_lps_mm = glm::dvec3(1000.0 * cos_7, -1000.0 * sin_7, 0.0);
  g.detector_center_lps_mm = glm::dvec3(-500.0 * cos_7, 500.0 * sin_7, 0.0);
  g.u = {sin_7, cos_7, 0.0};
  g.v = {0.0, 0.0, -1.0};
  g.pixel_mm = number == 1 ? 600.0 / 512.0 : 400.0 / 624.0;
  g.width_px = number == 1 ? 512 : 624;
  g.height_px = number == 1 ? 512 : 420;
  return g;
}

int write_volume(const std::string& path) {
  const volume::Volume volume = measure::make_projector_phantom();
  const glm::dvec3 first_mm(volume.lps_from_voxel[3]);
  std::ofstream file(path, std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
          "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
       << "Offset = " << first_mm.x << ' ' << first_mm.y << ' ' << first_mm.z << '\n'
       << "ElementSpacing = " << volume.spacing_mm.x << ' ' << volume.spacing_mm.y << ' ' << volume.spacing_mm.z
       << '\n'
       << "DimSize = " << volume.size_voxels.x << ' ' << volume.size_voxels.y << ' ' << volume.size_voxels.z << '\n'
       << "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  file.write(reinterpret_cast<const char*>(volume.hu.data()),
             static_cast<std::streamsize>(volume.hu.size() * sizeof(std::int16_t)));
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "xray_peer: %s cannot be written\n", path.c_str());
  return 1;
}

// Line integrals in nepers as plastimatch writes them: little endian, first row first. Empty: no such picture.
std::vector<float> peers_picture(const std::string& path, const XrayGeometry& g) {
  std::ifstream file(path, std::ios::binary);
  std::string kind;
  int width = 0, height = 0;
  double scale = 0.0;
  if (!(file >> kind >> width >> height >> scale) || kind != "Pf" || width != g.width_px || height != g.height_px ||
      scale >= 0.0)
    return {};
  file.get();
  std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
  return file ? values : std::vector<float>();
}

std::string difference(const PathLengths& ours, const std::vector<float>& peers) {
  if (peers.size() != ours.water_mm.size()) return "- -";
  double largest = 0.0, sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const double p = kPeerTimes * peers[i], off = std::abs(kPeerPerMm * ours.water_mm[i] - p);
    if (!(off <= largest)) largest = off;  // NaN shows
    if (!(p > 0.05)) continue;
    sum += off / p;
    ++counted;
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.2e %.2e", largest, counted == 0 ? 0.0 : sum / static_cast<double>(counted));
  return text;
}

int time_ours(int threads, int runs, const std::string& folder) {
  const volume::Volume volume = measure::make_projector_phantom();
  const auto measure = [&](ProjectionMethod method, const std::string& backend, auto project) {
    const bool exact = method == ProjectionMethod::exact;
    for (const int number : {1, 2}) {
      const XrayGeometry g = geometry(number);
      const std::string name = number == 1 ? "G1" : "G2";
      PathLengths picture = project(g, method);  // warm: shaders compiled, layers uploaded
      std::vector<double> ms;
      for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        picture = project(g, method);
        ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      }
      std::sort(ms.begin(), ms.end());
      const std::string peer = folder + (exact ? "/exact_" : "/uniform_") + name + "_0000.pfm";
      std::printf("%s %d %s %s %.2f %s\n", exact ? "exact" : "slab", threads, name.c_str(), backend.c_str(),
                  ms[ms.size() / 2], difference(picture, peers_picture(peer, g)).c_str());
      std::fflush(stdout);
    }
  };
  const imaging::XrayCpu cpu(volume);
  constexpr std::array<std::pair<Instructions, const char*>, 3> kInstructions = {
      {{Instructions::scalar, "scalar"}, {Instructions::avx2, "avx2"}, {Instructions::avx512, "avx512"}}};
  for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab})
    for (const auto& [instructions, name] : kInstructions)
      if (instructions <= imaging::best_instructions())
        measure(method, name, [&](const XrayGeometry& g, ProjectionMethod wanted) {
          return cpu.project(g, wanted, {Basis::total, instructions, threads});
        });
  gpu::Context context;
  imaging::XrayGpu gpu(context, volume);
  const std::string renderer = context.software() ? "llvmpipe" : "gpu";
  for (const ProjectionMethod method : {ProjectionMethod::exact, ProjectionMethod::slab})
    measure(method, renderer,
            [&](const XrayGeometry& g, ProjectionMethod wanted) { return gpu.project(g, wanted, Basis::total); });
  return 0;
}

}  // namespace
}  // namespace seldinger::bench

int main(int count, char** words) {
  const std::vector<std::string> args(words + 1, words + count);
  try {
    if (args.size() == 2 && args[0] == "volume") return seldinger::bench::write_volume(args[1]);
    if (args.size() == 4 && args[0] == "ours")
      return seldinger::bench::time_ours(std::stoi(args[1]), std::stoi(args[2]), args[3]);
  } catch (const seldinger::base::Failure& failure) {
    std::fprintf(stderr, "xray_peer: %s: %s\n", failure.code().c_str(), failure.what());
    return 1;
  }
  std::fprintf(stderr, "xray_peer volume FILE.mha | ours THREADS RUNS FOLDER\n");
  return 2;
}
