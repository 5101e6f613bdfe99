#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define XRAY_SLAB
#include "xray/xray_walk.glsl"
