// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A thread that alone talks to OpenGL: gatherers are asked by many threads, but a context belongs to one.
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

  /// Runs `job` on the thread, jobs of others before or after it, and waits for it. Throws what it threw.
  void Run(const std::function<void()>& job)
  {
    const std::lock_guard<std::mutex> turn(this->CallerMutex);
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

  std::mutex CallerMutex; ///< held while a job is run for somebody
  std::mutex Mutex;
  std::condition_variable Changed;
  const std::function<void()>* Job = nullptr;
  std::exception_ptr Thrown;
  bool Stopping = false;
  std::thread Worker; ///< last: it uses the others
};

}
#endif
