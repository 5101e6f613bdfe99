// Ultrasound: what a probe on the skin shows of the CT. Everything up to the envelope is polar, one line of samples
// a beam; every stage is a function of its beam alone, so threads share the beams and the picture has the same bits
// for any number of them.
//
// Order: tissue along the beam → two-way loss (a prefix sum in dB) → scatterers on a lattice in tissue coordinates
// under a beam whose width depends on depth → echoes of interfaces and needle → pulse on the complex baseband →
// envelope; lung as a mirror, which alone looks across beams (mirror.h); then noise, gain, logarithm against a
// fixed reference, scan conversion, grey. Refraction: only how it darkens what lies behind the edges of round
// bodies. Of one look; what several of them make is told in compound.h.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "sim/imaging/inserted.h"
#include "sim/imaging/probe.h"
#include "sim/imaging/ultrasound/view/tissue.h"
#include "sim/tissue/displacement.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

// How speckle comes about. scatterers: convolved with the beam, the picture that is practised with. lattice:
// complex noise, fast, its resolution is the lattice's. thesis: what Vidal 2008 §4.6 did, to be compared with:
// windowed HU times noise, shadows by thresholds, edges by Sobel; no attenuation, no needle's angle.
enum class UltrasoundMethod { scatterers, lattice, thesis };

struct UltrasoundView {
  UltrasoundMethod method = UltrasoundMethod::scatterers;
  Probe probe = kC52v;
  glm::dvec3 origin_lps_mm{0.0};                  // centre of the transducer's face
  glm::dvec3 axial{0.0, 1.0, 0.0};                // unit, into the body
  glm::dvec3 lateral{1.0, 0.0, 0.0};              // unit, towards the last beam
  double depth_mm = 150.0;                        // > 0
  double frequency_mhz = 0.0;                     // 0: the probe's
  double focus_mm = 0.0;                          // of the transmitted beam; 0: in focus at every depth
  int beams = 128, samples = 1024;                // ≥ 1
  std::uint64_t seed = 1;                         // of the tissue's scatterers
  double scatterers_per_cell = 8.0;               // in the volume of one PSF: quality against time
  std::optional<double> attenuation_db_cm_mhz{};  // of every soft class
  bool echogenic_needle = false;
  double compound_deg = 0.0;  // of the looks that are averaged with this one (compound.h); 0: none
  cases::SightLaw sight_law = cases::kNewestSightLaw;  // of the tip, and of what the picture is said to show
  bool range_error = false;  // tissue shows deeper or shallower than it lies, by the speed of sound above it
  int threads = 0;           // 0: as many as cores
};

// The tissue a picture is taken of. Both outlive the picture-taker.
struct TissueVolume {
  const volume::Volume* volume = nullptr;
  std::span<const volume::TissueClass> classes;     // of every voxel, in the volume's order
  std::span<const std::uint8_t> echogenicity = {};  // as echogenicity.h makes it; empty: classes alone
};

// Envelope, linear: 1 is the root mean square of the speckle of liver at the face, at every depth without loss.
// Sample k of beam b, at (k + ½)·depth/samples from the face, is envelope[b·samples + k].
struct PolarPicture {
  int beams = 0, samples = 0;
  std::vector<float> envelope;
};

// depth_below_skin_mm: one signed depth an element; an element below −kContactMm stands in air. Empty: all touch.
constexpr double kContactMm = 1.0;

// `inserted`: lesions take the tissue of their HU; the needle scatters nothing, casts a weak shadow and sends its
// own echo. NaN or infinite poses: no needle. CHECKs the view. `picture`'s buffers are used again.
// `displacement`: of a patient who moves; tissue, its speckle and lesions are where it puts them, needle and probe
// where they are. Without sources no code of it runs.
void ultrasound_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                      std::span<const float> depth_below_skin_mm, PolarPicture& picture,
                      const tissue::Displacement& displacement = {});

// A scene's polar_db: row-major, a row a depth, a column a beam; 20·log10, not below kLeastDb.
constexpr float kLeastDb = -200.0F;
float level_db_of(float amplitude) noexcept;
std::vector<float> polar_db(const PolarPicture& picture);

// The receiver's own noise, on complex samples: what ends penetration. 120 dB of receiver below a mirror 61 dB
// above liver (line.h): liver of 0.5 dB/cm/MHz drowns at 17 cm at 3.6 MHz and at 8 cm at 7.6. For the screen only;
// a frozen picture keeps its `frame`. Same seed, frame and picture: same bits.
constexpr double kReceiverNoiseDb = -60.0;
void add_receiver_noise(std::uint64_t seed, std::uint64_t frame, PolarPicture& picture);

// Clutter: what comes back from the wall of the body more than once, and by side lobes, lies over cysts, vessels
// and shadows. Relative to liver at that depth, in a body of average wall. In vivo it is 30 to 0 dB below a
// bladder's wall (Lediju, Pihl, Dahl and Trahey, Ultrason. Imaging 30 (2008) 151), most of it right behind the
// body's wall (Dahl and Sheean, Ultrasound Med. Biol. 40 (2014) 714); where in that range, and how it falls, is our
// judgement.
constexpr double kClutterBelowDb = 20.0, kClutterFallDbMm = 0.2;
// In cases of a law that nothing was published by before there was any (docs/decisions/0090).
inline bool shows_clutter(const UltrasoundView& view) {
  return view.sight_law >= cases::SightLaw::clutter && view.method != UltrasoundMethod::thesis;
}
// Its mean square as it arrives; liver's speckle at the face is 0.
double clutter_db(const UltrasoundView& view, double depth_mm) noexcept;
// Lies still in the picture whatever moves behind it: by the view's seed, so whoever makes many pictures keeps it.
// Beams that stand in air have none.
class Clutter {
 public:
  void add(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, PolarPicture& picture);

