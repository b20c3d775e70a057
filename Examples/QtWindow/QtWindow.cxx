// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A Qt window whose ambient occlusion refines while the view is static, and an image of the same scene by
// the ray caster, with a progress bar that cancels.
//
// With `--images FOLDER` the program waits until the window has converged, saves it and the image
// there, cancels a second image, and ends. The test uses this mode.
#include "vtkPenumbraRayCaster.h"
#include "vtkPenumbraTemporalSSAOPass.h"
#include "vtkPenumbraTracedEstimator.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkImageShiftScale.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

#include <QApplication>
#include <QFile>
#include <QFileDialog>
#include <QMainWindow>
#include <QProgressDialog>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QTimer>
#include <QToolBar>

#include <cmath>
#include <iostream>

namespace
{

void Add(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

void AddScene(vtkRenderer* renderer)
{
  for (int i = 0; i < 9; ++i)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(i % 3 - 1.0, i / 3 - 1.0, 0.5);
    sphere->SetThetaResolution(48);
    sphere->SetPhiResolution(32);
    Add(renderer, sphere);
  }
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-2.5, -2.5, 0.0);
  floor->SetPoint1(2.5, -2.5, 0.0);
  floor->SetPoint2(-2.5, 2.5, 0.0);
  Add(renderer, floor);
  renderer->SetBackground(0.3, 0.35, 0.4);
  renderer->GetActiveCamera()->SetPosition(0.5, -7.0, 3.5);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.4);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCameraClippingRange();
}

class Window : public QMainWindow
{
public:
  Window();

  /// Writes what the window shows.
  void SaveWindow(const QString& path);
  /// Ray casts the scene in the size of the window. Returns the estimated error; NaN if cancelled.
  double SaveImage(const QString& path);
  /// Saves an image, and cancels as soon as the dialog is shown. Returns whether no file was written.
  bool CancelImage(const QString& path);

  vtkPenumbraTemporalSSAOPass* Occlusion = nullptr;

private:
  void ShowOcclusion(bool on);
  void ShowState();
  static void OnProgress(vtkObject* caller, unsigned long, void* dialog, void*);

  vtkNew<vtkGenericOpenGLRenderWindow> RenderWindow;
  vtkNew<vtkRenderer> Renderer;
  QVTKOpenGLNativeWidget* View = nullptr;
};

Window::Window()
{
  AddScene(this->Renderer);
  this->RenderWindow->AddRenderer(this->Renderer);
  this->View = new QVTKOpenGLNativeWidget(this);
  this->View->setRenderWindow(this->RenderWindow);
  this->setCentralWidget(this->View);
  QToolBar* bar = this->addToolBar("Penumbra");
  QAction* occlusion = bar->addAction("Ambient occlusion");
  occlusion->setCheckable(true);
  connect(occlusion, &QAction::toggled, [this](bool on) { this->ShowOcclusion(on); });
  connect(bar->addAction("Save image..."), &QAction::triggered, [this]() {
    const QString path = QFileDialog::getSaveFileName(this, "Save image", "image.png", "*.png");
    if (!path.isEmpty())
    {
      this->SaveImage(path);
    }
  });
  // The pass requests frames through the interactor until it has converged; this only tells its state.
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, [this]() { this->ShowState(); });
  timer->start(200);
  occlusion->setChecked(true);
}

void Window::ShowOcclusion(bool on)
{
  if (on)
  {
    this->Occlusion = vtkPenumbraTemporalSSAOPass::AddTo(this->Renderer);
  }
  else
  {
    vtkPenumbraTemporalSSAOPass::RemoveFrom(this->Renderer);
    this->Occlusion = nullptr;
  }
  this->RenderWindow->Render();
}

void Window::ShowState()
{
  if (!this->Occlusion)
  {
    this->statusBar()->showMessage("No ambient occlusion");
    return;
  }
  this->statusBar()->showMessage(QString("Estimated error of ambient occlusion: %1%2")
                                   .arg(this->Occlusion->GetEstimatedError(), 0, 'g', 2)
                                   .arg(this->Occlusion->IsConverged() ? ", converged" : ""));
}

void Window::SaveWindow(const QString& path)
{
  this->View->grabFramebuffer().save(path);
}

// Events of the dialog are handled between parts of the work. It is modal, so that nothing else changes
// the scene meanwhile.
void Window::OnProgress(vtkObject* caller, unsigned long, void* dialog, void*)
{
  auto* caster = static_cast<vtkPenumbraRayCaster*>(caller);
  auto* self = static_cast<QProgressDialog*>(dialog);
  self->setValue(static_cast<int>(100.0 * caster->GetProgress()));
  if (self->wasCanceled())
  {
    caster->SetAbortExecute(1);
  }
}

double Window::SaveImage(const QString& path)
{
  QProgressDialog dialog("Ray casting", "Cancel", 0, 100, this);
  dialog.setWindowModality(Qt::WindowModal);
  dialog.setMinimumDuration(0);
  vtkNew<vtkPenumbraRayCaster> caster;
  caster->SetRenderer(this->Renderer);
  const int* size = this->RenderWindow->GetSize();
  caster->SetResolution(size[0], size[1]);
  caster->SetAmbientOcclusion(this->Occlusion != nullptr);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(Window::OnProgress);
  progress->SetClientData(&dialog);
  caster->AddObserver(vtkCommand::ProgressEvent, progress);
  caster->Update();
  // The dialog cannot say this: the last progress, 1, is sent after an abort, too, and resets the dialog.
  if (caster->GetAbortExecute())
  {
    return std::nan("");
  }
  vtkNew<vtkImageShiftScale> bytes;
  bytes->SetInputConnection(caster->GetOutputPort());
  bytes->SetScale(255.0);
  bytes->SetShift(0.5 / 255.0);
  bytes->SetOutputScalarTypeToUnsignedChar();
  bytes->ClampOverflowOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(bytes->GetOutputPort());
  writer->SetFileName(path.toUtf8().constData());
  writer->Write();
  return caster->GetEstimatedError();
}

bool Window::CancelImage(const QString& path)
{
  QTimer timer;
  connect(&timer, &QTimer::timeout, [this]() {
    auto* dialog = this->findChild<QProgressDialog*>();
    if (dialog && dialog->isVisible())
    {
      dialog->cancel();
    }
  });
  timer.start(0);
  return std::isnan(this->SaveImage(path)) && !QFile::exists(path);
}

}

int main(int argc, char* argv[])
{
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication application(argc, argv);
  vtkPenumbraTracedEstimator::Register(); // rays where they are better than the depth buffer
  Window window;
  window.resize(800, 600);
  window.show();
  const QStringList arguments = QApplication::arguments();
  QTimer poll;
  if (arguments.size() == 3 && arguments[1] == "--images")
  {
    QObject::connect(&poll, &QTimer::timeout, [&]() {
      if (window.Occlusion->IsConverged())
      {
        poll.stop();
        window.SaveWindow(arguments[2] + "/window.png");
        const double error = window.SaveImage(arguments[2] + "/image.png");
        const bool cancelled = window.CancelImage(arguments[2] + "/cancelled.png");
        std::cout << "window: error " << window.Occlusion->GetEstimatedError() << ", image: error "
                  << error << ", cancelled: " << (cancelled ? "no file" : "a file") << std::endl;
        QApplication::quit();
      }
    });
    poll.start(50);
  }
  return QApplication::exec();
}
