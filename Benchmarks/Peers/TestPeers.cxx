// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Files exchanged with peer programs, tested with a shell script instead of a real one.
#include "PointQueries.h"
#include "Surface.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

using namespace penumbra;

namespace
{

Peer StandIn(const TemporaryFolder& folder, const std::string& text)
{
  Peer peer;
  peer.Name = "Stand-in";
  peer.Path = "/bin/sh";
  peer.Script = folder.Path / "script";
  std::ofstream(peer.Script) << text;
  return peer;
}

TEST(Peers, ReceiveSceneInWorldCoordinates)
{
  Scene scene;
  scene.Origin = { 1.0, 2.0, 3.0 };
  scene.Scale = .5;
  Surface surface;
  surface.Positions = { { 0.f, 0.f, 0.f }, { 1.f, 0.f, 0.f }, { 0.f, 1.f, 0.f } };
  surface.Triangles = { { 0, 1, 2 } };
  surface.Front.DiffuseColor = { .8f, .6f, .4f };
  surface.Front.Ambient = 1.f;
  surface.Front.AmbientColor = { 5.f, 0.f, 0.f };
  scene.Surfaces.push_back(surface);
  PointQueryScene asked;
  asked.Drawn = &scene;
  asked.Albedo = .5;
  asked.Bounces = 3;
  asked.Sky = 2.0;
  asked.Questions = { { { 1.0, 2.0, 3.0 }, { 0.0, 0.0, 1.0 } } };

  const TemporaryFolder folder;
  const std::string file = folder.Path / "scene";
  WritePlaces(file, asked);
  const std::vector<double> expected = { 1.0, 1.0, 2.0, 3.0, // triangles, points, sky, reflections
    1.0, 2.0, 3.0, 3.0, 2.0, 3.0, 1.0, 4.0, 3.0,             // corners
    .4, .3, .2, 5.0, 0.0, 0.0,                               // reflectance, emission
    1.0, 2.0, 3.0, 0.0, 0.0, 1.0 };                          // the point
  std::vector<double> written(expected.size() + 1);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(written.data()),
    static_cast<std::streamsize>(written.size() * sizeof(double)));
  ASSERT_EQ(stream.gcount(), static_cast<std::streamsize>(expected.size() * sizeof(double)));
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(written[i], expected[i], 1e-7) << i;
  }
}

TEST(Peers, ReturnLightSecondsAndRays)
{
  const TemporaryFolder folder;
  const Peer peer = StandIn(folder,
    "test \"$2\" = '-aa .1 -ad 64' || exit 3\n"
    "head -c 24 /dev/zero >\"$3\"\necho a warning\necho\necho 1.5 64\necho\n");
  const PointQueryResult answer = RunPlaces(peer, folder.Path / "scene", "-aa .1 -ad 64", 2);
  ASSERT_EQ(answer.Light.size(), 2u);
  EXPECT_EQ(answer.Light[1], glm::dvec3(0.0));
  EXPECT_EQ(answer.Seconds, 1.5);
  EXPECT_EQ(answer.RaysPerPlace, 64.0);
  // Fewer results than points.
  EXPECT_THROW(RunPlaces(peer, folder.Path / "scene", "-aa .1 -ad 64", 3), std::runtime_error);
}

TEST(Peers, ReportCauseOfFailure)
{
  const TemporaryFolder folder;
  const Peer peer = StandIn(folder, "echo out of luck >&2\nexit 1\n");
  try
  {
    RunPlaces(peer, folder.Path / "scene", "1", 1);
    FAIL() << "no exception";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "Stand-in failed: out of luck");
  }
}

TEST(Peers, DescribeMissingPrograms)
{
  Peer peer;
  peer.Name = "Radiance";
  peer.Program = "RADIANCE_PYTHON";
  peer.Script = "radiance_points.py";
  EXPECT_EQ(Describe(peer),
    "Radiance: skipped, no Python provides it; set RADIANCE_PYTHON to one that does");
}

}
