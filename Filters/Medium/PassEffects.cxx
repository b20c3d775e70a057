// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PassEffects.h"

namespace penumbra
{

// Here, so that all libraries share the type, which dynamic_cast compares.
PassEffects::~PassEffects() = default;

}
