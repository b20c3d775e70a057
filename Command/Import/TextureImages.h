// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of textures with more than 8 bits per channel, which vtkTexture maps through a lookup table.
#ifndef penumbra_TextureImages_h
#define penumbra_TextureImages_h

class vtkActor;
class vtkTexture;

namespace penumbra
{

/// Replaces an image of other numbers by one of 8 bits per channel. Full intensity is the largest integer of the
/// type, or 1.
void ConvertToBytes(vtkTexture* texture);

/// Converts all textures of an actor and its property.
void ConvertTexturesToBytes(vtkActor* actor);

}
#endif
