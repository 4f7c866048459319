// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "energy_checks.h"

#include <Quadrille/Odeco_frame_field/internal/Field_energy.h>
#include <Quadrille/Odeco_frame_field/internal/Surface_energy.h>
#include <Quadrille/Odeco_frame_field/internal/surface_restrictions.h>
#include <Quadrille/check_jacobian.h>
#include <Quadrille/odeco_tensors_3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace {

using namespace Quadrille;
using namespace Quadrille::internal;
using namespace Quadrille_test;

class Random {
public:
  explicit Random(unsigned seed) : m_engine(seed) {}
  double operator()() { return m_uniform(m_engine); }
  template <int n> Eigen::Matrix<double, n, 1> vector()
  {
    return Eigen::Matrix<double, n, 1>::NullaryExpr([&] { return (*this)(); });
  }

private:
  std::mt19937 m_engine;
  std::uniform_real_distribution<double> m_uniform{-1, 1};
};

/// Four points around a saddle, in two triangles.
struct Saddle {
  std::vector<Eigen::Vector3d> points = {{0.1, -0.2, 0.1}, {1, 0, -0.1}, {1.2, 0.9, 0.2}, {0, 1, -0.2}};
  std::vector<std::array<int, 3>> faces = {{0, 1, 2}, {0, 2, 3}};
  std::vector<double> sizes = {0.7, 0.9};

  void move(const Eigen::Matrix3d& R, double scale)
  {
    for (Eigen::Vector3d& p : points)
      p = scale * (R * p);
    for (double& size : sizes)
      size *= scale;
  }
  /// Normals are close to the third axis, tangent axes anywhere.
  Surface_nodes nodes(const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) const
  {
    Random random(7);
    Surface_nodes nodes{faces, {0, 1, 2, 3}, {}};
    for (int v = 0; v < 4; ++v) {
      const Eigen::Vector3d normal = (Eigen::Vector3d::UnitZ() + 0.2 * random.vector<3>()).normalized();
      Eigen::Matrix3d axes;
      axes.col(2) = normal;
      axes.col(0) = normal.cross(random.vector<3>()).normalized();
      axes.col(1) = normal.cross(axes.col(0));
      nodes.axes.push_back(R * axes);
    }
    return nodes;
  }
  template <int N>
  Surface_elements<N> elements(Normal_value normal_value,
                               std::vector<Vertex_restriction<N>> restrictions = std::vector<Vertex_restriction<N>>(4),
                               const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) const
  {
    return Surface_elements<N>(nodes(R), Indexed_triangulation(4, faces), points, sizes,
                               Restricted_unknowns<N>(std::move(restrictions)), {0.1, -0.2, 0.3, 0}, {1, 0.5, 0, 1},
                               normal_value);
  }
};

/// One node with a restriction of each kind: fixed, one unknown, N - 1 unknowns, free.
template <int N> std::vector<Vertex_restriction<N>> restrictions_of_each_kind()
{
  Random random(3);
  std::vector<Vertex_restriction<N>> restrictions(4);
  for (int v = 0; v < 3; ++v) {
    Vertex_restriction<N>& restriction = restrictions[std::size_t(v)];
    restriction.is_free = false;
    restriction.dimension = v == 0 ? 0 : v == 1 ? 1 : N - 1;
    restriction.offset = Eigen::Matrix<double, N, 1>::Unit(0) * 3;
    restriction.basis = Eigen::Matrix<double, N, N>::NullaryExpr([&] { return random(); });
  }
  return restrictions;
}

