// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Images that several ranks render together, compared with those of one rank that has the data of all. All are
// rendered in separate processes, see ForkedRanks.h.
#ifndef RankImages_h
#define RankImages_h

#include "vtkPenumbraRayCaster.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

class vtkActor;
class vtkDataObject;

namespace penumbra
{

using Caster = vtkPenumbraRayCaster;
using Settings = std::function<void(Caster*)>;
/// Bytes of the arrays and statistics of an image by name; "Error" and "Warning" are its messages.
using Image = std::map<std::string, std::string>;
/// Makes the data of a rank of `ranks`.
using MakeData = std::function<vtkSmartPointer<vtkDataObject>(int rank, int ranks)>;

constexpr int Width = 150;
constexpr int Height = 110;

/// Returns what rank `rank` of `ranks` has: strips of three surfaces that hide each other.
vtkSmartPointer<vtkPolyData> MakePiece(int rank, int ranks, int resolution = 60);

/// Adds vertices on an arc around `piece`, of which most are joined by lines.
/// `group`: where the arc begins, in radians. `low`: z of the first one.
void AddVerticesAndLines(vtkPolyData* piece, int group, int count, double low);

inline vtkSmartPointer<vtkDataObject> MakeCoarse(int rank, int ranks)
{
  return MakePiece(rank, ranks, 10);
}

inline void UseDefaults(Caster*) {}
inline void KeepActor(vtkActor*) {}

/// Writes an image as the result of a rank, and reads it.
std::string Pack(const Image& image);
Image Unpack(const std::string& bytes);

/// Returns a number of an image; NaN if there is none of this name.
double GetNumber(const Image& image, const char* name);

/// Renders the data with a ray caster.
Image Render(Caster* caster, const std::vector<vtkDataObject*>& data, const Settings& settings);

/// Renders the data of each of several ranks together.
std::vector<Image> RenderOnRanks(int ranks, const MakeData& make, const Settings& settings);

/// Renders the data of all ranks, appended, on one rank.
Image RenderOnOne(int ranks, const MakeData& make, const Settings& settings);

/// Adds an actor that shows the data to a new renderer with a camera that does not depend on it.
vtkSmartPointer<vtkRenderer> MakeRenderer(
  vtkPolyData* data, const std::function<void(vtkActor*)>& change);

/// Expects the same arrays and statistics in every bit, except for what depends on the division.
void ExpectSame(const Image& image, const Image& expected);

/// Expects the image of each of several ranks to equal that of one rank with the data of all. Returns it.
Image ExpectSameOnRanks(int ranks, const MakeData& make, const Settings& settings);

/// The same as ExpectSameOnRanks() with a renderer on each rank.
Image ExpectSameViewsOnRanks(int ranks, const MakeData& make,
  const std::function<void(vtkActor*)>& change, const Settings& settings);

}
#endif