 private:
  struct Of {  // what it is made for
    std::uint64_t seed = 0;
    int beams = 0, samples = 0;
    double depth_mm = 0.0, mhz = 0.0;
    bool operator==(const Of&) const = default;
  };
  Of of_;
  std::vector<float> re_, im_;
};
void add_clutter(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, PolarPicture& picture);

// Borders of what the CT tells by voxels without their stairs, in cases of the same law (docs/decisions/0097). What
// is told of a picture asks the voxel alone.
inline bool blends_voxels(const UltrasoundView& view) {
  return view.sight_law >= cases::SightLaw::clutter;
}

// From a share of the dynamic range to a share of white: as it is, dark parts lifted, or middle greys spread.
enum class GreyMap { linear, lifted, contrast };

// How the console is set.
struct UltrasoundKnobs {
  double gain_db = 0.0;
  double dynamic_range_db = 60.0;  // > 0
  std::array<double, 8> tgc_db{};  // from the face to the depth
  GreyMap grey_map = GreyMap::linear;
  bool flip = false;  // left for right
};

// Of each grey of the linear map.
std::array<unsigned char, 256> grey_table(GreyMap map) noexcept;

// White is this much above the liver's speckle, so that liver is a middle grey.
constexpr double kWhiteDb = 25.0;
// What the scanner itself adds for depth, as if all were liver: with all sliders at 0 liver is even.
constexpr double kAssumedAttenuationDbCmMhz = 0.5;

// What gain, sliders and scanner add at a depth, dB.
double display_gain_db(const UltrasoundView& view, const UltrasoundKnobs& knobs, double depth_mm) noexcept;

struct DisplaySize {
  int width_px = 800, height_px = 700;
  double pixel_mm = 0.0;  // 0: the smallest at which the whole field fits
};

// top_mm ≤ 0: the sides of a curved face lie above its centre.
struct Screen {
  double pixel_mm, top_mm;
};
Screen screen_of(const UltrasoundView& view, DisplaySize size) noexcept;

// Where polar coordinates lie. `beam` is continuous, 0 the first's axis.
glm::dvec3 point_of(const UltrasoundView& view, double beam, double depth_mm) noexcept;
// x across and z below the face's centre, in the picture's plane → beam and depth.
struct BeamAndDepth {
  double beam, depth_mm;
};
BeamAndDepth beam_and_depth(const UltrasoundView& view, double x_mm, double z_mm) noexcept;

// From polar to the screen. Pixel (c, r) shows the point x = (c − (width − 1)/2)·pixel across (flipped: −x) and
// z = top + (r + ½)·pixel below the face's centre. Built once for a probe, depth and size.
class ScanConverter {
 public:
  ScanConverter(const UltrasoundView& view, DisplaySize size);
  int width_px() const noexcept { return size_.width_px; }
  int height_px() const noexcept { return size_.height_px; }
  double pixel_mm() const noexcept { return screen_.pixel_mm; }
  double top_mm() const noexcept { return screen_.top_mm; }
  // Of a pixel that is never flipped; nothing outside the field. From the first beam's middle to the last's.
  std::optional<BeamAndDepth> place(int column, int row) const noexcept {
    const Source& source = sources_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.width_px) +
                                    static_cast<std::size_t>(column)];
    if (source.beam < 0) return std::nullopt;
    constexpr double kShare = 1.0 / 65536.0;
    return BeamAndDepth{source.beam + kShare * source.beam_65536,
                        (source.sample + kShare * source.sample_65536 + 0.5) * sample_mm_};
  }

  // Grey, 0 outside the field; the envelope is interpolated, then its logarithm taken. NaN shows as 255.
  void grey(const UltrasoundView& view, const UltrasoundKnobs& knobs, const PolarPicture& polar,
            std::vector<unsigned char>& grey) const;

  // As polar_db, in the place of grey, never flipped; −200 outside the field.
  std::vector<float> envelope_db(const PolarPicture& polar) const;

 private:
  struct Source {
    std::int16_t beam = -1, sample = 0;              // the ones before; a beam of −1: outside the field
    std::uint16_t beam_65536 = 0, sample_65536 = 0;  // of the way to the next
    float down() const noexcept { return static_cast<float>(sample_65536) * (1.0F / 65536.0F); }
    // The envelope between two beams and two samples.
    float level(const float* envelope, int samples) const noexcept {
      const float* near = envelope + static_cast<std::ptrdiff_t>(beam) * samples + sample;
      const float* far = near + samples;
      const float across = static_cast<float>(beam_65536) * (1.0F / 65536.0F);
      const float above = near[0] + across * (far[0] - near[0]), below = near[1] + across * (far[1] - near[1]);
      return above + down() * (below - above);
    }
  };
  DisplaySize size_;
  int beams_, samples_;
  double sample_mm_;
  Screen screen_;
  std::vector<Source> sources_;
};

}  // namespace seldinger::imaging