/// Jacobians against finite differences, and batches against single elements.
template <class Term, int N> void expect_right_derivatives(const Term& energy, const Surface_elements<N>& elements)
{
  Random random(11);
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::vector<typename Term::Unknowns> unknowns;
    for (std::size_t e = 0; e < 2; ++e) {
      typename Term::Unknowns x = Term::Unknowns::Zero();
      std::array<int, std::size_t(3 * N)> index;
      const int count = energy.element_unknowns(e, index);
      for (int i = 0; i < count; ++i) {
        bool is_mean = false; // the first coefficient of a free node
        for (const int v : elements.element(e).node)
          is_mean = is_mean || (elements.unknowns().restriction(std::size_t(v)).is_free &&
                                index[std::size_t(i)] == elements.unknowns().index(std::size_t(v))[0]);
        x[i] = 0.3 * random() + (is_mean ? 3 : 0);
      }
      EXPECT_LT(jacobian_error(energy, e, x), 1e-7);
      unknowns.push_back(x);
    }
    expect_equal_batches(energy, unknowns);
  }
}

/// Of the first two of four nodes: a direction with one size, and a size alone.
template <int N> std::vector<Weak_target<N>> some_weak_targets()
{
  Surface_constraints constraints;
  constraints.weak_of_node.resize(4);
  constraints.weak_of_node[0].alignment = std::polar(1.0, 0.7);
  constraints.weak_of_node[0].n_aligned = 1;
  constraints.weak_of_node[0].size[0].add(1.3);
  constraints.weak_of_node[1].size[0].add(0.8);
  constraints.weak_length = {2, 1, 0, 0};
  return weak_targets<N>(constraints);
}

Melt_and_freeze_schedule attracting_schedule()
{
  Melt_and_freeze_schedule schedule;
  schedule.size_attraction = 0.8;
  schedule.smooth_attraction = 0.6;
  return schedule;
}

template <int N> void expect_right_derivatives_of_all()
{
  const Saddle saddle;
  for (const bool restricted : {true, false})
    for (const Normal_value normal_value : {Normal_value::mean, Normal_value::one}) {
      Surface_elements<N> elements = saddle.elements<N>(
          normal_value, restricted ? restrictions_of_each_kind<N>() : std::vector<Vertex_restriction<N>>(4));
      elements.set_weak_targets(some_weak_targets<N>());
      for (const bool as_in_paper : {true, false})
        for (const double weight : {0.0, 0.7}) {
          Surface_energy<N> energy(elements, {as_in_paper, 1.5, weight, 0.6 * weight, 0.8 * weight, 0.9 * weight});
          expect_right_derivatives(energy, elements);
          energy.attract(attracting_schedule());
          expect_right_derivatives(energy, elements);
        }
      expect_right_derivatives(Surface_smoothness<N>(elements, 0.7), elements);
    }
}

TEST(Surface_energy, derivatives_agree_with_finite_differences)
{
  expect_right_derivatives_of_all<3>();
  expect_right_derivatives_of_all<5>();
}

/// Nearly a frame of the given size at every node, in an unrestricted field.
template <int N> Eigen::VectorXd some_field(const Surface_elements<N>& elements, unsigned seed, double size = 1.7)
{
  Random random(seed);
  Eigen::VectorXd x(Eigen::Index(elements.number_of_unknowns()));
  for (std::size_t v = 0; v < elements.number_of_nodes(); ++v) {
    Orthogonal_frame_2 frame;
    frame.direction = random.vector<2>().normalized();
    frame.size_u = size * (1 + 0.3 * random());
    frame.size_v = size * (1 + 0.3 * random());
    elements.assign_coefficients(
        v, Tensor_coefficients<N>::from_harmonics(odeco_harmonics(frame)) + 0.1 * size * random.vector<N>(), x);
  }
  return x;
}

template <class Term> double total_energy(const Term& term, const Eigen::VectorXd& x)
{
  return Element_least_squares<Term>(term, std::size_t(x.size())).energy(x);
}

