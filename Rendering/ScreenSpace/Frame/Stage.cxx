// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Stage.h"

#include "OpenGLFunctions.h"
#include "ScopedShaderEdit.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPenumbraQuadVS.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

namespace penumbra
{

namespace
{

/// Number of inputs of four components that OpenGL 3.2 guarantees.
constexpr std::size_t MaximumInputs = 15;

struct Uniform
{
  std::string Type;
  std::string Name;
  std::size_t Components = 0;
};

bool IsPartOfWord(char character)
{
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
}

/// Returns whether a word occurs in a text more than once.
bool IsRepeated(const std::string& text, const std::string& word)
{
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    const std::size_t end = at + word.size();
    const bool isWord =
      (at == 0 || !IsPartOfWord(text[at - 1])) && (end == text.size() || !IsPartOfWord(text[end]));
    count += isWord ? 1 : 0;
  }
  return count > 1;
}

/// Returns the uniforms that can be moved, the largest first, so that they fill the inputs.
std::vector<Uniform> FindUniforms(const std::string& shader)
{
  static const std::regex declaration("\\buniform (float|vec2|vec3|vec4|mat4) (\\w+);");
  std::vector<Uniform> uniforms;
  for (std::sregex_iterator found(shader.begin(), shader.end(), declaration), end; found != end;
       ++found)
  {
    const std::string type = (*found)[1];
    const std::string name = (*found)[2];
    if (IsRepeated(shader, name)) // it is used
    {
      uniforms.push_back({ type, name,
        type == "float"    ? 1
          : type == "mat4" ? 16
                           : static_cast<std::size_t>(type.back() - '0') });
    }
  }
  std::stable_sort(uniforms.begin(), uniforms.end(),
    [](const Uniform& a, const Uniform& b) { return a.Components > b.Components; });
  return uniforms;
}

std::string InputName(std::size_t index)
{
  return "flatUniforms" + std::to_string(index);
}

void InsertAfter(std::string& shader, const std::string& line, const std::string& text)
{
  const std::size_t at = shader.rfind(line);
  if (at != std::string::npos)
  {
    shader.insert(at + line.size(), text);
  }
}

/// Moves uniforms of type float, vec2, vec3, vec4 and mat4 from a fragment shader to the vertex shader,
/// which passes them on without interpolation. Their names and values stay the same. Uniforms that no
/// longer fit into the inputs that every driver has, and unused ones, are not moved; nor are integers,
/// which made no shader measurably faster. Both shaders begin with the line //VTK::System::Dec.
/// Mesa's software renderer fetches each component of a uniform once per pixel, with a test of its bounds, but a flat
/// input once for all pixels that it executes together: Benchmarks/notes/ambient-occlusion.md.
void PassUniformsFlat(std::string& vertexShader, std::string& fragmentShader)
{
  std::vector<std::size_t> used; // components of each input
  std::string uniforms;
  std::string outputs;
  std::string inputs;
  for (const Uniform& uniform : FindUniforms(fragmentShader))
  {
    const std::size_t columns = (uniform.Components + 3) / 4;
    const std::size_t components = uniform.Components / columns;
    const auto partial = std::find_if(
      used.begin(), used.end(), [&](std::size_t count) { return count + components <= 4; });
    const bool isNew = columns > 1 || partial == used.end();
    const std::size_t input =
      isNew ? used.size() : static_cast<std::size_t>(partial - used.begin());
    if (input + columns > MaximumInputs)
    {
      continue;
    }
    used.resize(std::max(used.size(), input + columns), 0);
    std::string value;
    for (std::size_t column = 0; column < columns; ++column)
    {
      const std::string part = InputName(input + column) + "." +
        std::string("xyzw").substr(used[input + column], components);
      used[input + column] += components;
      const std::string index = columns > 1 ? "[" + std::to_string(column) + "]" : "";
      outputs += "  " + part + " = " + uniform.Name + index + ";\n";
      value += (column > 0 ? ", " : "") + part;
    }
    const std::string prefix = uniform.Type + " " + uniform.Name + ";";
    uniforms += "uniform " + prefix + "\n";
    const std::string old = "uniform " + prefix;
    fragmentShader.replace(fragmentShader.find(old), old.size(),
      uniform.Type + " " + uniform.Name + " = " + uniform.Type + "(" + value + ");");
  }
  for (std::size_t input = 0; input < used.size(); ++input)
  {
    uniforms += "flat out vec4 " + InputName(input) + ";\n";
    inputs += "flat in vec4 " + InputName(input) + ";\n";
  }
  const std::string head = "//VTK::System::Dec\n";
  const std::string entry = "void main()\n{\n";
  InsertAfter(vertexShader, head, uniforms);
  InsertAfter(vertexShader, entry, outputs);
  InsertAfter(fragmentShader, head, inputs);
}

}

