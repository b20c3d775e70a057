// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Peers.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace penumbra
{

namespace
{

/// Returns the last nonempty line.
std::string LastLine(std::istream& lines)
{
  std::string last;
  for (std::string line; std::getline(lines, line);)
  {
    last = line.empty() ? last : line;
  }
  return last;
}

/// Returns the last line of a command's output, or an empty string if the command fails.
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
  return LastLine(lines);
}

/// Finds a program by its name, or a script's Python by its environment variable if it has the
/// required packages.
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
  // -ar: no minimum distance between records. -ds: sampling of area lights; the default causes
  // visible steps.
  const std::vector<std::string> occlusion = { "-aa .2 -ad 256 -as 0 -ar 4000",
    "-aa .15 -ad 1024 -as 0 -ar 4000", "-aa .1 -ad 1024 -as 0 -ar 10000",
    "-aa .07 -ad 1024 -as 0 -ar 10000", "-aa .05 -ad 4096 -as 0 -ar 10000" };
  const std::vector<std::string> light = { "-aa .4 -ad 128 -as 0 -ar 32 -ds .1",
    "-aa .3 -ad 256 -as 0 -ar 32 -ds .06", "-aa .25 -ad 256 -as 0 -ar 32 -ds .06",
    "-aa .25 -ad 256 -as 0 -ar 32 -ds .05", "-aa .2 -ad 256 -as 0 -ar 32 -ds .04" };
  std::vector<Peer> peers = {
    { "POV-Ray", "povray", "aa", {}, {}, {}, {}, {} },
    { "Radiance", "RADIANCE_PYTHON", "irradiance", "radiance_points.py", occlusion, light, {}, {},
      true },
    { "Mitsuba", "MITSUBA_PYTHON", "aa", "mitsuba_images.py", samples, {}, {}, {} },
    { "F3D", "F3D_PYTHON", "aa", "f3d_images.py", { "none", "fxaa", "ssaa" }, {}, {}, {} },
    { "MeshLab", "MESHLAB_PYTHON", "irradiance", "meshlab_points.py", { "64", "256", "1024" }, {},
      {}, {} },
    { "Blender", "BLENDER_PYTHON", "aa", "blender_images.py", samples, {}, {}, {} },
  };
  for (Peer& peer : peers)
  {
    Find(peer);
  }
  // The program prints its version to stderr, among other lines.
  peers.front().Version = LastLineOf("povray --version 2>&1 | sed -n 's/^POV-Ray //p'");
  return peers;
}

std::string Describe(const Peer& peer)
{
  if (peer.Path.empty())
  {
    return peer.Name + ": skipped, " +
      (peer.Script.empty() ? peer.Program + " is not installed"
                           : "no Python provides it; set " + peer.Program + " to one that does");
  }
  return peer.Name + " " + peer.Version + ": " + peer.Path + ", used by family " + peer.Joins;
}

ScriptAnswer RunScript(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t values)
{
  const std::string output = scene + ".raw";
  const std::string log = scene + ".log";
  const std::string command = "'" + peer.Path + "' '" + peer.Script + "' '" + scene + "' '" +
    setting + "' '" + output + "' >'" + log + "' 2>&1";
  if (std::system(command.c_str()) != 0)
  {
    std::ifstream text(log);
    throw std::runtime_error(peer.Name + " failed: " + LastLine(text));
  }
  ScriptAnswer answer;
  std::ifstream text(log);
  std::istringstream(LastLine(text)) >> answer.Seconds >> answer.Count;
  answer.Values.resize(values);
  std::ifstream file(output, std::ios::binary);
  file.read(reinterpret_cast<char*>(answer.Values.data()),
    static_cast<std::streamsize>(values * sizeof(float)));
  if (!file || !(answer.Count > 0.0))
  {
    throw std::runtime_error(peer.Name + " did not write " + output);
  }
  return answer;
}

}
