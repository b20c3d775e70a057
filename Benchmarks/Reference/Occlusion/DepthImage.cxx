// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DepthImage.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace penumbra
{

namespace
{

constexpr const char* Source = "//VTK::System::Dec\n//VTK::Output::Dec\n"
                               "uniform sampler2D colors;\n"
                               "uniform sampler2D depths;\n"
                               "uniform vec2 pixelSize;\n"
                               "void main()\n"
                               "{\n"
                               "  vec2 at = gl_FragCoord.xy * pixelSize;\n"
                               "  gl_FragData[0] = texture(colors, at);\n"
                               "  gl_FragDepth = texture(depths, at).r;\n"
                               "}\n";

vtkTextureObject* Upload(vtkOpenGLRenderWindow* window, std::vector<float>& values, int components,
  vtkSmartPointer<vtkTextureObject>& texture)
{
  const int* size = window->GetSize();
  texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->Create2DFromRaw(size[0], size[1], components, VTK_FLOAT, values.data());
  return texture;
}

}

vtkStandardNewMacro(ShowDepthImagePass);

DepthImage CaptureDepthImage(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, bytes);
  vtkNew<vtkFloatArray> depths;
  window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depths);
  DepthImage image;
  for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); ++i)
  {
    image.Colors.push_back(static_cast<float>(bytes->GetValue(i)) / 255.f);
  }
  image.Depths.assign(depths->GetPointer(0), depths->GetPointer(0) + depths->GetNumberOfValues());
  return image;
}

void DepthComposite(DepthImage& whole, const DepthImage& part)
{
  for (std::size_t i = 0; i < part.Depths.size(); ++i)
  {
    if (part.Depths[i] < whole.Depths[i])
    {
      whole.Depths[i] = part.Depths[i];
      std::copy_n(&part.Colors[4 * i], 4, &whole.Colors[4 * i]);
    }
  }
}

void ShowDepthImagePass::Render(const vtkRenderState* state)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(state->GetRenderer()->GetRenderWindow());
  vtkShaderProgram* program = this->Draw.Ready(window, Source);
  if (!program)
  {
    vtkErrorMacro("The shader cannot be compiled.");
    return;
  }
  const int* size = window->GetSize();
  const float pixelSize[2] = { 1.f / static_cast<float>(size[0]),
    1.f / static_cast<float>(size[1]) };
  program->SetUniform2f("pixelSize", pixelSize);
  this->Draw.BindTexture("colors", Upload(window, this->Shown.Colors, 4, this->Colors));
  this->Draw.BindTexture("depths", Upload(window, this->Shown.Depths, 1, this->Depths));
  this->Draw.Draw();
  this->NumberOfRenderedProps = 1;
}

void ShowDepthImagePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Draw.ReleaseGraphicsResources(window);
  this->Colors = nullptr;
  this->Depths = nullptr;
}

}
