// What the passes of ultrasound on the GPU are told: uniform blocks (std140) and the tiles of scatterers (std430,
// the same offsets, as it holds nothing but vec4 and fours of numbers).
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND_PASSES
#define SELDINGER_SHADERS_SHARED_ULTRASOUND_PASSES

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT int kUsMaxLesions = 16;
SHARED_CONSTANT int kUsPhases = 1024;

// Tissue as speckle sees it. Positions are from the view's origin, so that float keeps its digits.
struct UsTissue {
  vec4 amplitude[16];                    // x: of each class
  vec4 lesion_sphere_mm[kUsMaxLesions];  // xyz: centre; w: radius
  vec4 lesion_amplitude[kUsMaxLesions];  // x; y: class; z: log_sd, w: grains_per_mm of its texture
  vec4 lesion_rim[kUsMaxLesions];        // x, y: of its rim; z: radius at which that begins; w: the texture's key
  vec4 lesion_margin[kUsMaxLesions];     // x: amplitude of what lies about it; y: 1/mm, 0: sharp
  int lesion_count;
  int size_x;  // of the volume, voxels
  int size_y;
  int size_z;
  int no_offset;        // the voxel's level at which the class's amplitude stands; the log of what a step more
  float log_of_a_step;  // makes of it
  int strays;           // scatterers are of voxels about them (us_stray); 0: of the one that they lie in
  int padding_1;
};

struct UsScatterParameters {
  int beams;
  int fine_samples;  // of a beam
  int fine;          // in a sample
  int curved;
  float radius_mm;
  float beam_step;  // radians, or mm of a straight face
  float sample_mm;
  float fine_per_mm;
  float phases_per_mm;  // entries of the table of phases
  float unit;           // what sums are counted in: 1/unit
  float wavelength_mm;  // and the probe
  float f_number;
  float aperture_mm;
  float focus_mm;
  float height_mm;
  float elevation_focus_mm;
};

// What the walk along beams is told.
SHARED_CONSTANT int kUsMostInterfaces = 512;  // of a beam; deeper ones are left out
SHARED_CONSTANT int kUsMostEchoes = 768;
SHARED_CONSTANT int kUsMostNeedleEchoes = 10;
SHARED_CONSTANT uint kUsAir = 0u, kUsGas = 1u, kUsFluid = 4u,
                     kUsVessel = 12u;  // classes of tissue; before the first:
SHARED_CONSTANT int kUsGel = 255;
// By what round bodies are told: the plane where the beam leaves them, or how wide they are about its way through
// them.
SHARED_CONSTANT int kUsEdgesByOneSide = 1, kUsEdgesByWidth = 2;
struct UsLineParameters {
  vec4
      of_class[16];  // x: impedance in MRayl; y: loss in dB a mm; z, w: their sum is how much deeper a sample shows
  vec4 mm_per_voxel[3];  // xyz: of the volume's axes
  int beams;
  int samples;
  int around;          // neighbours that tell the normal,
  int close;           // and those, after them, that tell the place
  float close_weight;  // of all of those together
  float most_shift_mm;
  float sample_mm;
  float depth_mm;
  float turns_per_mm;   // of the carrier, on the way there and back
  float per_unit;       // what sums are counted in
  float least_side_mm;  // of the sum that tells a normal
  int shifts;
  int edges;  // of round bodies, cast shadows (0: none, or kUsEdges…); and the beam that they meet:
  float wavelength_mm;
  float f_number;
  float aperture_mm;
  float focus_mm;
  float elevation_x;  // unit, out of the plane
  float elevation_y;
  float elevation_z;
};

// A beam.
struct UsBeam {
  vec4 index;        // xyz: index + ½ of where it starts, the sum of two floats
  vec4 index_rest;   // xyz
  vec4 index_along;  // xyz: a sample, likewise
  vec4 index_along_rest;
  vec4 start_mm;    // xyz: from the view's origin
  vec4 direction;   // xyz
  float needle_mm;  // where the needle stands before it; < 0: nowhere
  float needle_shadow_db;
  int needle_echoes;
  int contact;
  vec4 needle_echo[kUsMostNeedleEchoes];  // depth, amplitude without loss, depth down to which loss counts
};

