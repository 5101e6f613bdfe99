#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "xray/xray_walk.glsl"
