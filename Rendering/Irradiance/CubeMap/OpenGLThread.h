// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Worker thread that makes all OpenGL calls of a gatherer: an OpenGL context belongs to one thread,
// but gatherers are called by many.
#ifndef penumbra_OpenGLThread_h
#define penumbra_OpenGLThread_h

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace penumbra
{

class OpenGLThread
{
public:
  OpenGLThread()
    : Worker([this] { this->Loop(); })
  {
  }

  ~OpenGLThread()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Stopping = true;
    }
    this->Changed.notify_all();
    this->Worker.join();
  }

  OpenGLThread(const OpenGLThread&) = delete;
  void operator=(const OpenGLThread&) = delete;

  /// Runs `job` on the thread and waits for its end. Concurrent jobs run one after the other.
  /// Rethrows the exception of the job.
  void Run(const std::function<void()>& job)
  {
    const std::lock_guard<std::mutex> callerLock(this->CallerMutex);
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Thrown = nullptr;
    this->Job = &job;
    this->Changed.notify_all();
    this->Changed.wait(lock, [this] { return !this->Job; });
    if (this->Thrown)
    {
      std::rethrow_exception(this->Thrown);
    }
  }

private:
  void Loop()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    while (true)
    {
      this->Changed.wait(lock, [this] { return this->Job || this->Stopping; });
      if (!this->Job)
      {
        return;
      }
      try
      {
        (*this->Job)();
      }
      catch (...)
      {
        this->Thrown = std::current_exception();
      }
      this->Job = nullptr;
      this->Changed.notify_all();
    }
  }

  std::mutex CallerMutex; ///< held by the caller whose job runs
  std::mutex Mutex;
  std::condition_variable Changed;
  const std::function<void()>* Job = nullptr;
  std::exception_ptr Thrown;
  bool Stopping = false;
  std::thread Worker; ///< last member: it uses the others
};

}
#endif
