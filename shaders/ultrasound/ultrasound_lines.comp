#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "ultrasound/ultrasound_lines.glsl"
