// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RecordSplatter.h"

#include "Frame/BackgroundDepth.h"
#include "Frame/OpenGLFunctions.h"
#include "Frame/Uniforms.h"
#include "Records/RecordOctree.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPenumbraSplatFS.h"
#include "vtkPenumbraSplatLib.h"
#include "vtkPenumbraSplatMeanFS.h"
#include "vtkPenumbraSplatSurfaceFS.h"
#include "vtkPenumbraSplatVS.h"
#include "vtkShaderProgram.h"

namespace penumbra
{
namespace
{

/// Maximum height of the record texture; all OpenGL versions that VTK supports have textures of
/// this size.
constexpr std::size_t MaximumRows = 4096;

/// Texels of a record: position and radius, normal and plane distance, tangent and weight factor,
/// clearances (2 texels), mean; then the translation and rotation gradients of each channel.
constexpr int TexelsBeforeGradients = 6;

/// Weight factor of invalid records. They only matter at pixels that no valid record covers,
/// because this pass cannot trace rays.
constexpr float InvalidRecordWeight = 1e-3f;

void AppendTexels(std::vector<glm::vec4>& texels, const Record& record, int channels)
{
  const auto& clearance = record.Gathered.Clearance;
  texels.emplace_back(record.Position, record.Radius);
  texels.emplace_back(record.Normal, record.MaximumPlaneDistance);
  texels.emplace_back(record.Tangent, record.IsValid ? 1.f : InvalidRecordWeight);
  texels.emplace_back(clearance[0], clearance[1], clearance[2], clearance[3]);
  texels.emplace_back(clearance[4], clearance[5], clearance[6], clearance[7]);
  texels.emplace_back(record.Gathered.Mean, 0.f);
  for (int c = 0; c < channels; ++c)
  {
    texels.emplace_back(record.Gathered.Translation[c], 0.f);
    texels.emplace_back(record.Gathered.Rotation[c], 0.f);
  }
}

/// Returns the transform from record to eye coordinates, in double precision: both translations may be large.
glm::dmat4 ComputeRecordsToEye(const ScreenTransform& view, glm::dvec3 origin)
{
  glm::dmat4 toEye;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      toEye[column][row] = view.WorldToEye[4 * row + column];
    }
  }
  toEye[3] = toEye * glm::dvec4(origin, 1.0);
  return toEye;
}

/// Sets the transforms between record and eye coordinates.
void SetTransforms(vtkShaderProgram* program, const ScreenTransform& view, glm::dvec3 origin)
{
  const glm::dmat4 toEye = ComputeRecordsToEye(view, origin);
  const glm::dmat3 linear(toEye);
  glm::mat4 recordsToEye(toEye);
  glm::mat3 eyeToRecords(glm::inverse(linear));
  glm::mat3 normalToRecords(glm::transpose(linear));
  program->SetUniformMatrix4x4("recordsToEye", &recordsToEye[0][0]);
  program->SetUniformMatrix3x3("eyeToRecords", &eyeToRecords[0][0]);
  program->SetUniformMatrix3x3("normalToRecords", &normalToRecords[0][0]);
  program->SetUniformf("unitScale",
    static_cast<float>(
      std::max({ glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]) })));
}

/// Enables additive blending during its lifetime.
class ScopedAdditiveBlending
{
public:
  explicit ScopedAdditiveBlending(vtkOpenGLState* state)
    : Blend(state, GL_BLEND),
      Cull(state, GL_CULL_FACE),
      Function(state)
  {
    state->vtkglEnable(GL_BLEND);
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  }

private:
  const vtkOpenGLState::ScopedglEnableDisable Blend;
  const vtkOpenGLState::ScopedglEnableDisable Cull;
  const vtkOpenGLState::ScopedglBlendFuncSeparate Function;
};

}

RecordSplatter::RecordSplatter() = default;
RecordSplatter::~RecordSplatter() = default;

void RecordSplatter::SetRecords(std::vector<Record> records, glm::dvec3 origin, int channels)
{
  this->Records = std::move(records);
  this->Origin = origin;
  this->Channels = channels;
  this->RecordTexture = nullptr;
  this->Octree = nullptr;
}

