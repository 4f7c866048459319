// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include <Quadrille/Odeco_frame_field/internal/Field_energy.h>

namespace Quadrille {
namespace internal {

template class Triangle_energy<Field_energy<3, Field_energy_kind::smoothness>, Field_elements<3>,
                               Field_energy_rows<3, Field_energy_kind::smoothness>::count>;
template class Triangle_energy<Field_energy<3, Field_energy_kind::integrability>, Field_elements<3>,
                               Field_energy_rows<3, Field_energy_kind::integrability>::count>;
template class Triangle_energy<Field_energy<5, Field_energy_kind::smoothness>, Field_elements<5>,
                               Field_energy_rows<5, Field_energy_kind::smoothness>::count>;
template class Triangle_energy<Field_energy<5, Field_energy_kind::integrability>, Field_elements<5>,
                               Field_energy_rows<5, Field_energy_kind::integrability>::count>;

} // namespace internal
} // namespace Quadrille
