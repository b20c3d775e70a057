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
  std::string Program;               ///< or, with a script, the variable that names its Python
  std::string Joins;                 ///< families of charts; empty: there is no bridge to it yet
  std::string Script;                ///< of Benchmarks/peers, that drives it; empty: no script does
  std::vector<std::string> Settings; ///< of the script, from coarse to fine
  std::string Path;                  ///< of the program or Python here; empty: it is not installed
  std::string Version;
};

/// All, in the order in which they are told of.
std::vector<Peer> FindPeers();

/// What becomes of a peer, in one line.
std::string Describe(const Peer& peer);

/// The program of a peer that is here; empty: it is not.
std::string FindProgram(const std::string& name);

}
#endif
