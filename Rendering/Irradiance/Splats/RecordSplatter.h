// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Renders records as splats over the visible surface and averages them by their weights [IC,
// splatting].
#ifndef penumbra_RecordSplatter_h
#define penumbra_RecordSplatter_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"
#include "Records/Record.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

class vtkOpenGLVertexArrayObject;

namespace penumbra
{

class RecordOctree;

class RecordSplatter
{
public:
  RecordSplatter();
  ~RecordSplatter();

  /// Sets the records. Positions are relative to `origin` (world coordinates). `channels`: number
  /// of used channels of the mean, 1 or 3.
  void SetRecords(std::vector<Record> records, glm::dvec3 origin, int channels);
  std::size_t GetNumberOfRecords() const { return this->Records.size(); }

  /// Interpolates the records at the surface that `eyeDepths` defines. Fills `means` (four floats)
  /// with the mean over the hemisphere and, in the last channel, the sum of the weights. Records
  /// whose normals differ by `normalAngle` (radians) or more are ignored. Returns false if OpenGL
  /// reports an error.
  bool Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* eyeDepths,
    float normalAngle, vtkTextureObject* means);

  /// Returns the number of pixels of the last frame, seen by `view`, at which an invalid record has the
  /// largest weight: values of other records are wrong there. Counts them once per frame.
  std::size_t CountInvalidPixels(const ScreenTransform& view);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool RenderSurface(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* eyeDepths);
  void Upload(vtkOpenGLRenderWindow* window);
  void BuildOctree();
  bool AccumulateSplats(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, float normalAngle);

  std::vector<Record> Records;
  glm::dvec3 Origin{ 0.0 };
  int Channels = 1;
  float NormalAngle = 0.f;                  ///< of the last frame, radians
  std::unique_ptr<RecordOctree> Octree;     ///< of the records, for CountInvalidPixels(), or null
  std::optional<std::size_t> InvalidPixels; ///< of the last frame, if they have been counted
  int Rows = 1;
  int Texels = 1;
  Stage Surface;
  Stage Mean;
  vtkSmartPointer<vtkTextureObject> Surfaces;
  std::array<vtkSmartPointer<vtkTextureObject>, 5>
    SplatSums; ///< values, offsets, gradients per channel
  vtkSmartPointer<vtkTextureObject> RecordTexture;
  vtkSmartPointer<vtkOpenGLVertexArrayObject>
    Vertices; ///< empty, but OpenGL requires one to be bound
};

}
#endif
