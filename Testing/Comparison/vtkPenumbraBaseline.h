// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBaseline
 * @brief   Regression test of an image against its baselines on disk.
 *
 * Renders the image and compares it with `name.png` and, if they exist, `name_1.png`, `name_2.png`
 * and so on. The test passes if the image is near any of them. Otherwise, the image and its
 * difference from the nearest baseline are written. GetReport() then returns the measured
 * differences, the paths of these files, the renderer, driver and processor, and how to accept the
 * image.
 *
 * The image is compared as the baseline's file format stores it: .png with 8 or 16 bits, .vti with
 * floats.
 *
 * Environment variables, read by Check():
 * - `PENUMBRA_ACCEPT`: `replace` makes an image that is not near the baseline, `add` makes it an
 *   additional baseline;
 * - `PENUMBRA_FAILED_IMAGES`: the folder for failed images, unless SetOutputFolder() is called.
 *
 * PenumbraGoogleTest.h provides GoogleTest assertions that use this class.
 */
#ifndef vtkPenumbraBaseline_h
#define vtkPenumbraBaseline_h

#include "vtkObject.h"
#include "vtkPenumbraTestingComparisonModule.h" // for export macro

#include <memory> // for std::unique_ptr

class vtkPenumbraImageComparison;

class VTKPENUMBRATESTINGCOMPARISON_EXPORT vtkPenumbraBaseline : public vtkObject
{
public:
  static vtkPenumbraBaseline* New();
  vtkTypeMacro(vtkPenumbraBaseline, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Render windows that are created later with OSMesa, whose images depend neither on a display nor
   * on a graphics card, unless the environment variable VTK_DEFAULT_OPENGL_WINDOW is set already.
   * VTK supports that variable since 9.4.
   */
  static void PreferOSMesa();

  /**
   * Object that provides the image: a vtkRenderWindow, a vtkImageData, or a vtkAlgorithm whose
   * first output is one, such as vtkPenumbraRayCaster. A window is rendered off screen at 72 dots
   * per inch. Default: none.
   */
  virtual void SetImage(vtkObject* object);
  vtkObject* GetImage();

  ///@{
  /** Path of the baseline, .png or .vti. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /** Prefix of the names of failed images, such as the name of a test. Default: none. */
  vtkSetStringMacro(Name);
  vtkGetStringMacro(Name);
  ///@}

  ///@{
  /**
   * Folder for failed images. Default: $PENUMBRA_FAILED_IMAGES, else the folder `failed-images`.
   */
  vtkSetFilePathMacro(OutputFolder);
  vtkGetFilePathMacro(OutputFolder);
  ///@}

  /** The comparison, on which tolerance, limits and mask are set. */
  vtkPenumbraImageComparison* GetComparison();

  /** Renders and compares. Returns true if the image is near a baseline or has been accepted. */
  bool Check();

  /** Result of the last Check() as text; empty if the image is near a baseline. */
  const char* GetReport();

protected:
  vtkPenumbraBaseline();
  ~vtkPenumbraBaseline() override;

private:
  vtkPenumbraBaseline(const vtkPenumbraBaseline&) = delete;
  void operator=(const vtkPenumbraBaseline&) = delete;

  bool Compare();
  bool Accept(bool add);
  void KeepEvidence();

  struct Internals;
  std::unique_ptr<Internals> Implementation;
  char* FileName = nullptr;
  char* Name = nullptr;
  char* OutputFolder = nullptr;
};

#endif
