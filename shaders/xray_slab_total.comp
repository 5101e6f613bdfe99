#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define XRAY_SLAB
#define XRAY_TOTAL
#include "shared/xray_walk.glsl.h"
