// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraImageComparison
 * @brief   How far one picture is from another, or from the nearest of several baselines.
 *
 * A picture is the point array `Color` of an image, else its scalars: grey, grey with alpha, RGB or
 * RGBA; 8 and 16 bit integers are taken as shares of their maximum, floats as they are. What is
 * compared is the colour times alpha, and alpha itself where a picture has any below 1: so what
 * nobody can see does not count.
 *
 * The metrics, each 0 for equal pictures:
 * - RMSE: root of the mean squared difference over pixels and channels;
 * - MAXIMUM: the largest difference of any channel of any pixel;
 * - SSIM: 1 minus the structural similarity of Wang, Bovik, Sheikh and Simoncelli (2004), mean over
 *   channels, Gaussian window of 11 x 11 with sigma 1.5, K1 = .01, K2 = .03, dynamic range 1; taken
 *   where the whole window lies inside, in pictures smaller than it where it is cut at the border;
 * - PIXELS: the share of pixels with a channel off by more than 4/255;
 * - TILE_RMSE and TILE_PIXELS: RMSE and PIXELS of the worst 16x16 pixels, wherever these lie: a flaw
 *   counts the same in a picture of any size;
 * - EXCESS: the largest of TILE_RMSE, PIXELS and TILE_PIXELS, each divided by its limit.
 *
 * Two pictures are near when EXCESS is at most 1. The default limits forgive single pixels that fall
 * on the other side of an edge, as between two drivers of OpenGL, and forgive neither swapped colours
 * nor one lost line of pixels. SSIM never decides.
 */
#ifndef vtkPenumbraImageComparison_h
#define vtkPenumbraImageComparison_h

#include "vtkObject.h"
#include "vtkPenumbraTestingComparisonModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for MakeDifference

#include <memory> // for std::unique_ptr

class vtkImageData;

class VTKPENUMBRATESTINGCOMPARISON_EXPORT vtkPenumbraImageComparison : public vtkObject
{
public:
  static vtkPenumbraImageComparison* New();
  vtkTypeMacro(vtkPenumbraImageComparison, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** What a difference is measured by. */
  enum Metrics
  {
    RMSE,
    MAXIMUM,
    SSIM,
    PIXELS,
    TILE_RMSE,
    TILE_PIXELS,
    EXCESS,
    NUMBER_OF_METRICS
  };

  /** `rmse`, `max`, `ssim`, `pixels`, `tile-rmse`, `tile-pixels` or `excess`. */
  static const char* GetMetricName(int metric);

  ///@{
  /**
   * The error that the caller accepts: the largest TILE_RMSE of pictures that are near, 0 to 1; 0: they
   * must be equal. Default: 1/16, which is one pixel of a tile turned from black to white.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** The largest PIXELS of pictures that are near, 0 to 1. Default: 0.01. */
  vtkSetClampMacro(PixelLimit, double, 0.0, 1.0);
  vtkGetMacro(PixelLimit, double);
  ///@}

  ///@{
  /** The largest TILE_PIXELS of pictures that are near, 0 to 1. Default: 1/32, 8 pixels of a tile. */
  vtkSetClampMacro(TilePixelLimit, double, 0.0, 1.0);
  vtkGetMacro(TilePixelLimit, double);
  ///@}

  ///@{
  /** The metric by which the nearest baseline is chosen. Default: RMSE. */
  vtkSetClampMacro(Metric, int, RMSE, EXCESS);
  vtkGetMacro(Metric, int);
  ///@}

  /** The picture in question. */
  void SetImage(vtkImageData* image);

  ///@{
  /** The pictures that it may look like. */
  void AddBaseline(vtkImageData* baseline);
  void RemoveAllBaselines();
  ///@}

  /**
   * Which pixels count: those of `mask`, as large as the picture, that are not black. The others are
   * taken for equal, and means are over those that count. Default: none, all count.
   */
  void SetMask(vtkImageData* mask);

  /**
   * Compare; false when the pictures cannot be: none given, sizes that differ, values that are not
   * finite, a mask that leaves nothing. GetErrorText() then says which in one sentence.
   */
  bool Compare();
  const char* GetErrorText();

  /** Index of the baseline nearest by Metric, after Compare(); -1 before. */
  int GetBestBaseline();

  /** The difference from that baseline by any metric, after Compare(). */
  double GetValue(int metric);

  /** Is its EXCESS at most 1? False before Compare(). */
  bool IsNear();

  /**
   * A picture of the absolute differences from that baseline, after Compare(): `Color` (4 floats,
   * alpha 1), a difference of alpha added to every channel; all times `factor`.
   */
  vtkSmartPointer<vtkImageData> MakeDifference(double factor = 1.0);

protected:
  vtkPenumbraImageComparison();
  ~vtkPenumbraImageComparison() override;

private:
  vtkPenumbraImageComparison(const vtkPenumbraImageComparison&) = delete;
  void operator=(const vtkPenumbraImageComparison&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
  double Tolerance = 1.0 / 16.0;
  double PixelLimit = 0.01;
  double TilePixelLimit = 1.0 / 32.0;
  int Metric = RMSE;
};

#endif
