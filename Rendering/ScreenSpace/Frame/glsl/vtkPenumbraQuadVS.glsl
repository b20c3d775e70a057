//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Covers the viewport at the far end of the depth range: under GL_GREATER only pixels that show a
// surface are shaded.
in vec4 ndCoordIn;
in vec2 texCoordIn;

void main()
{
  // Both inputs say the same; a compiler that dropped one would make vtkOpenGLQuadHelper complain.
  gl_Position = vec4(mix(ndCoordIn.xy, 2.0 * texCoordIn - 1.0, 0.5), 1.0, 1.0);
}
