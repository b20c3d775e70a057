// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Binary STL files with more or fewer bytes than their headers declare.
#include "Program.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

using namespace penumbra_testing;

namespace
{

/// `count` triangles; the header declares another number.
std::string BinaryStl(int count, std::uint32_t declared)
{
  std::string bytes(84, '\0');
  std::memcpy(&bytes[80], &declared, sizeof(declared));
  for (int i = 0; i < count; ++i)
  {
    const float x = static_cast<float>(i);
    const float values[] = { 0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0 };
    bytes.append(reinterpret_cast<const char*>(values), sizeof(values)).append(2, '\0');
  }
  return bytes;
}

struct Row
{
  const char* Name;
  std::string Bytes;
  int Status;
  const char* Message; ///< empty: none
};

TEST(BinaryStl, BytesThatDoNotFitTheHeaderAreReported)
{
  const Row rows[] = {
    { "exact", BinaryStl(4, 4), 0, "" },
    { "undeclared", BinaryStl(4, 0), 0, "" },
    { "padded", BinaryStl(4, 4) + std::string(99, '\0') + "\r\n", 0, "" },
    { "more", BinaryStl(4, 1), 0,
      "the number of triangles in its header is 1; the 150 bytes after them, as many as "
      "3 triangles have, were skipped" },
    { "joined", BinaryStl(2, 2) + BinaryStl(2, 2), 0,
      "the number of triangles in its header is 2; the 184 bytes after them, as many as "
      "3 triangles have, were skipped" },
    { "text", BinaryStl(4, 4) + "end", 0,
      "the number of triangles in its header is 4; the 3 bytes after them, as many as "
      "0 triangles have, were skipped" },
    { "part", BinaryStl(4, 0).substr(0, 84 + 190), 0,
      "it ends within a triangle, whose 40 bytes were skipped" },
    { "fewer", BinaryStl(4, 9), 2, "the file is damaged: it has 4 of the 9 triangles" },
    { "cut", BinaryStl(4, 4).substr(0, 84 + 199), 2,
      "the file is damaged: it has 3 of the 4 triangles" },
  };
  const Folder folder("stl-bytes");
  for (const Row& row : rows)
  {
    const std::string path = folder / row.Name + ".stl";
    WriteText(path, row.Bytes);
    const ProgramResult outcome =
      RunProgram({ "render", path, "--output", folder / "a.png", "--resolution", "8,8" });
    EXPECT_EQ(outcome.Status, row.Status) << row.Name;
    EXPECT_EQ(CountLines(outcome.Errors), *row.Message ? 1 : 0) << outcome.Errors;
    EXPECT_NE(outcome.Errors.find(row.Message), std::string::npos) << row.Message << " in\n"
                                                                   << outcome.Errors;
  }
}

}
