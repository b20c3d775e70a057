// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ForkedRanks.h"

#include "vtkAbstractArray.h"
#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace penumbra
{
namespace
{

bool WriteAll(int file, const void* bytes, std::size_t size)
{
  const auto* from = static_cast<const char*>(bytes);
  while (size > 0)
  {
    const ssize_t written = write(file, from, size);
    if (written <= 0)
    {
      return false;
    }
    from += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool ReadAll(int file, void* bytes, std::size_t size)
{
  auto* to = static_cast<char*>(bytes);
  while (size > 0)
  {
    const ssize_t count = read(file, to, size);
    if (count <= 0)
    {
      return false;
    }
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// Sends arrays over one socket for each other rank, in order.
class SocketCommunicator : public vtkCommunicator
{
public:
  static SocketCommunicator* New();
  vtkTypeMacro(SocketCommunicator, vtkCommunicator);

  void Connect(int rank, const std::vector<int>& sockets)
  {
    this->LocalProcessId = rank;
    this->NumberOfProcesses = this->MaximumNumberOfProcesses = static_cast<int>(sockets.size());
    this->Sockets = sockets;
  }

  int SendVoidArray(const void* data, vtkIdType length, int type, int rank, int) override
  {
    const auto size = static_cast<std::uint64_t>(length) * vtkAbstractArray::GetDataTypeSize(type);
    return WriteAll(this->Sockets[rank], &size, sizeof size) &&
      WriteAll(this->Sockets[rank], data, size);
  }

  int ReceiveVoidArray(void* data, vtkIdType, int type, int rank, int) override
  {
    std::uint64_t size = 0;
    const bool isRead =
      ReadAll(this->Sockets[rank], &size, sizeof size) && ReadAll(this->Sockets[rank], data, size);
    this->Count = static_cast<vtkIdType>(size / vtkAbstractArray::GetDataTypeSize(type));
    return isRead;
  }

private:
  std::vector<int> Sockets;
};

vtkStandardNewMacro(SocketCommunicator);

/// Runs the function in a new process, and ends the process.
void RunRank(int rank, const std::vector<int>& sockets, const std::function<std::string(int)>& work,
  unsigned int seconds, int output)
{
  alarm(seconds);
  vtkNew<SocketCommunicator> communicator;
  communicator->Connect(rank, sockets);
  vtkNew<vtkDummyController> controller;
  controller->SetCommunicator(communicator);
  controller->SetRMICommunicator(communicator);
  vtkMultiProcessController::SetGlobalController(controller);
  const std::string value = work(rank);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const long long peak = 1024LL * usage.ru_maxrss;
  const bool isWritten =
    WriteAll(output, &peak, sizeof peak) && WriteAll(output, value.data(), value.size());
  _exit(isWritten ? EXIT_SUCCESS : EXIT_FAILURE);
}

RankResult ReadResult(pid_t process, int input)
{
  RankResult result;
  const bool hasPeak = ReadAll(input, &result.PeakMemory, sizeof result.PeakMemory);
  char buffer[1 << 16];
  for (ssize_t count = 0; hasPeak && (count = read(input, buffer, sizeof buffer)) > 0;)
  {
    result.Value.append(buffer, static_cast<std::size_t>(count));
  }
  close(input);
  int status = 0;
  waitpid(process, &status, 0);
  result.HasReturned = hasPeak && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
  return result;
}

}

std::vector<RankResult> RunRanks(
  int count, const std::function<std::string(int)>& work, unsigned int seconds)
{
  // sockets[i][j] is the end at rank i of the connection with rank j.
  std::vector<std::vector<int>> sockets(count, std::vector<int>(count, -1));
  for (int i = 0; i < count; ++i)
  {
    for (int j = i + 1; j < count; ++j)
    {
      int ends[2];
      if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
      {
        throw std::runtime_error("The ranks cannot be connected.");
      }
      sockets[i][j] = ends[0];
      sockets[j][i] = ends[1];
    }
  }
  const auto closeSockets = [&](int except) {
    for (int i = 0; i < count; ++i)
    {
      for (int j = 0; i != except && j < count; ++j)
      {
        close(sockets[i][j]);
      }
    }
  };
  std::vector<pid_t> processes;
  std::vector<int> inputs;
  for (int rank = 0; rank < count; ++rank)
  {
    int ends[2];
    const pid_t process = pipe(ends) == 0 ? fork() : -1;
    if (process < 0)
    {
      throw std::runtime_error("A rank cannot be started.");
    }
    if (process == 0)
    {
      closeSockets(rank);
      RunRank(rank, sockets[rank], work, seconds, ends[1]);
    }
    close(ends[1]);
    processes.push_back(process);
    inputs.push_back(ends[0]);
  }
  closeSockets(-1);
  std::vector<RankResult> results;
  for (int rank = 0; rank < count; ++rank)
  {
    results.push_back(ReadResult(processes[rank], inputs[rank]));
  }
  return results;
}

}
