// From sums to the envelope: loss, pulse on the complex baseband, echoes. Each invocation makes
// some samples of a beam, one after the other, and takes each fine sample for all of them at once.
// ultrasound_pulse.comp and ultrasound_pulse_shifted.comp differ in where fine samples come from: from the sums, or
// from where sound of another speed shows them (ULTRASOUND_SHIFTED).
#include "shared/ultrasound_line.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Parameters { UsPulseParameters parameters; };
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };
#ifdef ULTRASOUND_SHIFTED
layout(std430, binding = 3) readonly buffer Laid { vec2 laid[]; };
#else
layout(std430, binding = 3) readonly buffer Through { float through[]; };  // a sample; what sums are counted in with it
layout(std430, binding = 4) readonly buffer Sums { ivec2 sums[]; };
#endif
layout(std430, binding = 5) readonly buffer EchoCounts { int echo_counts[]; };  // a beam
layout(std430, binding = 6) readonly buffer Echoes { vec4 echoes[]; };          // depth in mm, amplitude (complex), us_parting_per_mm
layout(std430, binding = 7) writeonly buffer Envelope { float envelope[]; };

void main() {
  int beam = int(gl_WorkGroupID.y);
  int first = int(gl_GlobalInvocationID.x) * kUsOutputs;
  int beam_sample = beam * parameters.samples;
  int fine_samples = parameters.samples * parameters.fine;
  vec2 value[kUsOutputs];
  for (int j = 0; j < kUsOutputs; ++j) value[j] = vec2(0.0);

  int padding = (kUsOutputs - 1) * parameters.fine;
  int fines = first < parameters.samples ? parameters.taps + padding : 0;
  int n = first * parameters.fine + parameters.first_tap;
  for (int m = 0; m < fines; ++m, ++n) {
    int at = clamp(n, 0, fine_samples - 1);
#ifdef ULTRASOUND_SHIFTED
    vec2 one = laid[beam * fine_samples + at];
#else
    vec2 one = vec2(sums[beam * fine_samples + at]) * through[beam_sample + at / parameters.fine];
#endif
    one = n == at ? one : vec2(0.0);
    for (int j = 0; j < kUsOutputs; ++j) value[j] += weights[padding + m - j * parameters.fine] * one;
  }

  float per_sigma = 1.0 / parameters.sigma_mm;
  float first_mm = (float(first) + 0.5) * parameters.sample_mm;
  float half_mm = 0.5 * float(kUsOutputs - 1) * parameters.sample_mm;
  int echo_count = echo_counts[beam];
  float left[kUsOutputs];
  for (int j = 0; j < kUsOutputs; ++j) left[j] = 1.0;
  for (int e = 0; e < echo_count; ++e) {
    vec4 echo = echoes[beam * parameters.most_echoes + e];
    // A loop, because llvmpipe leaves out no `if`.
    int times = abs(echo.x - first_mm - half_mm) <= half_mm + 4.0 * parameters.sigma_mm ? 1 : 0;
    for (; times > 0; --times)
      for (int j = 0; j < kUsOutputs; ++j) {
        float off = (first_mm + float(j) * parameters.sample_mm - echo.x) * per_sigma;
        value[j] += (abs(off) <= 4.0 ? exp(-0.5 * off * off) : 0.0) * echo.yz;
      }
    for (int edges = echo.w != 0.0 ? 1 : 0; edges > 0; --edges)
      for (int j = 0; j < kUsOutputs; ++j)
        left[j] *= us_behind_edge(echo.w, first_mm + float(j) * parameters.sample_mm - echo.x);
  }

  for (int j = 0; j < kUsOutputs; ++j) {
    float level = left[j] * sqrt(dot(value[j], value[j]));
    if (first + j < parameters.samples) envelope[beam_sample + first + j] = level;
  }
}
