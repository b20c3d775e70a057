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
  std::string Program;
  std::string Joins; ///< families of charts; empty: there is no bridge to it yet
  std::string Path;  ///< of the program here; empty: it is not installed
};

/// All, in the order in which they are told of.
std::vector<Peer> FindPeers();

/// What becomes of a peer, in one line.
std::string Describe(const Peer& peer);

/// The program of a peer that is here; empty: it is not.
std::string FindProgram(const std::string& name);

}
#endif