template <int N> void expect_no_units()
{
  // Without wanted sizes; their attraction has a unit by its meaning.
  const Surface_weights weights{false, 2, 0, 0.5, 0};
  Melt_and_freeze_schedule schedule = attracting_schedule();
  schedule.size_attraction = 0;
  const auto energy_of = [&](const Saddle& saddle, double factor, const Eigen::Matrix3d& R) {
    const auto elements = saddle.elements<N>(Normal_value::mean, std::vector<Vertex_restriction<N>>(4), R);
    Surface_energy<N> energy(elements, weights);
    energy.attract(schedule);
    return total_energy(energy, factor * some_field(elements, 5));
  };
  Saddle saddle;
  const double expected = energy_of(saddle, 1, Eigen::Matrix3d::Identity());
  EXPECT_GT(expected, 0.1);
  EXPECT_LT(expected, 1e6);
  for (const double factor : {1e-8, 3.0, 1e8})
    EXPECT_NEAR(energy_of(saddle, factor, Eigen::Matrix3d::Identity()), expected, 1e-12 * expected);
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, -0.6, 0.5, 0.2).normalized().toRotationMatrix();
  for (const double scale : {1e-8, 3.0, 1e8}) {
    saddle = Saddle();
    saddle.move(R, scale);
    EXPECT_NEAR(energy_of(saddle, 1, R), expected, 1e-11 * expected);
  }
}

TEST(Surface_energy, does_not_depend_on_the_units_of_sizes_and_coordinates)
{
  expect_no_units<3>();
  expect_no_units<5>();
}

/// The tensor at a node, from the meaning of its coefficients.
template <int N>
Symmetric_tensor_3 tensor_at(const Surface_elements<N>& elements, std::size_t v, const Eigen::VectorXd& x)
{
  const Circular_harmonics q = Tensor_coefficients<N>::harmonics(elements.coefficients(v, x));
  const auto t = Symmetric_tensor_2::from_harmonics(q).entries();
  const double trace = t[0] + 2 * t[2] + t[4]; // the sum of the two eigenvalues
  const double along_normal = elements.normal_value() == Normal_value::one ? 1 : 0.5 * trace;
  Symmetric_tensor_3::Entries entries = Symmetric_tensor_3::Entries::Zero();
  const int places[5] = {0, 1, 3, 6, 10};
  for (int m = 0; m < 5; ++m)
    entries[places[m]] = t[m];
  entries[14] = along_normal;
  return Symmetric_tensor_3(entries).rotated(elements.nodes().axes[v]);
}

/// sum over j, k, l of T^-1_ijkl n . curl(T_jkl.), surface, eq. (45), of the linear interpolant at a point.
template <int N>
Eigen::Vector3d normalized_curl(const Surface_elements<N>& elements, std::size_t e, const Eigen::VectorXd& x,
                                const Eigen::Vector3d& weights)
{
  const auto& element = elements.element(e);
  Symmetric_tensor_3 corner[3], tensor;
  Eigen::Vector3d slope[3];
  for (int k = 0; k < 3; ++k) {
    corner[k] = tensor_at(elements, std::size_t(element.node[std::size_t(k)]), x);
    tensor = tensor + weights[k] * corner[k];
    slope[k] = element.axes.template leftCols<2>() * element.gradient.col(k);
  }
  const Eigen::Vector3d normal = element.axes.col(2);
  const Eigen::Matrix3d inverse = tensor.partial_trace().inverse();
  const Eigen::Matrix3d inverse_square = inverse * inverse;
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) {
        Eigen::Vector3d curl = Eigen::Vector3d::Zero(), entries;
        for (int k = 0; k < 3; ++k)
          curl += slope[k].cross(Eigen::Vector3d(corner[k](a, b, c, 0), corner[k](a, b, c, 1), corner[k](a, b, c, 2)));
        for (int d = 0; d < 3; ++d)
          entries[d] = tensor(a, b, c, d);
        result += inverse_square * entries * curl.dot(normal);
      }
  return result;
}

const double quadrature_weights[3][3] = {{2. / 3, 1. / 6, 1. / 6}, {1. / 6, 2. / 3, 1. / 6}, {1. / 6, 1. / 6, 2. / 3}};

