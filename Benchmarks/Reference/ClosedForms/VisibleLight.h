// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Visible fraction of a light with a size behind a half-plane or a disk, in closed form.
#ifndef penumbra_VisibleLight_h
#define penumbra_VisibleLight_h

namespace penumbra
{

/// Fraction of a unit disk at x > `offset`.
double DiskBeyondLine(double offset);

/// Area that two circles have in common.
double CommonAreaOfCircles(double radius, double otherRadius, double distance);

/// Fraction, in solid angle, of a cone of directions with half the opening angle `radius` that is
/// at an angle of less than 90 degrees to a pole. `angle` is between the pole and the axis. All
/// angles are in radians.
double ConeInHemisphere(double radius, double angle);

}
#endif
