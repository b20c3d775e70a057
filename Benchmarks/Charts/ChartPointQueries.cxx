// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartPointQueries.h"

#include "TemporaryFolder.h"

namespace penumbra
{

namespace
{

Measurement Ask(const PointQuerySteps& steps, const Peer& peer, const std::string& setting)
{
  const PointQueryScene asked = steps.Prepare(peer);
  const TemporaryFolder folder;
  const std::string file = folder.Path / "scene";
  WritePlaces(file, asked);
  const PointQueryResult answer = RunPlaces(peer, file, setting, asked.Questions.size());
  return { steps.Error(asked, answer.Light), answer.Seconds / asked.Share, answer.RaysPerPlace };
}

}

void AddPeers(ChartFamily& family, const std::vector<Peer>& peers, const PointQuerySteps& steps)
{
  for (const Peer& peer : peers)
  {
    if (peer.Path.empty() || peer.Joins != family.Name)
    {
      continue;
    }
    for (const std::string& setting : steps.Emitters ? peer.LightSettings : peer.Settings)
    {
      family.Steps.push_back(
        { steps.Scene, peer.Name, setting, 0.0, [=] { return Ask(steps, peer, setting); } });
    }
  }
}

}