std::string Assemble(
  std::string source, const std::vector<std::pair<std::string, std::string>>& pieces)
{
  for (const auto& [name, text] : pieces)
  {
    vtkShaderProgram::Substitute(source, "//VTK::Penumbra::" + name, text);
  }
  return source;
}

void PendingCount::Begin()
{
  if (this->Query == 0)
  {
    glGenQueries(1, &this->Query);
  }
  glBeginQuery(GL_SAMPLES_PASSED, this->Query);
}

void PendingCount::End()
{
  glEndQuery(GL_SAMPLES_PASSED);
}

unsigned int PendingCount::Take()
{
  GLuint count = 0;
  glGetQueryObjectuiv(this->Query, GL_QUERY_RESULT, &count);
  return count;
}

void PendingCount::ReleaseGraphicsResources()
{
  if (this->Query > 0)
  {
    glDeleteQueries(1, &this->Query);
    this->Query = 0;
  }
}

Stage::Stage() = default;
Stage::~Stage() = default;

vtkShaderProgram* Stage::Ready(vtkOpenGLRenderWindow* window, const std::string& text)
{
  const std::string source = ScopedShaderEdit::Apply(text);
  if (this->Quad && this->Quad->Program && this->Source == source)
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  else
  {
    std::string vertexShader = vtkPenumbraQuadVS;
    std::string fragmentShader = source;
    PassUniformsFlat(vertexShader, fragmentShader);
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(
      window, vertexShader.c_str(), fragmentShader.c_str(), "");
    this->Source = source;
    this->Window = window;
  }
  vtkShaderProgram* program = this->Quad->Program;
  return program && program->GetCompiled() ? program : nullptr;
}

void Stage::BindTexture(const char* name, vtkTextureObject* texture)
{
  texture->Activate();
  this->Quad->Program->SetUniformi(name, texture->GetTextureUnit());
  this->Inputs.push_back(texture);
}

void Stage::Draw()
{
  this->Quad->Render();
  this->Unbind();
}

void Stage::Draw(const std::vector<Rectangle>& parts)
{
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
  state->vtkglEnable(GL_SCISSOR_TEST);
  for (const Rectangle& part : parts)
  {
    state->vtkglScissor(part.X, part.Y, part.Width, part.Height);
    this->Quad->Render();
  }
  this->Unbind();
}

void Stage::DrawSamples(vtkShaderProgram* program)
{
  // The driver may have rounded the number of samples up.
  GLint count = 0;
  glGetIntegerv(GL_SAMPLES, &count);
  vtkOpenGLState* state = this->Window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable multisample(state, GL_MULTISAMPLE);
  state->vtkglEnable(GL_MULTISAMPLE); // without it, the mask has no effect
  const bool wasMasked = glIsEnabled(GL_SAMPLE_MASK) == GL_TRUE;
  GLint mask = 0;
  glGetIntegeri_v(GL_SAMPLE_MASK_VALUE, 0, &mask);
  glEnable(GL_SAMPLE_MASK);
  for (int i = 0; i < std::max(count, 1); ++i)
  {
    glSampleMaski(0, 1u << i);
    program->SetUniformi("sampleIndex", i);
    this->Quad->Render();
  }
  glSampleMaski(0, static_cast<GLbitfield>(mask));
  if (!wasMasked)
  {
    glDisable(GL_SAMPLE_MASK);
  }
  this->Unbind();
}

unsigned int Stage::DrawAndCount()
{
  PendingCount pending;
  this->DrawAndCount(pending);
  const unsigned int count = pending.Take();
  pending.ReleaseGraphicsResources();
  return count;
}

void Stage::DrawAndCount(PendingCount& count)
{
  count.Begin();
  this->Draw();
  count.End();
}

void Stage::Unbind()
{
  for (vtkTextureObject* input : this->Inputs)
  {
    input->Deactivate();
  }
  this->Inputs.clear();
}

