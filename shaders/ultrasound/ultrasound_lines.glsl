// The tissue along each beam, and what sound loses on the way: one work group for each beam, one invocation for each
// piece of it; dB are summed piece by piece, in order. Interfaces strong enough to be heard are listed for
// ultrasound_echoes.comp.
#include "shared/ultrasound_line.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

const int kPieces = 64;  // local_size_x
layout(local_size_x = 64) in;

layout(binding = 0) uniform usampler2DArray voxels;  // one layer a slice
layout(std140, binding = 0) uniform Parameters { UsLineParameters parameters; };
layout(std140, binding = 1) uniform Tissue { UsTissue tissue; };
layout(std430, binding = 2) readonly buffer Beams { UsBeam beams[]; };
layout(std430, binding = 3) writeonly buffer Through { float through[]; };
layout(std430, binding = 4) writeonly buffer Loss { float loss_db[]; };
layout(std430, binding = 5) writeonly buffer Shift { float shift_mm[]; };
// Sample, class before + 256 · class after, place of its first echo, loss down to it (bits of a float).
layout(std430, binding = 6) writeonly buffer Interfaces { ivec4 interfaces[]; };
layout(std430, binding = 7) writeonly buffer Counts { ivec2 counts[]; };  // a beam: interfaces, and their echoes
#include "ultrasound/ultrasound_tissue.glsl"
#ifdef ULTRASOUND_MOVED
layout(std140, binding = 3) uniform Motion { UsMotion motion; };
layout(std430, binding = 0) readonly buffer Paths { vec4 paths[]; };
#include "ultrasound/ultrasound_paths.glsl"
#endif

shared uint classes[16384 / 4];  // four samples a number
shared int gel_samples;
shared int listed_interfaces;
shared int listed_echoes;
shared float piece_loss_db[kPieces];
shared double piece_shift_mm[kPieces];
shared int piece_interfaces[kPieces];
shared int piece_echoes[kPieces];

uint class_of(int k) {
  return (classes[k >> 2] >> uint(8 * (k & 3))) & 255u;
}

uint class_at_sample(UsBeam at, double sample_number) {
  dvec3 index = dvec3(at.index.xyz) + dvec3(at.index_rest.xyz);
  dvec3 along = dvec3(at.index_along.xyz) + dvec3(at.index_along_rest.xyz);
  float depth_mm = float(sample_number) * parameters.sample_mm;
  vec3 from_origin_mm = at.start_mm.xyz + depth_mm * at.direction.xyz;
  index += sample_number * along;
#ifdef ULTRASOUND_MOVED
  vec3 back_mm = back_at(int(gl_WorkGroupID.x), depth_mm);
  index += dvec3(voxels_of(back_mm));
  from_origin_mm += back_mm;
#endif
  return class_at(ivec3(floor(index)), from_origin_mm);
}

// How far below the border between two samples the border between their tissues lies, in samples.
float late_samples(UsBeam at, int k, uint last) {
  float above = -0.5;
  float below = 0.5;
  for (int i = 0; i < kUsBorderHalvings; ++i) {
    float middle = 0.5 * (above + below);
    bool is_last = class_at_sample(at, double(k) + double(middle)) == last;
    above = is_last ? middle : above;
    below = is_last ? below : middle;
  }
  return 0.5 * (above + below);
}

// How many echoes an interface may have: gas repeats itself, and at the probe's face it rings in the lens.
int echoes_of(float reflection, int k) {
  if (abs(reflection) < kUsRepeatsFrom) return 1;
  return float(k) * parameters.sample_mm > parameters.most_shift_mm ? kUsMostAgain : 1 + kUsLensLines;
}

