//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Covers the viewport at the far end of the depth range, so that with GL_GREATER only pixels with a
// surface are shaded.
in vec4 ndCoordIn;
in vec2 texCoordIn;

void main()
{
  // Both inputs are equivalent. Both are used because vtkOpenGLQuadHelper reports an error if the
  // compiler removes one.
  gl_Position = vec4(mix(ndCoordIn.xy, 2.0 * texCoordIn - 1.0, 0.5), 1.0, 1.0);
}
