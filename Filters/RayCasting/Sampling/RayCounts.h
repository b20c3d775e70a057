// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Counts of the rays of an image.
#ifndef penumbra_RayCounts_h
#define penumbra_RayCounts_h

namespace penumbra
{

/// Number of rays by purpose.
struct RayCounts
{
  long long Primary = 0;    ///< through pixel corners; with uniform sampling, all samples
  long long Refinement = 0; ///< inside pixels
  long long Auxiliary = 0;  ///< through pixel centers, for the geometry arrays
  long long Shadow = 0;
  long long Shaft = 0;      ///< shadow rays from points in the medium
  long long Occlusion = 0;  ///< traced by the irradiance provider for ambient occlusion
  long long Indirect = 0;   ///< traced by the irradiance provider for irradiance
  long long Rasterized = 0; ///< samples whose hits were found by rasterization, not by rays
  long long Repeated = 0;   ///< of corners at the border of a region, which other regions count

  long long GetImageRays() const { return this->Primary + this->Refinement; }
  long long GetTotal() const
  {
    return this->Primary + this->Refinement + this->Auxiliary + this->Shadow + this->Shaft +
      this->Occlusion + this->Indirect;
  }
  RayCounts& operator+=(const RayCounts& other)
  {
    this->Primary += other.Primary;
    this->Refinement += other.Refinement;
    this->Auxiliary += other.Auxiliary;
    this->Shadow += other.Shadow;
    this->Shaft += other.Shaft;
    this->Occlusion += other.Occlusion;
    this->Indirect += other.Indirect;
    this->Rasterized += other.Rasterized;
    this->Repeated += other.Repeated;
    return *this;
  }
};

}
#endif
