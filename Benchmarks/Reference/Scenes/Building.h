// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A building of many furnished rooms with doorways. From a point in one room, most of the others
// are hidden.
#ifndef penumbra_Building_h
#define penumbra_Building_h

#include "Scene.h"

namespace penumbra
{

/// Width and depth of a room, and its height.
constexpr float RoomSize = 4.f;
constexpr float RoomHeight = 3.f;

/// Builds `storeys` of `along` x `along` rooms from the origin upwards, each with a table and three
/// spheres.
void AddBuilding(Scene& scene, int along, int storeys);

}
#endif
