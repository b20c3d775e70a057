// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "OptionNames.h"

#include "CommandError.h"
#include "MessageLog.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <cctype>
#include <utility>

namespace penumbra
{

namespace
{

bool IsWordCharacter(const std::string& text, std::size_t at)
{
  return at < text.size() &&
    (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
}

/// Replaces whole words.
void ReplaceWords(std::string& text, const std::string& words, const std::string& replacement)
{
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at))
  {
    if ((at > 0 && IsWordCharacter(text, at - 1)) || IsWordCharacter(text, at + words.size()))
    {
      at += words.size();
      continue;
    }
    text.replace(at, words.size(), replacement);
    at += replacement.size();
  }
}

}

std::string NameOptions(std::string message)
{
  // Sentences first, then the names that they contain.
  static const std::pair<const char*, const char*> rows[] = {
    { "for example with vtkReverseSense, or with flip_faces() in PyVista",
      "for example in the program that wrote the mesh" },
    { "for example with vtkReverseSense", "for example in the program that wrote the mesh" },
    { "not vtkPointSets", "not meshes" },
    { "Set another FontFile in its vtkTextProperty", "Set the environment variable PENUMBRA_FONT" },
    { "Call vtkRenderer::ResetCameraClippingRange()", "Check the --camera options" },
    { "Set AmbientOcclusion of vtkPenumbraRayCaster", "Use --ambient-occlusion" },
    { "Direct light needs at least one light. Call AddLight()",
      "--quantity direct-light needs --light-position" },
    { "vtkPenumbraEnvironment: Image must be set to a single slice with point scalars",
      "the image must be a single slice with point scalars" },
    { "vtkPenumbraEnvironment: the values of Image", "the values of the image" },
    { "vtkPenumbraEnvironment: Up", "--hdri-up" },
    { "vtkPenumbraMedium:", "--light-shafts:" },
    { "EnvironmentColor or Environment", "--environment-color or --hdri-file" },
    { "Reduce Resolution", "Reduce --resolution" },
    { "LightTolerance", "--light-tolerance" },
    { "Tolerance", "--tolerance" },
    { "TimeLimit", "--time-limit" },
    { "LightRadius", "--light-radius" },
    { "LineRadius", "--line-radius" },
    { "PointRadius", "--point-radius" },
    { "LightAngle", "--light-angle" },
    { "OpacityArray", "--opacity-array" },
    { "EnvironmentColor", "--environment-color" },
    { "Asymmetry", "--shafts-phase" },
    { "Bounds", "the bounds" },
    { "a vtkImageData", "an image" },
    { "a vtkPolyData", "a polygonal mesh" },
  };
  for (const auto& [words, replacement] : rows)
  {
    ReplaceWords(message, words, replacement);
  }
  return message;
}

void ThrowErrors(const std::string& what)
{
  const std::vector<std::string> errors = TakeErrors();
  for (const std::string& error : errors)
  {
    const std::size_t refusal = error.find("Not enough memory: ");
    if (refusal != error.npos)
    {
      throw CommandError(Unavailable, what + ": " + error.substr(refusal));
    }
  }
  RequireMemory(errors);
  if (!errors.empty())
  {
    throw CommandError(BadInput, what + ": " + NameOptions(errors.front()));
  }
}

unsigned long CollectWarnings(vtkObject* object, std::vector<std::string>& warnings)
{
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&warnings);
  observer->SetCallback([](vtkObject*, unsigned long, void* all, void* text) {
    static_cast<std::vector<std::string>*>(all)->push_back(
      NameOptions(StripMessagePrefix(static_cast<const char*>(text))));
  });
  return object->AddObserver(vtkCommand::WarningEvent, observer);
}

}
