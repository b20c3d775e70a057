// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TextOutlines.h"

#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPath.h"
#include "vtkPoints.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace penumbra
{
namespace
{

// Size of the font in pixels, at which hinting does not matter.
constexpr int OutlineSize = 1000;
constexpr int DotsPerInch = 72;

void SetFont(const OverlayShape& text, vtkTextProperty* property)
{
  property->SetFontSize(OutlineSize);
  property->SetFontFamilyAsString(text.FontFamily.c_str());
  property->SetFontFile(text.FontFile.empty() ? nullptr : text.FontFile.c_str());
  property->SetBold(text.Bold);
  property->SetItalic(text.Italic);
}

/// Returns the outlines of characters at (0, descent of the font); empty after an error.
vtkSmartPointer<vtkPath> FindPath(const std::string& characters, vtkTextProperty* property)
{
  auto path = vtkSmartPointer<vtkPath>::New();
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (!renderer || !renderer->StringToPath(property, characters, path, DotsPerInch))
  {
    throw std::runtime_error("The font of a text cannot be read.");
  }
  return path;
}

bool IsSpace(std::uint32_t character)
{
  return character <= 0x20 || character == 0xa0 || (character >= 0x2000 && character <= 0x200f) ||
    character == 0x202f || character == 0x205f || character == 0x3000 || character == 0xfeff;
}

/// Returns true if two paths have the same points.
bool IsSame(vtkPath* a, vtkPath* b)
{
  vtkPoints* p = a->GetPoints();
  vtkPoints* q = b->GetPoints();
  bool same = p->GetNumberOfPoints() == q->GetNumberOfPoints();
  for (vtkIdType i = 0; same && i < p->GetNumberOfPoints(); ++i)
  {
    same = p->GetPoint(i)[0] == q->GetPoint(i)[0] && p->GetPoint(i)[1] == q->GetPoint(i)[1];
  }
  return same;
}

/// Throws if the font lacks a character: its outline is empty, or that of a character that no font
/// has.
void CheckCharacters(const OverlayShape& text, vtkTextProperty* property)
{
  const vtkSmartPointer<vtkPath> missing = FindPath("\xef\xbf\xbe", property); // U+FFFE
  for (std::size_t i = 0; i < text.Text.size();)
  {
    const std::size_t begin = i;
    const std::uint32_t character = TakeCharacter(text.Text, i);
    const std::string bytes = text.Text.substr(begin, i - begin);
    if (IsSpace(character))
    {
      continue;
    }
    const vtkSmartPointer<vtkPath> path = FindPath(bytes, property);
    if (path->GetPoints()->GetNumberOfPoints() == 0 || IsSame(path, missing))
    {
      char code[16];
      std::snprintf(code, sizeof(code), "U+%04X", static_cast<unsigned int>(character));
      throw std::runtime_error("The font " +
        (text.FontFile.empty() ? text.FontFamily : text.FontFile) + " lacks the character " + code +
        " of the text '" + text.Text +
        "', so that a PDF file cannot show it. Set another FontFile in its vtkTextProperty, "
        "replace the character, or write SVG.");
    }
  }
}

}

std::uint32_t TakeCharacter(const std::string& text, std::size_t& i)
{
  const auto lead = static_cast<unsigned char>(text[i++]);
  const int more = lead < 0x80 ? 0 : lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : -1;
  if (more <= 0)
  {
    return more == 0 ? lead : 0xfffd;
  }
  std::uint32_t character = lead & (0x3fu >> more);
  for (int j = 0; j < more; ++j)
  {
    if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xc0u) != 0x80u)
    {
      return 0xfffd;
    }
    character = character << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
  }
  return character;
}

std::vector<OutlineCommand> MakeTextOutlines(const OverlayShape& text)
{
  vtkNew<vtkTextProperty> property;
  SetFont(text, property);
  CheckCharacters(text, property);
  vtkTextRenderer::Metrics metrics;
  if (!vtkTextRenderer::GetInstance()->GetMetrics(property, text.Text, metrics, DotsPerInch))
  {
    throw std::runtime_error("The font of a text cannot be read.");
  }
  const double descent = std::hypot(metrics.Descent[0], metrics.Descent[1]) + 1.0;
  const vtkSmartPointer<vtkPath> path = FindPath(text.Text, property);
  const auto point = [&](vtkIdType i) {
    const double* p = path->GetPoints()->GetPoint(i);
    return glm::dvec2(p[0], p[1] - descent) / static_cast<double>(OutlineSize);
  };
  std::vector<OutlineCommand> commands;
  glm::dvec2 last(0.0);
  for (vtkIdType i = 0; i < path->GetPoints()->GetNumberOfPoints();)
  {
    const int code = static_cast<int>(path->GetCodes()->GetComponent(i, 0));
    if (code == vtkPath::CUBIC_CURVE)
    {
      commands.push_back({ OutlineCommand::Cubic, { point(i), point(i + 1), point(i + 2) } });
      i += 3;
    }
    else if (code == vtkPath::CONIC_CURVE)
    {
      const glm::dvec2 control = point(i);
      const glm::dvec2 end = point(i + 1);
      commands.push_back({ OutlineCommand::Cubic,
        { glm::mix(last, control, 2.0 / 3.0), glm::mix(end, control, 2.0 / 3.0), end } });
      i += 2;
    }
    else
    {
      commands.push_back(
        { code == vtkPath::MOVE_TO ? OutlineCommand::Move : OutlineCommand::Line, { point(i) } });
      ++i;
    }
    last = point(i - 1);
  }
  return commands;
}

}
