// What hands, patient and table look like, shadows with soft edges.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#define ROOM_LOOKS 4
#include "shared/room.glsl.h"
#include "room/room_shade.glsl"
