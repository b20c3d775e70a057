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
 * Four metrics, each 0 for equal pictures:
 * - RMSE: root of the mean squared difference over pixels and channels;
 * - MAXIMUM: the largest difference of any channel of any pixel;
 * - SSIM: 1 minus the structural similarity of Wang, Bovik, Sheikh and Simoncelli (2004), mean over
 *   channels, Gaussian window of 11 x 11 with sigma 1.5, K1 = .01, K2 = .03, dynamic range 1; taken
 *   where the whole window lies inside, in pictures smaller than it where it is cut at the border;
 * - PIXELS: the share of pixels with a channel off by more than 4/255.
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
    NUMBER_OF_METRICS
  };

  /** `rmse`, `max`, `ssim` or `pixels`. */
  static const char* GetMetricName(int metric);

  ///@{
  /** The metric by which the nearest baseline is chosen. Default: RMSE. */
  vtkSetClampMacro(Metric, int, RMSE, PIXELS);
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
   * Compare; false when the pictures cannot be: none given, sizes that differ, values that are not
   * finite. GetErrorText() then says which in one sentence.
   */
  bool Compare();
  const char* GetErrorText();

  /** Index of the baseline nearest by Metric, after Compare(); -1 before. */
  int GetBestBaseline();

  /** The difference from that baseline by any metric, after Compare(). */
  double GetValue(int metric);

  /**
   * A picture of the absolute differences from that baseline, after Compare(): `Color` (4 floats,
   * alpha 1), a difference of alpha added to every channel.
   */
  vtkSmartPointer<vtkImageData> MakeDifference();

protected:
  vtkPenumbraImageComparison();
  ~vtkPenumbraImageComparison() override;

private:
  vtkPenumbraImageComparison(const vtkPenumbraImageComparison&) = delete;
  void operator=(const vtkPenumbraImageComparison&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Implementation;
  int Metric = RMSE;
};

#endif
