// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Peers.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace penumbra
{

namespace
{

/// The last line but for empty ones that a command prints; empty where it fails.
std::string LastLineOf(const std::string& command)
{
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  for (int byte = pipe ? fgetc(pipe) : EOF; byte != EOF; byte = fgetc(pipe))
  {
    text += static_cast<char>(byte);
  }
  if (!pipe || pclose(pipe) != 0)
  {
    return {};
  }
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
  {
    last = line.empty() ? last : line;
  }
  return last;
}

/// A program by its name; a script's Python by the variable that names it, if it has what the script needs.
void Find(Peer& peer)
{
  if (peer.Script.empty())
  {
    peer.Path = FindProgram(peer.Program);
    return;
  }
  peer.Script = std::string(PENUMBRA_PEERS_FOLDER "/") + peer.Script;
  const char* named = std::getenv(peer.Program.c_str());
  const std::string python = named ? named : FindProgram("python3");
  peer.Version = LastLineOf("'" + python + "' '" + peer.Script + "' 2>/dev/null");
  peer.Path = peer.Version.empty() ? "" : python;
}

}

std::string FindProgram(const std::string& name)
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    const std::string program = folder + "/" + name;
    if (access(program.c_str(), X_OK) == 0)
    {
      return program;
    }
  }
  return {};
}

std::vector<Peer> FindPeers()
{
  const std::vector<std::string> samples = { "1", "4", "16", "64", "256" };
  std::vector<Peer> peers = {
    { "POV-Ray", "povray", "aa", {}, {}, {}, {} },
    { "Radiance", "rtrace", {}, {}, {}, {}, {} },
    { "Mitsuba", "MITSUBA_PYTHON", "aa", "mitsuba_faces.py", samples, {}, {} },
    { "F3D", "F3D_PYTHON", "aa", "f3d_faces.py", { "none", "fxaa", "ssaa" }, {}, {} },
    { "MeshLab", "meshlabserver", {}, {}, {}, {}, {} },
    { "Blender", "BLENDER_PYTHON", "aa", "blender_faces.py", samples, {}, {} },
  };
  for (Peer& peer : peers)
  {
    Find(peer);
  }
  // It prints its version among others to the channel of errors.
  peers.front().Version = LastLineOf("povray --version 2>&1 | sed -n 's/^POV-Ray //p'");
  return peers;
}

std::string Describe(const Peer& peer)
{
  if (peer.Path.empty())
  {
    return peer.Name + ": left out, there is no " +
      (peer.Script.empty() ? peer.Program + " here"
                           : "Python with it; " + peer.Program + " names one");
  }
  return peer.Joins.empty()
    ? peer.Name + ": left out, scenes cannot be handed to it yet"
    : peer.Name + " " + peer.Version + ": " + peer.Path + ", joins " + peer.Joins;
}

}
