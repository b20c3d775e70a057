// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Uniforms of a full-screen stage as flat inputs of its fragment shader. Mesa's software renderer
// fetches each component of a uniform once per pixel, with a test of its bounds, but a flat input once
// for all pixels that it executes together: Benchmarks/notes/ambient-occlusion.md.
#ifndef penumbra_FlatUniforms_h
#define penumbra_FlatUniforms_h

#include <string>

namespace penumbra
{

/// Moves uniforms of type float, vec2, vec3, vec4 and mat4 from a fragment shader to the vertex shader,
/// which passes them on without interpolation. Their names and values stay the same. Uniforms that no
/// longer fit into the inputs that every driver has, and unused ones, are not moved; nor are integers,
/// which made no shader measurably faster. Both shaders begin with the line //VTK::System::Dec.
void PassUniformsFlat(std::string& vertexShader, std::string& fragmentShader);

}
#endif