template <int N, class Visit>
void for_each_point(const Surface_elements<N>& elements, const Surface_weights& weights, const Visit& visit)
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Eigen::VectorXd x = some_field(elements, seed);
    const Surface_energy<N> energy(elements, weights);
    for (std::size_t e = 0; e < elements.number_of_elements(); ++e) {
      std::array<int, std::size_t(3 * N)> index;
      typename Surface_energy<N>::Unknowns local = Surface_energy<N>::Unknowns::Zero();
      const int count = energy.element_unknowns(e, index);
      for (int i = 0; i < count; ++i)
        local[i] = x[index[std::size_t(i)]];
      typename Surface_energy<N>::Residuals rows;
      ASSERT_TRUE(energy.evaluate(e, local, rows, nullptr));
      for (int p = 0; p < 3; ++p)
        visit(e, p, x, Eigen::Vector3d(quadrature_weights[p][0], quadrature_weights[p][1], quadrature_weights[p][2]),
              rows);
    }
  }
}

template <int N> void expect_right_curl(Normal_value normal_value)
{
  const Saddle saddle;
  const auto elements = saddle.elements<N>(normal_value);
  for_each_point(elements, {},
                 [&](std::size_t e, int p, const Eigen::VectorXd& x, const Eigen::Vector3d& weights, const auto& rows) {
                   const Eigen::Vector3d expected = normalized_curl(elements, e, x, weights);
                   const double factor = std::sqrt(2. / 3 * elements.element(e).area);
                   const Eigen::Vector3d value = elements.element(e).axes * rows.template segment<3>(3 * p) / factor;
                   EXPECT_LT((value - expected).norm(), 1e-12 * expected.norm());
                 });
}

TEST(Surface_energy, curl_is_that_of_the_definition)
{
  for (const Normal_value normal_value : {Normal_value::mean, Normal_value::one}) {
    expect_right_curl<3>(normal_value);
    expect_right_curl<5>(normal_value);
  }
}

TEST(Surface_energy, weak_constraints_measure_the_distance_from_what_they_allow)
{
  const Saddle saddle;
  for (const Normal_value normal_value : {Normal_value::mean, Normal_value::one}) {
    Surface_elements<5> elements = saddle.elements<5>(normal_value);
    elements.set_weak_targets(some_weak_targets<5>());
    const double weight = 3;
    const Surface_energy<5> energy(elements, {false, 1.5, 0, 0, 0, weight});
    double sum = 0;
    Eigen::VectorXd x = 0.2 * Random(4).vector<20>();
    for (int v = 0; v < 4; ++v)
      x[5 * v] += 3;
    for (std::size_t e = 0; e < elements.number_of_elements(); ++e) {
      typename Surface_energy<5>::Unknowns local;
      std::array<int, 15> index;
      energy.element_unknowns(e, index);
      for (int i = 0; i < 15; ++i)
        local[i] = x[index[std::size_t(i)]];
      typename Surface_energy<5>::Residuals rows;
      ASSERT_TRUE(energy.evaluate(e, local, rows, nullptr));
      sum += rows.tail<15>().squaredNorm();
    }
    // Node 0, a frame turned by 0.7 / 4 with the length 1.3 along: the nearest one has some length across.
    const auto power = [](double u, double v) {
      Orthogonal_frame_2 frame;
      frame.direction = {std::cos(0.175), std::sin(0.175)};
      frame.size_u = u;
      frame.size_v = v;
      return Eigen::Matrix<double, 5, 1>(Tensor_coefficients<5>::from_harmonics(odeco_harmonics(frame)));
    };
    const Eigen::Matrix<double, 5, 1> rest = x.head<5>() - power(1.3, 0), across = power(0, 1);
    const double first = (rest - across.dot(rest) / across.squaredNorm() * across).squaredNorm();
    // Node 1, of any direction: the coefficients of degrees 0 and 2 are given.
    Eigen::Vector3d low = x.segment<3>(5);
    low[0] -= power(0.8, 0.8)[0];
    const double expected = weight * (2. / 3 * first * std::exp(-0.2) + 1. / 3 * low.squaredNorm() * std::exp(0.4));
    EXPECT_NEAR(sum, expected, 1e-12 * expected);
  }
}

