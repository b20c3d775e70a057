// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPenumbraBaseline
 * @brief   A regression test of a picture against its baselines on disk.
 *
 * Draws the picture, compares it with `name.png` and, where these exist, `name_1.png`, `name_2.png`
 * and so on; any of them will do. Where it is near none, the picture and its difference from the
 * nearest are written, and GetReport() tells what is wrong, where these pictures are, which renderer,
 * driver and processor drew them, and how to accept them.
 *
 * What is drawn is compared as the file of the baseline holds it: .png 8 or 16 bits, .vti floats.
 *
 * Environment, read by Check():
 * - `PENUMBRA_ACCEPT=replace` a picture that is not near becomes the baseline; `add`: another of its
 *   baselines;
 * - `PENUMBRA_FAILED_IMAGES` the folder of what failed, unless SetOutputFolder() names one.
 *
 * PenumbraGoogleTest.h makes one line of it.
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
   * From now on windows are drawn by OSMesa, whose pictures depend neither on a display nor on a
   * graphics card, unless the environment variable VTK_DEFAULT_OPENGL_WINDOW says otherwise. VTK knows
   * that variable from 9.4 on.
   */
  static void PreferOSMesa();

  /**
   * Who draws: a vtkRenderWindow, a vtkImageData, or a vtkAlgorithm whose first output is one, such as
   * vtkPenumbraRayCaster. A window is drawn off screen at 72 dots per inch. Default: none.
   */
  virtual void SetPicture(vtkObject* picture);
  vtkObject* GetPicture();

  ///@{
  /** The baseline, .png or .vti. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /** What the names of failed pictures begin with, such as a test's name. Default: none. */
  vtkSetStringMacro(Name);
  vtkGetStringMacro(Name);
  ///@}

  ///@{
  /** Where failed pictures go. Default: $PENUMBRA_FAILED_IMAGES, else the folder `failed-images`. */
  vtkSetFilePathMacro(OutputFolder);
  vtkGetFilePathMacro(OutputFolder);
  ///@}

  /** What near means: tolerance, limits and mask are set here. */
  vtkPenumbraImageComparison* GetComparison();

  /** Is the picture near a baseline, or has it been accepted? */
  bool Check();

  /** What Check() found, in sentences; empty where there is nothing to tell. */
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
