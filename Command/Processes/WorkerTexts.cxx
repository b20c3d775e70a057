// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WorkerTexts.h"

#include "CommandError.h"
#include "Worker.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace penumbra
{

namespace
{

// A file in memory to which workers append records: number, size and bytes.
class SharedRecords
{
public:
  SharedRecords()
    : Descriptor(memfd_create("penumbra", MFD_CLOEXEC))
  {
    if (this->Descriptor < 0 || fcntl(this->Descriptor, F_SETFL, O_APPEND) < 0)
    {
      throw CommandError(Unavailable, std::string("cannot share memory: ") + strerror(errno));
    }
  }
  ~SharedRecords() { close(this->Descriptor); }
  SharedRecords(const SharedRecords&) = delete;
  void operator=(const SharedRecords&) = delete;

  // Appends a record by a single write, which other processes cannot interrupt.
  void Append(int number, const std::string& text) const
  {
    const std::size_t header[2] = { static_cast<std::size_t>(number), text.size() };
    std::string record(reinterpret_cast<const char*>(header), sizeof(header));
    record += text;
    if (write(this->Descriptor, record.data(), record.size()) !=
      static_cast<ssize_t>(record.size()))
    {
      throw CommandError(Unavailable, std::string("cannot share memory: ") + strerror(errno));
    }
  }

  void Read(std::vector<std::string>& texts) const
  {
    std::size_t header[2];
    off_t at = 0;
    while (pread(this->Descriptor, header, sizeof(header), at) == sizeof(header))
    {
      at += sizeof(header);
      std::string text(header[1], '\0');
      at += pread(this->Descriptor, &text[0], text.size(), at);
      texts.at(header[0]) = text;
    }
  }

private:
  const int Descriptor;
};

}

int RunForTexts(
  int count, int jobs, const std::function<std::string(int)>& task, std::vector<std::string>& texts)
{
  const SharedRecords records;
  const int status = RunWorkers(
    count, jobs,
    [&](int i) {
      records.Append(i, task(i));
      return static_cast<int>(Done);
    },
    [](int) {});
  texts.assign(count, std::string());
  records.Read(texts);
  return status;
}

}
