// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Light/DirectionGuide.h"

#include "Shading/OwenSobolSequence.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace penumbra;

namespace
{

constexpr std::uint32_t FirstRays = 512;
constexpr std::uint32_t FurtherRays = 1u << 16;

/// Makes the guide of rays with values value(at).
template <typename ValueAt>
DirectionGuide MakeGuide(const ValueAt& value)
{
  const OwenSobolSequence sequence(1);
  DirectionGuide::Sums sums;
  for (std::uint32_t i = 0; i < FirstRays; ++i)
  {
    const glm::vec2 at = sequence.At(i);
    sums.Add(at, value(at));
  }
  return DirectionGuide(sums);
}

/// Mean and variance of weighted values along random rays.
struct Moments
{
  double Mean = 0.0;
  double Variance = 0.0;

  template <typename ValueAt>
  Moments(const DirectionGuide& guide, const ValueAt& value)
  {
    std::uint32_t random = 1;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < FurtherRays; ++i)
    {
      const float u = NextFloat(random);
      glm::vec2 at(u, NextFloat(random));
      const float weight = guide.Move(at);
      EXPECT_TRUE(at.x >= 0.f && at.x < 1.f && at.y >= 0.f && at.y < 1.f);
      const double product = weight * value(at);
      this->Mean += product / FurtherRays;
      squares += product * product / FurtherRays;
    }
    this->Variance = squares - this->Mean * this->Mean;
  }
};

/// The light of a small bright part of the hemisphere.
float SmallLight(glm::vec2 at)
{
  return at.x > .7f && at.y < .3f ? 2.f : 0.f;
}

/// Light with little contrast.
float GradualLight(glm::vec2 at)
{
  return 1.f + .2f * at.x;
}

}

TEST(DirectionGuide, KeepsTheMeanAndReducesTheVarianceOfASmallLight)
{
  const DirectionGuide guide = MakeGuide(SmallLight);
  const Moments guided(guide, SmallLight);
  const Moments uniform(DirectionGuide(), SmallLight);
  EXPECT_NEAR(guided.Mean, 2.0 * .3 * .3, 4.0 * std::sqrt(guided.Variance / FurtherRays));
  EXPECT_LT(guided.Variance, .4 * uniform.Variance);
}

TEST(DirectionGuide, BoundsTheVarianceOfLightThatItsRaysMissed)
{
  const DirectionGuide guide = MakeGuide(SmallLight);
  const auto missed = [](glm::vec2 at) { return SmallLight({ at.y, at.x }); };
  const Moments guided(guide, missed);
  const Moments uniform(DirectionGuide(), missed);
  EXPECT_NEAR(guided.Mean, 2.0 * .3 * .3, 4.0 * std::sqrt(guided.Variance / FurtherRays));
  EXPECT_LT(guided.Variance, 1.05 * (uniform.Variance + .18 * .18) / UnguidedFraction);
}

TEST(DirectionGuide, MovesNothingWithoutContrast)
{
  for (const DirectionGuide& guide :
    { DirectionGuide(), DirectionGuide(DirectionGuide::Sums()), MakeGuide(GradualLight) })
  {
    const OwenSobolSequence sequence(2);
    for (std::uint32_t i = 0; i < FirstRays; ++i)
    {
      const glm::vec2 at = sequence.At(i);
      glm::vec2 moved = at;
      EXPECT_NEAR(guide.Move(moved), 1.f, .01f);
      EXPECT_LT(glm::length(moved - at), .01f);
    }
  }
}
