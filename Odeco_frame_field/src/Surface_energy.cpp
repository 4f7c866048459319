// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Odeco_frame_field/internal/Surface_energy.h>

namespace Quadrille {
namespace internal {

template class Triangle_energy<Surface_energy<3>, Surface_elements<3>, Surface_energy_rows<3>::count>;
template class Triangle_energy<Surface_smoothness<3>, Surface_elements<3>, surface_smoothness_rows>;
template class Triangle_energy<Surface_energy<5>, Surface_elements<5>, Surface_energy_rows<5>::count>;
template class Triangle_energy<Surface_smoothness<5>, Surface_elements<5>, surface_smoothness_rows>;

} // namespace internal
} // namespace Quadrille
