// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Sort-last parallel rendering: every rank draws its own actors, the nearest of all pictures wins, and
// only then comes the pass. Nothing may tell how many ranks there were.
#include "OcclusionScene.h"
#include "Stage.h"

#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkProperty.h"
#include "vtkRenderPass.h"
#include "vtkRenderState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace
{

constexpr int Width = 160;
constexpr int Height = 120;

/// Colours, 0 to 1, and depths of a picture.
struct Picture
{
  std::vector<float> Colors;
  std::vector<float> Depths;
};

/// Shows a picture that was made elsewhere.
class ShowPicture : public vtkRenderPass
{
public:
  static ShowPicture* New();
  vtkTypeMacro(ShowPicture, vtkRenderPass);

  void Render(const vtkRenderState* state) override
  {
    constexpr const char* source = "//VTK::System::Dec\n//VTK::Output::Dec\n"
                                   "uniform sampler2D colors;\n"
                                   "uniform sampler2D depths;\n"
                                   "uniform vec2 pixelSize;\n"
                                   "void main()\n"
                                   "{\n"
                                   "  vec2 at = gl_FragCoord.xy * pixelSize;\n"
                                   "  gl_FragData[0] = texture(colors, at);\n"
                                   "  gl_FragDepth = texture(depths, at).r;\n"
                                   "}\n";
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(state->GetRenderer()->GetRenderWindow());
    vtkShaderProgram* program = this->Stage.Ready(window, source);
    ASSERT_TRUE(program);
    const float pixelSize[2] = { 1.f / Width, 1.f / Height };
    program->SetUniform2f("pixelSize", pixelSize);
    this->Stage.Read("colors", Texture(window, this->Shown.Colors, 4, this->Colors));
    this->Stage.Read("depths", Texture(window, this->Shown.Depths, 1, this->Depths));
    this->Stage.Draw();
    this->NumberOfRenderedProps = 1;
  }
  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Stage.ReleaseGraphicsResources(window);
    this->Colors = nullptr;
    this->Depths = nullptr;
  }

  Picture Shown;

private:
  static vtkTextureObject* Texture(vtkOpenGLRenderWindow* window, std::vector<float>& values,
    int components, vtkSmartPointer<vtkTextureObject>& texture)
  {
    texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    texture->Create2DFromRaw(Width, Height, components, VTK_FLOAT, values.data());
    return texture;
  }

  penumbra::Stage Stage;
  vtkSmartPointer<vtkTextureObject> Colors;
  vtkSmartPointer<vtkTextureObject> Depths;
};
vtkStandardNewMacro(ShowPicture);

/// Every `ranks`-th of the scene's actors, beginning with one; all under the same camera.
Picture Draw(int rank, int ranks)
{
  OcclusionScene scene(Width, Height);
  std::vector<vtkSmartPointer<vtkActor>> actors = { scene.AddFloor(3.0),
    scene.AddWall({ -3, 1.5, 0 }, { 6, 0, 0 }, { 0, 0, 2 }) };
  for (int i = 0; i < 6; ++i)
  {
    actors.push_back(scene.AddSphere({ .8 * i - 2.0, .3 * (i % 3), .4 }, .45));
    actors.back()->GetProperty()->SetColor(.1 * i, .5, 1.0 - .1 * i);
  }
  scene.Look({ 0, -5, 3 }, { 0, 0, .4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  for (int i = 0; i < static_cast<int>(actors.size()); ++i)
  {
    actors[i]->SetVisibility(i % ranks == rank);
  }
  scene.Window->Render();
  Picture picture;
  for (const int value : scene.Picture())
  {
    picture.Colors.push_back(static_cast<float>(value) / 255.f);
  }
  vtkNew<vtkFloatArray> depths;
  scene.Window->GetZbufferData(0, 0, Width - 1, Height - 1, depths);
  picture.Depths.assign(depths->GetPointer(0), depths->GetPointer(0) + Width * Height);
  return picture;
}

/// The nearest of the pictures of all ranks.
Picture Composite(int ranks)
{
  Picture whole = Draw(0, ranks);
  for (int rank = 1; rank < ranks; ++rank)
  {
    const Picture part = Draw(rank, ranks);
    for (std::size_t i = 0; i < part.Depths.size(); ++i)
    {
      if (part.Depths[i] < whole.Depths[i])
      {
        whole.Depths[i] = part.Depths[i];
        std::copy_n(&part.Colors[4 * i], 4, &whole.Colors[4 * i]);
      }
    }
  }
  return whole;
}

/// The picture under the pass, in a window that knows nothing of the actors.
void Occlude(OcclusionScene& scene, int ranks)
{
  scene.Look({ 0, -5, 3 }, { 0, 0, .4 });
  scene.Renderer->GetActiveCamera()->SetClippingRange(1.0, 20.0);
  vtkNew<ShowPicture> show;
  show->Shown = Composite(ranks);
  scene.Renderer->SetPass(show);
  scene.Occlude(1.0);
  scene.Window->Render();
}

TEST(OcclusionOverRanks, IsTheSameForOneAndForFour)
{
  OcclusionScene one(Width, Height);
  Occlude(one, 1);
  OcclusionScene four(Width, Height);
  Occlude(four, 4);
  EXPECT_STREQ(four.Pass->GetActiveKernelName(), "march"); // from depth alone
  EXPECT_EQ(one.Array("Depth"), four.Array("Depth"));
  EXPECT_EQ(one.Array("AmbientOcclusion"), four.Array("AmbientOcclusion"));
  EXPECT_EQ(one.Picture(), four.Picture());
  const std::vector<float> occlusion = one.Array("AmbientOcclusion");
  EXPECT_GT(*std::max_element(occlusion.begin(), occlusion.end()), .5f);
}

TEST(OcclusionOverRanks, IsThatOfTheSceneItself)
{
  // Up to the margin, which only the scene itself can be drawn with.
  OcclusionScene ranks(Width, Height);
  Occlude(ranks, 4);
  const Picture whole = Draw(0, 1);
  const std::vector<float> occlusion = ranks.Array("AmbientOcclusion");
  const std::vector<int> picture = ranks.Picture();
  for (std::size_t i = 0; i < occlusion.size(); ++i)
  {
    const float open = whole.Depths[i] < 1.f ? 1.f - occlusion[i] : 1.f;
    ASSERT_NEAR(picture[4 * i], 255.f * whole.Colors[4 * i] * open, 1.5) << i;
  }
}

}