TEST(Surface_energy, odeco_term_of_the_paper_is_that_of_the_normalized_tensor)
{
  const Saddle saddle;
  const auto elements = saddle.elements<5>(Normal_value::one);
  const double kappa = 1.7;
  for_each_point(elements, {true, kappa, 0, 0, 0},
                 [&](std::size_t e, int p, const Eigen::VectorXd& x, const Eigen::Vector3d& weights, const auto& rows) {
                   Symmetric_tensor_3 tensor;
                   for (int k = 0; k < 3; ++k)
                     tensor = tensor + weights[k] * tensor_at(elements,
                                                              std::size_t(elements.element(e).node[std::size_t(k)]), x);
                   const double expected = kappa / 3 * Quadrille::odeco_residuals(tensor).squaredNorm() /
                                           std::pow(tensor.squared_norm(), 2);
                   const int first = Surface_energy<5>::first_odeco + odeco_quadrics_count * p;
                   EXPECT_NEAR(rows.template segment<27>(first).squaredNorm(), expected, 1e-12 * expected);
                   EXPECT_GT(expected, 1e-6);
                 });
}

TEST(Surface_energy, odeco_term_of_isotropic_frames_in_the_plane_is_the_planar_one)
{
  const Saddle saddle;
  std::vector<Eigen::Vector2d> planar_points;
  std::vector<Eigen::Vector3d> points;
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, -0.6, 0.5, 0.2).normalized().toRotationMatrix();
  for (const Eigen::Vector3d& p : saddle.points) {
    planar_points.emplace_back(p.x(), p.y());
    points.emplace_back(R * Eigen::Vector3d(p.x(), p.y(), 0));
  }
  const Indexed_triangulation mesh(4, saddle.faces);
  const Surface_nodes nodes{saddle.faces, {0, 1, 2, 3}, std::vector<Eigen::Matrix3d>(4, R)};
  const double epsilon = 1.3;
  const std::vector<double> none(4, 0.0);
  const Surface_elements<3> elements(nodes, mesh, points, saddle.sizes,
                                     Restricted_unknowns<3>(std::vector<Vertex_restriction<3>>(4)), none);
  const Field_elements<3> planar(mesh, planar_points, saddle.sizes, std::vector<Vertex_restriction<3>>(4), none);
  const Surface_energy<3> energy(elements, {false, epsilon, 0, 0, 0});
  using Planar_energy = Field_energy<3, Field_energy_kind::integrability>;
  const Planar_energy planar_energy(planar, epsilon);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Eigen::VectorXd x = some_field(elements, seed);
    for (std::size_t e = 0; e < 2; ++e) {
      Eigen::Matrix<double, 9, 1> local;
      for (int k = 0; k < 3; ++k)
        local.segment<3>(3 * k) = x.segment<3>(3 * saddle.faces[e][std::size_t(k)]);
      Surface_energy<3>::Residuals rows;
      Planar_energy::Residuals planar_rows;
      ASSERT_TRUE(energy.evaluate(e, local, rows, nullptr));
      ASSERT_TRUE(planar_energy.evaluate(e, local, planar_rows, nullptr));
      for (int p = 0; p < 3; ++p) {
        const double expected = std::pow(planar_rows[Field_residuals<3>::lie_rows + p], 2);
        EXPECT_GT(expected, 1e-6);
        EXPECT_NEAR(rows.segment<27>(Surface_energy<3>::first_odeco + 27 * p).squaredNorm(), expected,
                    1e-10 * expected);
      }
    }
  }
}

} // namespace
