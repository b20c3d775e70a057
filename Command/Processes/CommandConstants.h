// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Defaults and internal limits of the program. Where Documentation/user/Options.md states a
// value, change it there, too. Afterwards run TestRender, TestBadInput, TestFiles and TestAnimate.
#ifndef penumbra_CommandConstants_h
#define penumbra_CommandConstants_h

#include <ios>

namespace penumbra
{

// --- Defaults (Options.md) ---

/// Radius of ambient occlusion, as a fraction of the diagonal of the bounds.
constexpr double DefaultRadiusFraction = 0.1;

/// Strength of ambient occlusion on surfaces colored by data, below 1 because the darkening changes
/// the colors that are read.
constexpr double StrengthOnData = 0.6;

/// Requested samples per pixel of OpenGL images; the driver may provide fewer.
constexpr int MultiSamples = 8;

// --- Animations ---

/// Number of successive frames that one process renders. It is fixed, because the images depend on
/// it.
constexpr int FramesPerGroup = 8;

/// Images per second of an animation inside of a file, which has no time steps of its own.
constexpr unsigned int AnimationFrameRate = 30;

/// Number of frames of an orbit and of moving parts.
constexpr int DefaultFrames = 60;

/// Largest number of frames of an animation.
constexpr int MaximumFrames = 1000000;

// --- Text ---

/// Significant digits of times in file names, in messages and on images, if they are distinct.
constexpr int TimeDigits = 6;

/// Font size of labels and their distance from the corner of the image, in points of 1/72 inch.
constexpr int LabelPoints = 18;
constexpr double LabelMargin = 9.0;

// --- Cameras ---

/// Smallest distance from the camera to its focal point as a fraction of the scene's radius:
/// shorter ones lose their direction to rounding.
constexpr double MinimumDistanceFraction = 1e-12;

// --- Limits on memory and time ---

/// Bytes per pixel of an image while it is rendered. Images that need more than the memory of the
/// machine are refused.
constexpr double BytesPerPixel = 32.0;

/// Seconds to read an empty file; one second per MiB is added.
constexpr double BaseSeconds = 60.0;

/// Memory in bytes to read an empty file, and the bytes that each byte of a file adds: zlib
/// compresses up to 1032:1.
constexpr unsigned long long BaseMemory = 1ull << 30;
constexpr unsigned long long MemoryPerFileByte = 64;
constexpr unsigned long long MemoryPerCompressedFileByte = 2200;

/// Number of bytes that are searched for references to other files. Files that refer to others have
/// short text headers.
constexpr std::streamsize MaximumHeaderSize = 1 << 20;

}
#endif
