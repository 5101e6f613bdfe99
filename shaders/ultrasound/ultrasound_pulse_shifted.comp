#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define ULTRASOUND_SHIFTED
#include "ultrasound/ultrasound_pulse.glsl"
