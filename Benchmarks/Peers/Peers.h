// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The peer programs that `penumbra chart` searches for.
#ifndef penumbra_Peers_h
#define penumbra_Peers_h

#include <string>
#include <vector>

namespace penumbra
{

struct Peer
{
  std::string Name;
  std::string Program; ///< executable; with a script, the environment variable of its Python
  std::string Joins;   ///< family of charts in which the peer is used
  std::string Script;  ///< file in Benchmarks/Peers/scripts; empty: no script is required
  std::vector<std::string> Settings;      ///< arguments of the script, from coarse to fine
  std::vector<std::string> LightSettings; ///< for scenes with area lights; empty: not supported
  std::string Path;                       ///< of the program or of Python; empty: not installed
  std::string Version;
  bool HasCache = false; ///< points are not evaluated independently
};

/// Values written by a peer's script, with its CPU time and count.
struct ScriptAnswer
{
  std::vector<float> Values;
  double Seconds = 0.0; ///< CPU seconds, as the script measures them
  double Count = 0.0;   ///< rays or samples per pixel or point
};

/// Passes `scene`, a file, to the peer's script. Throws std::runtime_error if the script does not
/// return the given number of values.
ScriptAnswer RunScript(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t values);

/// All peers, in the order in which they are listed.
std::vector<Peer> FindPeers();

/// Describes in one line whether and how a peer is used.
std::string Describe(const Peer& peer);

/// Path of the peer's program; empty if it is not installed.
std::string FindProgram(const std::string& name);

}
#endif
