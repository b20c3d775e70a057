// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Data sets and props of which the scenes of the feature table are made.
#ifndef FeatureProps_h
#define FeatureProps_h

#include "vtkSmartPointer.h"

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkProp;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextProperty;
class vtkTexture;

/// Updates a source and returns its output.
template <typename Source>
vtkSmartPointer<vtkPolyData> Make(Source* source)
{
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakeSphere(int resolution = 24);
vtkSmartPointer<vtkPolyData> MakeCube();
vtkSmartPointer<vtkPolyData> MakePlane(int resolution = 1);
vtkSmartPointer<vtkPolyData> MakePolyline();

/// Closed tube without duplicate points; one texture coordinate runs around it, from 0 to 11/12.
/// @param around Component of the texture coordinates that runs around the tube.
vtkSmartPointer<vtkPolyData> MakeTube(int around);
vtkSmartPointer<vtkPolyData> MakePointGrid();

/// Checkerboard of 8 x 8 fields with gradients of color.
vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int components = 3);

/// Adds an actor that shows `data`, in a warm color.
vtkActor* Add(vtkRenderer* renderer, vtkPolyData* data);

/// Turns the camera to an oblique view of everything.
void Look(vtkRenderer* renderer);

/// Adds point scalars that increase along the y axis.
void AddElevation(vtkPolyData* data);

vtkTexture* AddTexture(vtkActor* actor, vtkImageData* image);

/// Adds a rectangle whose texture coordinates reach from -1 to 2.
vtkActor* AddWrapped(vtkRenderer* renderer);

/// Adds a composite data set whose blocks differ in color, visibility and opacity.
void AddBlocks(vtkRenderer* renderer);

/// Adds a composite data set of which one block lacks the array of colors.
void AddBlockWithoutScalars(vtkRenderer* renderer);

/// Adds a composite data set with a textured block. Requires VTK 9.3.
void AddTexturedBlock(vtkRenderer* renderer);

/// Adds a plane with hidden and duplicate cells.
void AddGhosts(vtkRenderer* renderer);

/// Adds nine spheres of different metallic and roughness values.
/// @param texture Replaces every second sphere by a textured rectangle.
/// @param headlight If false, a directional and a positional light are added.
void AddPhysicallyBased(vtkRenderer* renderer, bool texture, bool headlight);

/// Adds image slices along the three axes, or one cropped slice with a lookup table.
void AddSlice(vtkRenderer* renderer, bool cropped);

/// Adds a second layer in the lower left corner of the window that shows `prop`.
void AddAxesLayer(vtkRenderWindow* window, vtkProp* prop);

/// Sets the size and color of text.
void StyleText(vtkTextProperty* property);

/// Sets a gradient background and adds a sphere.
void SetGradient(vtkRenderer* renderer);

#endif
