// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPlaces.h"

#include "TemporaryFolder.h"

namespace penumbra
{

namespace
{

Measurement Ask(const PlacesSteps& steps, const Peer& peer, const std::string& setting)
{
  const LitPlaces asked = steps.Prepare(peer);
  const TemporaryFolder folder;
  const std::string file = folder.Path / "scene";
  WritePlaces(file, asked);
  const PlacesAnswer answer = RunPlaces(peer, file, setting, asked.Questions.size());
  return { steps.Error(asked, answer.Light), answer.Seconds / asked.Share, answer.RaysPerPlace };
}

}

void AddPeers(ChartFamily& family, const std::vector<Peer>& peers, const PlacesSteps& steps)
{
  for (const Peer& peer : peers)
  {
    if (peer.Path.empty() || peer.Joins != family.Name)
    {
      continue;
    }
    for (const std::string& setting : steps.Lamps ? peer.LightSettings : peer.Settings)
    {
      family.Steps.push_back(
        { steps.Scene, peer.Name, setting, 0.0, [=] { return Ask(steps, peer, setting); } });
    }
  }
}

}