void RecordSplatter::Upload(vtkOpenGLRenderWindow* window)
{
  const std::size_t count = this->Records.size();
  const std::size_t rows = std::min(count, MaximumRows);
  const std::size_t columns = (count + rows - 1) / rows;
  this->Rows = static_cast<int>(rows);
  this->Texels = TexelsBeforeGradients + 2 * this->Channels;
  const auto width = static_cast<std::size_t>(this->Texels) * columns;
  std::vector<glm::vec4> table(width * rows);
  std::vector<glm::vec4> texels;
  for (std::size_t i = 0; i < count; ++i)
  {
    texels.clear();
    AppendTexels(texels, this->Records[i], this->Channels);
    const std::size_t offset = i % rows * width + i / rows * texels.size();
    std::copy(texels.begin(), texels.end(), table.begin() + static_cast<std::ptrdiff_t>(offset));
  }
  this->RecordTexture = vtkSmartPointer<vtkTextureObject>::New();
  this->RecordTexture->SetContext(window);
  this->RecordTexture->Create2DFromRaw(
    static_cast<unsigned int>(width), static_cast<unsigned int>(rows), 4, VTK_FLOAT, table.data());
}

bool RecordSplatter::RenderSurface(
  vtkOpenGLRenderWindow* window, const DelegateImage& image, vtkTextureObject* eyeDepths)
{
  static const std::string source = AssembleView(vtkPenumbraSplatSurfaceFS);
  const ScreenTransform& view = image.GetView();
  Allocate(this->Surfaces, window, view.Width, view.Height, 4);
  vtkShaderProgram* program = this->Surface.Ready(window, source);
  const ScopedRenderTarget target(
    window, image.GetFramebuffer(), { this->Surfaces }, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  view.SetUniforms(program);
  this->Surface.BindTexture("eyeDepths", eyeDepths);
  this->Surface.Draw();
  return true;
}

bool RecordSplatter::AccumulateSplats(
  vtkOpenGLRenderWindow* window, const DelegateImage& image, float normalAngle)
{
  static const auto assemble = [](const char* source) {
    return Assemble(AssembleView(source), { { "SplatLib", vtkPenumbraSplatLib } });
  };
  static const std::string vertexSource = assemble(vtkPenumbraSplatVS);
  static const std::string fragmentSource = assemble(vtkPenumbraSplatFS);
  if (!this->RecordTexture || this->RecordTexture->GetContext() != window)
  {
    this->Upload(window);
    this->Vertices = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  }
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(vertexSource.c_str(), fragmentSource.c_str(), "");
  const ScreenTransform& view = image.GetView();
  std::vector<vtkTextureObject*> targets;
  for (int i = 0; i < 2 + this->Channels; ++i)
  {
    Allocate(this->SplatSums[i], window, view.Width, view.Height, 4);
    targets.push_back(this->SplatSums[i]);
  }
  const ScopedRenderTarget target(window, image.GetFramebuffer(), targets, image.GetDepth());
  if (!program || !target.IsComplete())
  {
    return false;
  }
  const ScopedAdditiveBlending blending(window->GetState());
  window->GetState()->vtkglClearColor(0.f, 0.f, 0.f, 0.f);
  window->GetState()->vtkglClear(GL_COLOR_BUFFER_BIT);
  view.SetUniforms(program);
  SetTransforms(program, view, this->Origin);
  this->RecordTexture->Activate();
  this->Surfaces->Activate();
  program->SetUniformi("records", this->RecordTexture->GetTextureUnit());
  program->SetUniformi("surfaces", this->Surfaces->GetTextureUnit());
  program->SetUniformi("rows", this->Rows);
  program->SetUniformi("texels", this->Texels);
  program->SetUniformi("channels", this->Channels);
  program->SetUniformf("normalFactor", RecordOctree::ComputeNormalFactor(normalAngle));
  this->Vertices->Bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(this->Records.size()));
  this->Vertices->Release();
  this->Surfaces->Deactivate();
  this->RecordTexture->Deactivate();
  return true;
}