void Stage::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Quad)
  {
    this->Quad->ReleaseGraphicsResources(window);
    this->Quad.reset();
  }
}

struct SavedState
{
  explicit SavedState(vtkOpenGLState* state)
    : State(state),
      Viewport(state),
      Scissor(state),
      ScissorTest(state, GL_SCISSOR_TEST),
      Blend(state, GL_BLEND),
      BlendFunction(state),
      DepthTest(state, GL_DEPTH_TEST)
  {
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  ~SavedState()
  {
    // VTK's passes expect these values.
    this->State->vtkglDepthFunc(GL_LEQUAL);
    this->State->vtkglDepthMask(GL_TRUE);
  }
  SavedState(const SavedState&) = delete;
  void operator=(const SavedState&) = delete;

  vtkOpenGLState* const State;
  const vtkOpenGLState::ScopedglViewport Viewport;
  const vtkOpenGLState::ScopedglScissor Scissor;
  const vtkOpenGLState::ScopedglEnableDisable ScissorTest;
  const vtkOpenGLState::ScopedglEnableDisable Blend;
  const vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
  const vtkOpenGLState::ScopedglEnableDisable DepthTest;
};

ScopedRenderTarget::ScopedRenderTarget(vtkOpenGLRenderWindow* window,
  vtkOpenGLFramebufferObject* framebuffer, const std::vector<vtkTextureObject*>& targets,
  vtkTextureObject* depth)
  : Window(window),
    Saved(std::make_unique<SavedState>(window->GetState())),
    Framebuffer(framebuffer),
    Count(static_cast<unsigned int>(targets.size())),
    Depth(depth != nullptr)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  framebuffer->Bind();
  for (unsigned int i = 0; i < this->Count; ++i)
  {
    framebuffer->AddColorAttachment(i, targets[i]);
  }
  framebuffer->ActivateDrawBuffers(this->Count);
  if (depth)
  {
    framebuffer->AddDepthAttachment(depth);
  }
  const auto width = static_cast<int>(targets.front()->GetWidth());
  const auto height = static_cast<int>(targets.front()->GetHeight());
  this->Complete = framebuffer->Start(width, height);
  state->vtkglDepthMask(GL_FALSE);
  if (depth)
  {
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_GREATER);
  }
}

ScopedRenderTarget::~ScopedRenderTarget()
{
  this->Framebuffer->RemoveColorAttachments(this->Count);
  if (this->Depth)
  {
    this->Framebuffer->RemoveDepthAttachment();
  }
  this->Window->GetState()->PopFramebufferBindings();
}

ScopedBlending::ScopedBlending(vtkOpenGLRenderWindow* window, const int viewport[4], bool depths)
  : Saved(std::make_unique<SavedState>(window->GetState()))
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  state->vtkglScissor(viewport[0], viewport[1], viewport[2], viewport[3]);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  depths ? state->vtkglEnable(GL_DEPTH_TEST) : state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(depths ? GL_TRUE : GL_FALSE);
  state->vtkglDepthFunc(GL_ALWAYS);
}

ScopedBlending::~ScopedBlending() = default;

bool Allocate(vtkSmartPointer<vtkTextureObject>& texture, vtkOpenGLRenderWindow* window, int width,
  int height, int components)
{
  if (texture && texture->GetContext() == window && texture->GetComponents() == components &&
    texture->GetWidth() == static_cast<unsigned int>(width) &&
    texture->GetHeight() == static_cast<unsigned int>(height))
  {
    return false;
  }
  const std::vector<float> zeros(static_cast<std::size_t>(width) * height * components, 0.f);
  texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->Create2DFromRaw(width, height, components, VTK_FLOAT, const_cast<float*>(zeros.data()));
  return true;
}

std::vector<float> ReadBack(vtkTextureObject* texture)
{
  const unsigned int size[2] = { texture->GetWidth(), texture->GetHeight() };
  const int components = texture->GetComponents();
  std::vector<float> values(static_cast<std::size_t>(size[0]) * size[1] * components);
  vtkIdType increments[2] = { 0, 0 };
  unsigned int dimensions[2] = { size[0], size[1] };
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  buffer->Download2D(VTK_FLOAT, values.data(), dimensions, components, increments);
  return values;
}

}
