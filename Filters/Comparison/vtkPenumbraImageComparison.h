// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraImageComparison
 * @brief   Difference of an image from another one, or from the nearest of several baselines.
 *
 * Compares the point array `Color`, or else the scalars: gray, gray with alpha, RGB or RGBA. 8 and
 * 16 bit integers are divided by their maximum, floats are used as they are. Colors are multiplied
 * by alpha, so that invisible colors do not count. Alpha is compared, too, if an image has any
 * value below 1.
 *
 * The metrics, each 0 for equal images:
 * - RMSE: root mean square of the difference over pixels and channels;
 * - MAXIMUM: the largest difference of any channel of any pixel;
 * - SSIM: 1 minus the structural similarity of Wang, Bovik, Sheikh and Simoncelli (2004), mean over
 *   channels, Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03, dynamic range 1;
 *   evaluated where the whole window lies inside the image, or, in images smaller than the window,
 *   at all pixels with the window cut at the image edge;
 * - PIXELS: the fraction of pixels with a channel that differs by more than 4/255;
 * - TILE_RMSE and TILE_PIXELS: RMSE and PIXELS of the worst 16x16 pixels at any position, so that a
 *   defect counts the same in images of any size;
 * - EXCESS: the largest of TILE_RMSE, PIXELS and TILE_PIXELS, each divided by its limit.
 *
 * Two images are near if EXCESS is at most 1. The default limits accept single pixels on the other
 * side of an edge, as they occur between OpenGL drivers. They reject swapped colors and a missing
 * line of pixels. SSIM is not part of this decision.
 */
#ifndef vtkPenumbraImageComparison_h
#define vtkPenumbraImageComparison_h

#include "vtkObject.h"
#include "vtkPenumbraFiltersComparisonModule.h" // for export macro
#include "vtkSmartPointer.h"                    // for MakeDifference

#include <memory> // for std::unique_ptr

class vtkImageData;

class VTKPENUMBRAFILTERSCOMPARISON_EXPORT vtkPenumbraImageComparison : public vtkObject
{
public:
  static vtkPenumbraImageComparison* New();
  vtkTypeMacro(vtkPenumbraImageComparison, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Metrics of the difference of two images. */
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

  /** Name of a metric: `rmse`, `max`, `ssim`, `pixels`, `tile-rmse`, `tile-pixels` or `excess`. */
  static const char* GetMetricName(int metric);

  ///@{
  /**
   * Largest TILE_RMSE of images that are near; 0 requires equal images. Range: [0, 1].
   * Default: 1/16, which is one pixel of a tile changed from black to white.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** Largest PIXELS of images that are near. Range: [0, 1]. Default: 0.01. */
  vtkSetClampMacro(PixelLimit, double, 0.0, 1.0);
  vtkGetMacro(PixelLimit, double);
  ///@}

  ///@{
  /**
   * Largest TILE_PIXELS of images that are near. Range: [0, 1]. Default: 1/32, 8 pixels of a tile.
   */
  vtkSetClampMacro(TilePixelLimit, double, 0.0, 1.0);
  vtkGetMacro(TilePixelLimit, double);
  ///@}

  ///@{
  /** Metric that selects the nearest baseline. Default: RMSE. */
  vtkSetClampMacro(Metric, int, RMSE, EXCESS);
  vtkGetMacro(Metric, int);
  void SetMetricToRMSE() { this->SetMetric(RMSE); }
  void SetMetricToMaximum() { this->SetMetric(MAXIMUM); }
  void SetMetricToSSIM() { this->SetMetric(SSIM); }
  void SetMetricToPixels() { this->SetMetric(PIXELS); }
  void SetMetricToTileRMSE() { this->SetMetric(TILE_RMSE); }
  void SetMetricToTilePixels() { this->SetMetric(TILE_PIXELS); }
  void SetMetricToExcess() { this->SetMetric(EXCESS); }
  const char* GetMetricAsString();
  ///@}

  /** Image to be compared. Default: none. */
  void SetImage(vtkImageData* image);

  ///@{
  /** Baselines that the image is compared with. */
  void AddBaseline(vtkImageData* baseline);
  void RemoveAllBaselines();
  ///@}

  /**
   * Mask of the image's size. Pixels that are black in it are treated as equal and excluded from
   * means. Default: none, all pixels count.
   */
  void SetMask(vtkImageData* mask);

  /**
   * Compares the images. Returns false if they cannot be compared: no image is set, sizes differ,
   * values are not finite, or the mask excludes all pixels. GetErrorText() then returns the reason.
   */
  bool Compare();
  const char* GetErrorText();

  /** Index of the baseline that is nearest by Metric, after Compare(); -1 before. */
  int GetBestBaseline();

  /** Difference from that baseline by any metric, after Compare(). */
  double GetValue(int metric);

  /** True if the EXCESS of that baseline is at most 1. False before Compare(). */
  bool IsNear();

  /**
   * Image of the absolute differences from that baseline times `factor`, after Compare(): array
   * `Color` (4 floats, alpha 1). A difference of alpha is added to every channel.
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
