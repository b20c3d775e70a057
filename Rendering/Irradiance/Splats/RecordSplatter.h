// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Records drawn over a visible surface, each as far as it serves, and added up [IC, splatting].
#ifndef penumbra_RecordSplatter_h
#define penumbra_RecordSplatter_h

#include "Frame/DelegateImage.h"
#include "Frame/Stage.h"
#include "Records/Record.h"

#include <array>
#include <vector>

class vtkOpenGLVertexArrayObject;

namespace penumbra
{

class RecordSplatter
{
public:
  RecordSplatter();
  ~RecordSplatter();

  /// Positions are world coordinates less `origin`. `channels`: of the mean, the first 1 or 3 count.
  void SetRecords(std::vector<Record> records, glm::dvec3 origin, int channels);
  std::size_t GetNumberOfRecords() const { return this->Records.size(); }

  /// Fills `means` (four floats) with what the records say of the surface that the image shows from
  /// `eyeDepths`: means over the hemisphere, and in the last channel the records' weight. Records whose
  /// normals differ by `normalAngle` (radians) or more do not count. False when OpenGL refuses.
  bool Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* eyeDepths,
    float normalAngle, vtkTextureObject* means);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  bool FindSurface(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* eyeDepths);
  void Upload(vtkOpenGLRenderWindow* window);
  bool AccumulateSplats(
    vtkOpenGLRenderWindow* window, const DelegateImage& image, float normalAngle);

  std::vector<Record> Records;
  glm::dvec3 Origin{ 0.0 };
  int Channels = 1;
  int Rows = 1;
  int Texels = 1;
  Stage Surface;
  Stage Mean;
  vtkSmartPointer<vtkTextureObject> Surfaces;
  std::array<vtkSmartPointer<vtkTextureObject>, 5>
    SplatSums;                                          ///< values, ways, slopes of the channels
  vtkSmartPointer<vtkTextureObject> RecordTexture;      ///< the records
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Vertices; ///< none: OpenGL wants it nevertheless
};

}
#endif
