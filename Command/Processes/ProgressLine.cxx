// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressLine.h"

#include "MessageLog.h"

#include <algorithm>

#include <unistd.h>

namespace penumbra
{

namespace
{

constexpr int Cells = 40;

void Print(const std::string& text)
{
  [[maybe_unused]] const auto written = write(TerminalDescriptor(), text.data(), text.size());
}

}

ProgressLine::ProgressLine(const std::string& style)
  : Bar(style == "bar" || (style == "auto" && isatty(TerminalDescriptor()))),
    Plain(style == "plain")
{
}

ProgressLine::~ProgressLine()
{
  this->Clear();
}

void ProgressLine::Show(const std::string& phase, double fraction)
{
  if (!this->Bar && !this->Plain)
  {
    return;
  }
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int percent =
    static_cast<int>(fraction * 100.0) / (this->Plain ? 10 : 1) * (this->Plain ? 10 : 1);
  std::string line = phase + " " + std::to_string(percent) + " %";
  if (this->Bar)
  {
    const int full = static_cast<int>(fraction * Cells);
    line = "[" + std::string(full, '#') + std::string(Cells - full, '.') + "] " + line;
  }
  if (line == this->Last)
  {
    return;
  }
  this->Last = line;
  this->Drawn = this->Bar;
  Print(this->Bar ? "\r\033[K" + line : line + "\n");
}

void ProgressLine::Clear()
{
  if (this->Drawn)
  {
    Print("\r\033[K");
    this->Drawn = false;
  }
}

}
