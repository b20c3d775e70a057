// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraVectorExporter
 * @brief   Writes the image of a vtkPenumbraRayCaster as a figure in vector graphics (SVG or PDF).
 *
 * The figure consists of the surfaces and, over them, the visible parts of lines and points as
 * strokes, optional outlines, and text and scalar bars as text and polygons. The surfaces are
 * visible triangles, filled with one color or a linear gradient, or else the ray-cast image, see
 * MaximumPaths. Visibility is computed by rays; its changes along a line are located to 0.001
 * pixels.
 *
 * The page measures Resolution * 72 / DPI points of the ray caster. Text can be selected: SVG names
 * the font (Arial, Courier or Times with substitutes), PDF uses the standard fonts Helvetica,
 * Courier and Times, and outlines under invisible text where their characters, those of Windows code
 * page 1252, do not suffice, or the font is from a file. Invisible text over the labels of cube axes,
 * which are surfaces, and over the text of other layers can be selected, too. Spheres, tubes,
 * splats, lines with textures, wireframes without hidden lines, and renderers in other layers with
 * their text are part of the image, and so are all text and scalar bars if a 2-D actor has a
 * texture or interpolated colors. Lines and points that are hidden over a part of their width are
 * polygons with the visible part, within 0.01 pixels.
 *
 * The output of the ray caster is rendered without lines and text, and is rendered again by its
 * next update. Failures are reported as errors of this object.
 */
#ifndef vtkPenumbraVectorExporter_h
#define vtkPenumbraVectorExporter_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersRayCastingModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkFieldData;
class vtkPenumbraRayCaster;

class VTKPENUMBRAFILTERSRAYCASTING_EXPORT vtkPenumbraVectorExporter : public vtkObject
{
public:
  static vtkPenumbraVectorExporter* New();
  vtkTypeMacro(vtkPenumbraVectorExporter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// File formats.
  enum Formats
  {
    SVG, ///< SVG 1.1, with an embedded PNG image
    PDF  ///< PDF 1.4, one page
  };

  ///@{
  /**
   * Ray caster that provides the scene and renders the image. Default: null.
   */
  void SetRayCaster(vtkPenumbraRayCaster* caster);
  vtkPenumbraRayCaster* GetRayCaster();
  ///@}

  ///@{
  /**
   * Path of the file. Its extension, .svg or .pdf, selects the format. Default: null.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Maximum number of paths for surfaces. They are the ray-cast image instead if they need more, if
   * their colors would differ from the image by an RMSE of more than the tolerance of a tile of the
   * ray caster, see vtkPenumbraRayCaster::GetEstimatedError() (shadows, textures, large triangles),
   * if triangles overlap in a cycle, and in scenes with spheres, tubes, translucent surfaces,
   * light shafts, or renderers in other layers. 0: always the image. Range: [0, 1000000]. Default: 50000.
   */
  vtkSetClampMacro(MaximumPaths, int, 0, 1000000);
  vtkGetMacro(MaximumPaths, int);
  ///@}

  /**
   * Reason why the last figure shows the surfaces as an image; empty if it shows triangles.
   */
  std::string GetImageReason();

  ///@{
  /**
   * Width of outlines in points: visible silhouettes, boundaries, creases and color seams of
   * surfaces, spheres and tubes, without the curves where they intersect. 0: none. Range: [0, 1000]. Default: 0.
   */
  vtkSetClampMacro(OutlineWidth, double, 0.0, 1000.0);
  vtkGetMacro(OutlineWidth, double);
  ///@}

  ///@{
  /**
   * Color of outlines, in [0, 1]. Default: black.
   */
  vtkSetVector3Macro(OutlineColor, double);
  vtkGetVector3Macro(OutlineColor, double);
  ///@}

  /**
   * Writes the file: a temporary file beside it, which replaces it when it is complete. Returns
   * false and reports an error if there is no ray caster, it fails, the font of a text in PDF lacks
   * a character, or the file cannot be written.
   */
  bool Write();

  /**
   * Returns the contents of a file of format SVG or PDF; empty after an error, as for Write().
   */
  std::string Encode(int format);

  /**
   * Counts of the last figure, one array with one value each: `Vector/Faces`, `Vector/Lines`
   * (strokes of lines and points), `Vector/Outlines`, `Vector/Polygons` (of scalar bars and backgrounds of text),
   * `Vector/Texts`, `Vector/Images` and `Vector/OutlinedTexts` (lines of text in PDF that
   * are outlines). Empty after an error.
   */
  vtkFieldData* GetStatistics();

protected:
  vtkPenumbraVectorExporter();
  ~vtkPenumbraVectorExporter() override;

private:
  vtkPenumbraVectorExporter(const vtkPenumbraVectorExporter&) = delete;
  void operator=(const vtkPenumbraVectorExporter&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;

  char* FileName = nullptr;
  int MaximumPaths = 50000;
  double OutlineWidth = 0.0;
  double OutlineColor[3] = { 0.0, 0.0, 0.0 };
};

#endif
