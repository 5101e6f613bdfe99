// What hands, patient and table look like, for software GL.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define ROOM_LOOKS 1
#include "shared/room.glsl.h"
#include "room/room_shade.glsl"
