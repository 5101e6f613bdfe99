#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/ultrasound_echoes.glsl.h"
