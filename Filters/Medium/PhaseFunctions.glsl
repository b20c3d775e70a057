// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Phase functions per steradian, of the cosine of the scattering angle. C++ and GLSL compile this
// file; NUMBER is double or float, FUNCTION their declaration of functions.

FUNCTION isotropicPhase()
{
  return 1.0 / 12.566370614359172;
}

FUNCTION rayleighPhase(NUMBER cosine)
{
  return 0.75 * (1.0 + cosine * cosine) / 12.566370614359172;
}

// Henyey and Greenstein; g is the mean cosine.
FUNCTION henyeyGreensteinPhase(NUMBER cosine, NUMBER g)
{
  NUMBER root = sqrt(max(1.0 + g * g - 2.0 * g * cosine, 1e-12));
  return (1.0 - g * g) / (12.566370614359172 * root * root * root);
}

// `phase`: as vtkPenumbraMedium::Phases.
FUNCTION phaseFunctionOf(int phase, NUMBER cosine, NUMBER g)
{
  return phase == 1 ? rayleighPhase(cosine)
    : phase == 2    ? henyeyGreensteinPhase(cosine, g)
                    : isotropicPhase();
}
