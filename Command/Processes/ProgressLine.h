// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Progress on stderr.
#ifndef penumbra_ProgressLine_h
#define penumbra_ProgressLine_h

#include <string>

namespace penumbra
{

class ProgressLine
{
public:
  /// `style`: auto (a bar on a terminal, else nothing), bar, plain (one line per 10 %) or none.
  explicit ProgressLine(const std::string& style);
  ~ProgressLine();

  ProgressLine(const ProgressLine&) = delete;
  void operator=(const ProgressLine&) = delete;

  void Show(const std::string& phase, double fraction);

  /// Erases the bar. Call before printing a message.
  void Clear();

private:
  bool Bar = false;
  bool Plain = false;
  bool Drawn = false;
  std::string Last;
};

}
#endif
