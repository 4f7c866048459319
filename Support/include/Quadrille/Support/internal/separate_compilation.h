// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SUPPORT_INTERNAL_SEPARATE_COMPILATION_H
#define QUADRILLE_SUPPORT_INTERNAL_SEPARATE_COMPILATION_H

/// \file
/// Packages are header-only. Large functions that are no templates are declared in one header and defined in another,
/// which comes along unless QUADRILLE_SEPARATE_COMPILATION is defined; then the sources in the packages' folders `src`
/// define them once for all. Our own executables are built so, in less time.
#ifdef QUADRILLE_SEPARATE_COMPILATION
#define QUADRILLE_INLINE
#else
#define QUADRILLE_INLINE inline
#endif

#endif
