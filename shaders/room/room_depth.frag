// Depth alone.
#version 430 core

void main() {}
