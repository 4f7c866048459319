// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// E_Lie of the exactly integrable fields around one singularity (planar-2, eq. (34)), interpolated linearly on finer
// and finer triangles of the square [-1, 1]^2: the energy converges, although the largest integrand H = |Lie|^2 / a^2
// grows like 1 / h^2. Arguments: valence, cells along a side. Counters: triangles, h (side of a cell), energy,
// largest_H, and near_energy, the share of the triangles around the singularity out to a distance of 3 h.

#include <Quadrille/Odeco_frame_field/internal/Field_energy.h>

#include <benchmark/benchmark.h>
#include <planar_test_meshes.h>

#include <algorithm>
#include <cmath>

namespace {

using Energy = Quadrille::internal::Field_energy<3, Quadrille::internal::Field_energy_kind::integrability>;
using Elements = Quadrille::internal::Field_elements<3>;

/// The frame of a singularity of the given index in the origin: size r^index, turned by index times the polar angle.
Elements::Coefficients integrable_field(const Eigen::Vector2d& p, double index)
{
  const double size = std::pow(p.norm(), index), angle = index * std::atan2(p.y(), p.x());
  return Quadrille::internal::Tensor_coefficients<3>::from_harmonics(
      Quadrille::odeco_harmonics({{std::cos(angle), std::sin(angle)}, size, size}));
}

void lie_energy(benchmark::State& state)
{
  const double index = 1 - double(state.range(0)) / 4;
  const int n = int(state.range(1));
  Quadrille::test::Planar_mesh mesh = Quadrille::test::rectangle_mesh(n, n, 2, 2);
  // No vertex may be where sizes are infinite: the singularity is the centroid of a triangle in the middle.
  const Eigen::Vector2d middle = mesh.centroid(2 * std::size_t(n / 2 * n + n / 2));
  std::vector<Elements::Coefficients> q;
  for (Eigen::Vector2d& p : mesh.points)
    q.push_back(integrable_field(p -= middle, index));
  const Elements elements({mesh.points.size(), mesh.triangles}, mesh.points,
                          std::vector<double>(mesh.triangles.size(), 2. / n),
                          std::vector<Quadrille::internal::Vertex_restriction<3>>(mesh.points.size()),
                          std::vector<double>(mesh.points.size()));
  const Energy integrability(elements, 1);
  double energy = 0, near_energy = 0, largest = 0;
  for (auto _ : state) {
    energy = near_energy = largest = 0;
    for (std::size_t e = 0; e < elements.number_of_elements(); ++e) {
      const auto& element = elements.element(e);
      Energy::Unknowns corners;
      for (int k = 0; k < 3; ++k)
        corners.segment<3>(3 * k) = q[std::size_t(element.vertex[std::size_t(k)])];
      Energy::Residuals all = Energy::Residuals::Zero();
      if (!integrability.evaluate(e, corners, all, nullptr))
        state.SkipWithError("a size is not positive");
      const Eigen::Matrix<double, Energy::first_odeco, 1> residuals = all.head<Energy::first_odeco>();
      energy += 0.5 * residuals.squaredNorm();
      if (mesh.centroid(e).norm() < 6. / n)
        near_energy += 0.5 * residuals.squaredNorm();
      for (int p = 0; p < 3; ++p) // half a point's squared rows are a third of the area times H
        largest = std::max(largest, residuals.segment<2>(2 * p).squaredNorm() / (2. / 3 * element.area));
    }
  }
  state.counters["triangles"] = double(elements.number_of_elements());
  state.counters["h"] = 2. / n;
  state.counters["energy"] = energy;
  state.counters["near_energy"] = near_energy;
  state.counters["largest_H"] = largest;
}

BENCHMARK(lie_energy)->ArgNames({"valence", "cells"})->ArgsProduct({{3, 5}, {8, 16, 32, 64, 128, 256, 512}});

} // namespace
