// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Programs of others that `penumbra chart` looks for, and which of them join.
#ifndef penumbra_Peers_h
#define penumbra_Peers_h

#include <string>
#include <vector>

namespace penumbra
{

struct Peer
{
  std::string Name;
  std::string Program; ///< or, with a script, the variable that names its Python
  std::string Joins;   ///< the family of charts
  std::string Script;  ///< of Benchmarks/Peers/scripts, that drives it; empty: no script does
  std::vector<std::string> Settings;      ///< of the script, from coarse to fine
  std::vector<std::string> LightSettings; ///< where there are lamps; empty: it knows none
  std::string Path; ///< of the program or Python here; empty: it is not installed
  std::string Version;
  bool HasCache = false; ///< places are not asked one by one
};

/// What a peer's script wrote and said.
struct ScriptAnswer
{
  std::vector<float> Values;
  double Seconds = 0.0; ///< CPU seconds, as the script measures them
  double Count = 0.0;   ///< rays or samples for each thing that was asked
};

/// Hands `scene`, a file, to the peer's script. Throws std::runtime_error where that does not answer with so
/// many values.
ScriptAnswer RunScript(
  const Peer& peer, const std::string& scene, const std::string& setting, std::size_t values);

/// All, in the order in which they are told of.
std::vector<Peer> FindPeers();

/// What becomes of a peer, in one line.
std::string Describe(const Peer& peer);

/// The program of a peer that is here; empty: it is not.
std::string FindProgram(const std::string& name);

}
#endif