bool RecordSplatter::Draw(vtkOpenGLRenderWindow* window, const DelegateImage& image,
  vtkTextureObject* eyeDepths, float normalAngle, vtkTextureObject* means)
{
  this->NormalAngle = normalAngle;
  this->InvalidPixels.reset();
  if (!this->RenderSurface(window, image, eyeDepths) ||
    !this->AccumulateSplats(window, image, normalAngle))
  {
    return false;
  }
  vtkShaderProgram* program = this->Mean.Ready(window, vtkPenumbraSplatMeanFS);
  const ScopedRenderTarget target(window, image.GetFramebuffer(), { means });
  if (!program || !target.IsComplete())
  {
    return false;
  }
  const ScreenTransform& view = image.GetView();
  SetPixelSize(program, "pixelSize", view.Width, view.Height);
  this->Mean.BindTexture("values", this->SplatSums[0]);
  this->Mean.BindTexture("offsets", this->SplatSums[1]);
  const bool single =
    this->Channels == 1; // the other gradients are then multiplied by unused channels
  this->Mean.BindTexture("gradients0", this->SplatSums[2]);
  this->Mean.BindTexture("gradients1", this->SplatSums[single ? 2 : 3]);
  this->Mean.BindTexture("gradients2", this->SplatSums[single ? 2 : 4]);
  this->Mean.Draw();
  return true;
}

void RecordSplatter::BuildOctree()
{
  float half = 0.f;
  for (const Record& record : this->Records)
  {
    const glm::vec3 size = glm::abs(record.Position);
    half = std::max({ half, size.x, size.y, size.z });
  }
  this->Octree = std::make_unique<RecordOctree>();
  this->Octree->Initialize(glm::vec3(0.f), half);
  for (const Record& record : this->Records)
  {
    this->Octree->Insert(record);
  }
}

std::size_t RecordSplatter::CountInvalidPixels(const ScreenTransform& view)
{
  if (this->InvalidPixels)
  {
    return *this->InvalidPixels;
  }
  if (!this->Octree)
  {
    this->BuildOctree();
  }
  this->Octree->SetNormalAngle(this->NormalAngle);
  const glm::dmat4 toEye = ComputeRecordsToEye(view, this->Origin);
  const glm::dmat4 toRecords = glm::inverse(toEye);
  const glm::mat3 normalToRecords(glm::transpose(glm::dmat3(toEye)));
  const std::vector<float> surfaces = ReadBack(this->Surfaces);
  std::size_t count = 0;
  for (std::size_t i = 0; i < surfaces.size() / 4; ++i)
  {
    const float* const surface = &surfaces[4 * i];
    const double depth = surface[3];
    const glm::vec3 normal(surface[0], surface[1], surface[2]);
    if (!(depth < BackgroundDepth) || normal == glm::vec3(0.f))
    {
      continue;
    }
    const glm::dvec2 pixel(
      static_cast<double>(i % view.Width) + .5, static_cast<double>(i / view.Width) + .5);
    const glm::dvec2 plane(view.Scale[0] * pixel.x + view.Offset[0] + view.Skew * pixel.y,
      view.Scale[1] * pixel.y + view.Offset[1]);
    const glm::dvec4 eye((view.Parallel ? 1.0 : depth) * plane, -depth, 1.0);
    ShadingPoint point;
    point.Position = toRecords * eye;
    point.Normal = glm::normalize(normalToRecords * normal);
    count += this->Octree->LookUp(point).IsInvalid ? 1 : 0;
  }
  this->InvalidPixels = count;
  return count;
}

void RecordSplatter::ReleaseGraphicsResources(vtkWindow* window)
{
  Release(window, this->Surfaces, this->RecordTexture, this->SplatSums[0], this->SplatSums[1],
    this->SplatSums[2], this->SplatSums[3], this->SplatSums[4]);
  if (this->Vertices)
  {
    this->Vertices->ReleaseGraphicsResources();
    this->Vertices = nullptr;
  }
  this->Surface.ReleaseGraphicsResources(window);
  this->Mean.ReleaseGraphicsResources(window);
}

}
