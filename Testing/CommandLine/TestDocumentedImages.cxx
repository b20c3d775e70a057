// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Each command `./penumbra render Data/...` of the pages makes the image of the same name in
// Documentation/Images, which the page shows.
#include "Program.h"
#include "RenderedImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <vector>

using namespace penumbra_testing;

namespace
{

const std::string Root = SourceFolder();

struct Command
{
  std::vector<std::string> Pages;
  std::string Arguments; ///< words of the shell after ./penumbra
  std::string Image;
};

/// The commands of the pages.
std::vector<Command> DocumentedCommands()
{
  std::map<std::string, Command> commands;
  for (const std::string page :
    { "README.md", "Documentation/Gallery.md", "Documentation/GettingStarted.md" })
  {
    const std::string text =
      std::regex_replace(ReadText(Root + "/" + page), std::regex("\\\\\n"), " ");
    const std::regex pattern(
      "\n\\./penumbra (render Data/[^\n]* --output ([^ \n]+)[^\n]*?)( # [^\n]*)?(?=\n)");
    for (auto i = std::sregex_iterator(text.begin(), text.end(), pattern);
         i != std::sregex_iterator(); ++i)
    {
      Command& command = commands[(*i)[1]];
      command.Pages.push_back(page);
      command.Arguments = (*i)[1];
      command.Image = (*i)[2];
    }
  }
  std::vector<Command> list;
  for (const auto& [arguments, command] : commands)
  {
    list.push_back(command);
  }
  return list;
}

std::ostream& operator<<(std::ostream& os, const Command& command)
{
  return os << command.Image;
}

/// Returns the image with half its width and height.
vtkSmartPointer<vtkImageData> Halve(vtkImageData* image)
{
  const int* size = image->GetDimensions();
  vtkDataArray* values = image->GetPointData()->GetScalars();
  auto half = vtkSmartPointer<vtkImageData>::New();
  half->SetDimensions(size[0] / 2, size[1] / 2, 1);
  half->AllocateScalars(VTK_FLOAT, 3);
  for (int y = 0; y < size[1] / 2; ++y)
  {
    for (int x = 0; x < size[0] / 2; ++x)
    {
      for (int k = 0; k < 3; ++k)
      {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i)
        {
          sum += values->GetComponent((2 * y + i / 2) * size[0] + 2 * x + i % 2, k);
        }
        half->SetScalarComponentFromDouble(x, y, 0, k, sum / (4.0 * 255.0));
      }
    }
  }
  return half;
}

/// Runs a command for an image of the size of `expected`, and compares the images.
vtkSmartPointer<vtkPenumbraImageComparison> Render(const Command& command, vtkImageData* expected)
{
  const Folder folder("documented");
  const int* size = expected->GetDimensions();
  const ProgramResult outcome = RunShell("cd " + Quote(folder.Path) + " && ln -s " +
    Quote(Root + "/Data") + " Data && $PENUMBRA " + command.Arguments + " --resolution " +
    std::to_string(size[0]) + "," + std::to_string(size[1]));
  EXPECT_EQ(outcome.Status, 0) << outcome.Errors;
  auto comparison = vtkSmartPointer<vtkPenumbraImageComparison>::New();
  comparison->SetImage(ReadImage(folder / command.Image));
  comparison->AddBaseline(expected);
  EXPECT_TRUE(comparison->Compare()) << comparison->GetErrorText();
  return comparison;
}

class DocumentedImages : public testing::TestWithParam<Command>
{
};

/// True for images with lines or text, which have sizes in pixels.
bool HasSizesInPixels(const Command& command)
{
  return command.Arguments.find("--line-width") != std::string::npos ||
    command.Arguments.find("--scalar-bar") != std::string::npos;
}

// At half the size, which takes a quarter of the time, where that shows the same.
TEST_P(DocumentedImages, AreMadeByTheirCommands)
{
  const Command& command = GetParam();
  for (const std::string& page : command.Pages)
  {
    EXPECT_NE(ReadText(Root + "/" + page).find("Images/" + command.Image + ")"), std::string::npos)
      << page << " does not show the image.";
  }
  const auto image = ReadImage(Root + "/Documentation/Images/" + command.Image);
  ASSERT_GT(image->GetNumberOfPoints(), 1) << "no such image";
  const auto half = HasSizesInPixels(command) ? nullptr : Render(command, Halve(image));
  if (!half || half->GetValue(vtkPenumbraImageComparison::TILE_RMSE) > 0.05 ||
    half->GetValue(vtkPenumbraImageComparison::PIXELS) > 0.1)
  {
    EXPECT_LE(Render(command, image)->GetValue(vtkPenumbraImageComparison::EXCESS), 1.0);
  }
}

std::string NameOf(const testing::TestParamInfo<Command>& command)
{
  std::string name = command.param.Image.substr(0, command.param.Image.rfind('.'));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocumentedImages, testing::ValuesIn(DocumentedCommands()), NameOf);

}
