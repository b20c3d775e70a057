// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Peers.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace penumbra
{

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
  std::vector<Peer> peers = {
    { "POV-Ray", "povray", "aa", {} },
    { "Radiance", "rtrace", {}, {} },
    { "Mitsuba", "mitsuba", {}, {} },
    { "F3D", "f3d", {}, {} },
    { "MeshLab", "meshlabserver", {}, {} },
    { "Blender", "blender", {}, {} },
  };
  for (Peer& peer : peers)
  {
    peer.Path = FindProgram(peer.Program);
  }
  return peers;
}

std::string Describe(const Peer& peer)
{
  if (peer.Path.empty())
  {
    return peer.Name + ": left out, there is no " + peer.Program + " here";
  }
  return peer.Joins.empty() ? peer.Name + ": left out, scenes cannot be handed to it yet"
                            : peer.Name + ": " + peer.Path + ", joins " + peer.Joins;
}

}
