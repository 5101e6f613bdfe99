#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define ULTRASOUND_MOVED
#include "ultrasound/ultrasound_scatter.glsl"