void main() {
  int beam = int(gl_WorkGroupID.x);
  int piece = int(gl_LocalInvocationID.x);
  UsBeam at = beams[beam];
  int samples = parameters.samples;
  int words = (samples + 3) / 4;
  int piece_words = (words + kPieces - 1) / kPieces;
  int first = piece * piece_words * 4;
  int end = min(samples, first + piece_words * 4);

  // Each piece looks up the tissue class of its samples, four to a word.
  for (int word = 0; word < piece_words; ++word) {
    uint four = 0u;
    for (int i = 0; i < 4; ++i) {
      uint found = class_at_sample(at, double(first + 4 * word + i) + 0.5lf);
      four |= (at.contact != 0 ? found : kUsAir) << uint(8 * i);
    }
    if (piece * piece_words + word < words) classes[piece * piece_words + word] = four;
  }
  barrier();
  if (piece == 0) {
    // The air at the face is gel, unless it is thicker than a blurred skin can be; a beam that clips a corner of air
    // goes on past it.
    int gel = 0;
    int last = min(samples - 1, int(kUsGelMm / parameters.sample_mm));
    for (int k = 0; k <= last; ++k) {
      uint found = class_of(k);
      gel = found == kUsAir || (k == gel && found == kUsGas) ? k + 1 : gel;
    }
    listed_interfaces = 0;
    listed_echoes = 0;
    gel_samples = gel == samples || float(gel) * parameters.sample_mm > kUsGelMm ? 0 : gel;
  }
  barrier();

  // Each piece walks its samples twice: the first round sums what the piece loses and counts its interfaces; the
  // second, starting from the sums of the pieces above it, writes what holds at each sample.
  float sum_db = 0.0;
  // In double, as on the CPU: in uniform tissue shifts end half way between samples, where rounding would put speckle
  // on either side.
  double sum_mm = 0.0lf;
  int interface_count = 0;
  int echo_count = 0;
  for (int round = 0; round < 2; ++round) {
    for (int k = first; k < end; ++k) {
      uint now = class_of(k);
      vec4 tissue_now = parameters.of_class[now];
      uint last = class_of(max(k - 1, 0));
      bool past_gel = k >= gel_samples;
      // The interface above the sample: impedance before and after it, and where between the samples it lies. Down to
      // there the loss is that of the tissue above.
      float before = k > gel_samples ? parameters.of_class[last].x
                                     : us_is_matched(tissue_now.x) ? tissue_now.x : kUsMatchedMrayl;
      float late_mm = k > gel_samples && now != last ? late_samples(at, k, last) * parameters.sample_mm : 0.0;
      sum_db += late_mm * parameters.of_class[last].y;
      float reflection = past_gel ? us_reflection(before, tissue_now.x) : 0.0;
      bool is_interface = reflection != 0.0 && (k == 0 || us_is_heard(reflection)) && at.contact != 0;
      // List it for ultrasound_echoes.comp, as long as there is room for its echoes and the needle's.
      int echo_end = echo_count + echoes_of(reflection, k);
      if (round == 1 && is_interface && interface_count < kUsMostInterfaces &&
          echo_end + kUsMostNeedleEchoes <= kUsMostEchoes) {
        int before_class = k > gel_samples ? int(last) : kUsGel;
        interfaces[beam * kUsMostInterfaces + interface_count] =
            ivec4(k, before_class + 256 * int(now), echo_count, floatBitsToInt(sum_db));
        atomicMax(listed_interfaces, interface_count + 1);
        atomicMax(listed_echoes, echo_end);
      }
      interface_count += is_interface ? 1 : 0;
      echo_count = is_interface ? echo_end : echo_count;
      // Losses at the interface, and at a needle that crosses the beam here.
      sum_db += us_step_loss_db(reflection) - late_mm * tissue_now.y;
      float middle_mm = (float(k) + 0.5) * parameters.sample_mm;
      bool needle_here = past_gel && at.needle_mm >= 0.0 && middle_mm >= at.needle_mm &&
                         !(k > gel_samples && middle_mm - parameters.sample_mm >= at.needle_mm);
      sum_db += needle_here ? at.needle_shadow_db : 0.0;
      // Losses within the sample, half of them above its middle: there stands what is written.
      float step_db = past_gel ? tissue_now.y * parameters.sample_mm : 0.0;
      double step_mm = past_gel ? double(tissue_now.z) + double(tissue_now.w) : 0.0lf;
      if (round == 1) {
        float db = min(kUsDeadDb, sum_db + 0.5 * step_db);
        loss_db[beam * samples + k] = db;
        through[beam * samples + k] = at.contact != 0 ? us_amplitude(-db) * parameters.per_unit : 0.0;
        if (parameters.shifts != 0) shift_mm[beam * samples + k] = at.contact != 0 ? float(sum_mm + 0.5lf * step_mm) : 0.0;
      }
      sum_db += step_db;
      sum_mm += step_mm;
    }
    // Between the rounds the first invocation turns the pieces' sums into the sums of all pieces above each.
    if (round == 0) {
      piece_loss_db[piece] = sum_db;
      piece_shift_mm[piece] = sum_mm;
      piece_interfaces[piece] = interface_count;
      piece_echoes[piece] = echo_count;
    }
    barrier();
    if (round == 0 && piece == 0) {
      sum_db = 0.0;
      sum_mm = 0.0lf;
      interface_count = 0;
      echo_count = 0;
      for (int i = 0; i < kPieces; ++i) {
        float db = piece_loss_db[i];
        double mm = piece_shift_mm[i];
        int its_interfaces = piece_interfaces[i];
        int its_echoes = piece_echoes[i];
        piece_loss_db[i] = sum_db;
        piece_shift_mm[i] = sum_mm;
        piece_interfaces[i] = interface_count;
        piece_echoes[i] = echo_count;
        sum_db += db;
        sum_mm += mm;
        interface_count += its_interfaces;
        echo_count += its_echoes;
      }
    }
    barrier();
    if (round == 0) {
      sum_db = piece_loss_db[piece];
      sum_mm = piece_shift_mm[piece];
      interface_count = piece_interfaces[piece];
      echo_count = piece_echoes[piece];
    }
  }
  if (piece == 0) counts[beam] = ivec2(listed_interfaces, listed_echoes);
}