// A tile of scatterers: a band of depth, a few beams wide. Its frame: x across, y elevation, z along its middle
// beam.
struct UsTile {
  vec4 corner_mm;    // xyz: of the first row's cube 0; w: half thickness
  vec4 from_box_mm;  // xyz: that cube's centre from the box's centre; w: where the band begins
  vec4 half_box_mm;  // xyz; w: where the band ends
  vec4 edge_x_mm;    // xyz: of a cube, along the lattice's x; w: the middle beam
  vec4 edge_y_mm;    // xyz; w: scatterers from this beam on are the tile's
  vec4 edge_z_mm;    // xyz; w: to before this one
  vec4 outer_mm;     // xyz: to the next row, outer axis; w: the cube's side
  vec4 middle_mm;    // xyz
  vec4 inner_mm;     // xyz: to the next cube of a row
  vec4 index;        // xyz: index + ½ of the frame's origin
  vec4 index_x;      // xyz: per mm of x
  vec4 index_y;      // xyz
  vec4 index_z;      // xyz
  vec4 origin_mm;    // xyz: the frame's origin from the view's
  vec4 axis_x;       // xyz
  vec4 axis_y;       // xyz
  vec4 axis_z;       // xyz
  uint seed;         // of the first row's cube 0
  uint step_outer;   // to the next row's
  uint step_middle;
  uint step_inner;
  int rows_outer;
  int rows_middle;
  int first_fine;  // fine samples that are the band's
  int end_fine;
  vec4 column;  // of tissue that moves: the first row's place among the slab's columns, x and y; zw: to the next
                // row, outer (along x) and middle (along y)
};

// Of tissue that moves: the slab's nodes (sim/tissue/moved_slab.h), and the beams' paths (motion.h), three vec4 a
// node: X − x; and how X goes on across the beam and out of the plane, a mm.
struct UsMotion {
  vec4 index_x;  // xyz: voxels per mm along LPS' x
  vec4 index_y;
  vec4 index_z;
  int columns;  // of the slab, along x
  int rows;     // and along y
  int layers;
  float low_mm;  // height of the first layer
  float layers_per_mm;
  float nodes_per_mm;  // of a path
  int path_nodes;
  int first_path;  // where the paths begin in their list
};

SHARED_CONSTANT int kUsLinesPerBeam = 2;
struct UsLatticeParameters {
  vec4 lateral;        // xyz
  vec4 axial;          // xyz
  vec4 index;          // xyz: index + ½ of the view's origin
  vec4 index_lateral;  // xyz: per mm
  vec4 index_axial;    // xyz
  int beams;
  int samples;
  int lines;
  int lines_before;  // that lie before beam 0
  int curved;
  float radius_mm;
  float first_beam;  // of beam 0, and
  float beam_step;   // between beams: radians, or mm for a straight face
  float sample_mm;
  float unit;  // what sums are counted in: 1/unit
  int padding_1;
  int padding_2;
};

// The lattice at one sample.
struct UsLatticeDepth {
  vec4 part;   // xyz: where in its cell the view's origin lies; w: cells in a mm
  int cell_x;  // that cell
  int cell_y;
  int cell_z;
  uint key;
  float gain;
  float lateral_scale;  // of (lines off)²: −log of the weight
  int lateral_reach;    // lines
  int padding;
};

struct UsPulseParameters {
  int beams;
  int samples;
  int fine;         // fine samples in a sample
  int first_tap;    // fine sample k·fine + first_tap is the first that counts for sample k
  int taps;         // weights are padded with zeros, (kUsOutputs − 1)·fine on either side
  int most_echoes;  // room for a beam's
  float sample_mm;
  float sigma_mm;  // of the pulse
  float fine_per_mm;
  float phases_per_mm;
  int padding_1;
  int padding_2;
};
SHARED_CONSTANT int kUsOutputs = 8;  // samples that one invocation makes

// The mirror that a beam meets: a point of it and its normal (us_mirrored); and beside those how deep the beam
// meets it, mm, and the share that comes of it. A beam that meets none: deeper than the picture.
struct UsMirror {
  vec4 plane;
  vec4 met;  // x: depth; y: share
};

struct UsMirrorParameters {
  int beams;
  int samples;
  int curved;
  float radius_mm;
  float first_beam;  // of beam 0, and
  float beam_step;   // between beams: radians, or mm for a straight face
  float sample_mm;
  float loss_db_mm;
};

SHARED_END

#endif
