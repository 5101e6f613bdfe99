#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define XRAY_TOTAL
#include "xray/xray_walk.glsl"
