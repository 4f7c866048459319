// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "pulled_back_metrics.h"
#include "tetrahedral_test_meshes.h"

#include <Quadrille/Metric_connection.h>
#include <Quadrille/Metric_field.h>

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

using namespace Quadrille;

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double levi_civita(int i, int j, int k) { return double((i - j) * (j - k) * (k - i)) / 2; }

Matrix3d cross_matrix(const Vector3d& w)
{
  Matrix3d result;
  for (int i = 0; i < 3; ++i)
    result.col(i) = w.cross(Vector3d::Unit(i));
  return result;
}

double angle_of(const Matrix3d& R) { return Eigen::AngleAxisd(R).angle(); }

/// The curls of the rows of a matrix field by central differences, with errors of about 1e-9.
template <class Field> Matrix3d curl(const Field& field, const Vector3d& p)
{
  constexpr double step = 1e-4;
  Matrix3d result = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Matrix3d change = (field(p + step * Vector3d::Unit(k)) - field(p - step * Vector3d::Unit(k))) / (2 * step);
    for (int row = 0; row < 3; ++row)
      result.row(row) += Vector3d::Unit(k).cross(change.row(row).transpose()).transpose();
  }
  return result;
}

/// From a to b by the trapezoidal rule on n equal parts; speed(t) is W (b - a).
template <class Speed> Matrix3d trapezoids(int n, const Speed& speed)
{
  Matrix3d R = Matrix3d::Identity();
  Vector3d before = speed(0);
  for (int i = 1; i <= n; ++i) {
    const Vector3d after = speed(double(i) / n), w = -(before + after) / (2 * n);
    R = (Eigen::AngleAxisd(w.norm(), w.normalized()) * R).eval();
    before = after;
  }
  return R;
}

template <class Field> Matrix3d exact_transport(const Field& root_at, const Vector3d& a, const Vector3d& b, int n)
{
  return trapezoids(n, [&](double t) -> Vector3d {
    const Vector3d p = a + t * (b - a);
    return connection_form(root_at(p), curl(root_at, p)) * (b - a);
  });
}

struct Metric_test : ::testing::Test {
  std::mt19937 engine{1};
  std::normal_distribution<double> normal;

  Matrix3d random_matrix()
  {
    return Matrix3d::NullaryExpr([this] { return normal(engine); });
  }
  Vector3d random_point() { return random_matrix().col(0); }
  Matrix3d random_rotation()
  {
    return Eigen::AngleAxisd(normal(engine), random_point().normalized()).toRotationMatrix();
  }

  /// A regular tetrahedron with edges h.
  Eigen::Matrix<double, 3, 4> tetrahedron(const Vector3d& center, double h)
  {
    Eigen::Matrix<double, 3, 4> points;
    points << 1, -1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1;
    return ((h / std::sqrt(8.0) * random_rotation() * points).colwise() + center).eval();
  }
};

const auto twisting_root = [](const Vector3d& p) { return root_of(twisting_jacobian(p)); };

/// The root of the metric of the sphere S^3 by stereographic projection.
const auto sphere_root = [](const Vector3d& p) -> Matrix3d { return 2 / (1 + p.squaredNorm()) * Matrix3d::Identity(); };

} // namespace

TEST_F(Metric_test, closed_form_of_the_connection_solves_the_structure_equation)
{
  for (int trial = 0; trial < 50; ++trial) {
    Matrix3d A = random_matrix();
    if (trial % 2 == 0)
      A = (A * A.transpose() + 0.1 * Matrix3d::Identity()).eval();
    const Matrix3d C = random_matrix();
    // C_il = sum eps_lmn eps_ija A_jn W_am
    Eigen::Matrix<double, 9, 9> system = Eigen::Matrix<double, 9, 9>::Zero();
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < 3; ++l)
        for (int a = 0; a < 3; ++a)
          for (int m = 0; m < 3; ++m)
            for (int j = 0; j < 3; ++j)
              for (int n = 0; n < 3; ++n)
                system(3 * i + l, 3 * a + m) += levi_civita(l, m, n) * levi_civita(i, j, a) * A(j, n);
    Eigen::Matrix<double, 9, 1> right;
    for (int i = 0; i < 9; ++i)
      right[i] = C(i / 3, i % 3);
    const Eigen::Matrix<double, 9, 1> solution = system.fullPivLu().solve(right);
    const Matrix3d W = connection_form(A, C);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(W(i / 3, i % 3), solution[i], 1e-10 * solution.norm());
    const double determinant = 2 * std::pow(A.determinant(), 3);
    EXPECT_NEAR(system.determinant(), determinant, 1e-10 * std::abs(determinant));
  }
}

TEST_F(Metric_test, conformal_metrics_turn_by_the_gradient)
{
  for (int trial = 0; trial < 10; ++trial) {
    const double scale = std::exp(normal(engine));
    const Vector3d gradient = random_point();
    // The curl of e^u e_i is e^u (grad u x e_i).
    const Matrix3d C = scale * cross_matrix(gradient).transpose();
    const Matrix3d W = connection_form(scale * Matrix3d::Identity(), C);
    EXPECT_LT((W - cross_matrix(gradient)).norm(), 1e-14 * (1 + gradient.norm()));
  }
}

TEST_F(Metric_test, constant_metrics_do_not_turn)
{
  std::array<Matrix3d, 4> roots;
  roots.fill(root_of(random_matrix()));
  const Linear_root root(tetrahedron(random_point(), 1), roots);
  EXPECT_LT(root.curl().norm(), 1e-13);
  EXPECT_LT((root.transport(0, 3, 1e-6) - Matrix3d::Identity()).norm(), 1e-13);
}

TEST_F(Metric_test, curls_of_linear_roots)
{
  // A_ij = sum_k D_i(j, k) x_k has the curls eps_lkj D_i(j, k).
  const std::array<Matrix3d, 3> derivative = {random_matrix(), random_matrix(), random_matrix()};
  const Eigen::Matrix<double, 3, 4> points = tetrahedron(random_point(), 1);
  std::array<Matrix3d, 4> roots;
  for (int corner = 0; corner < 4; ++corner)
    for (int row = 0; row < 3; ++row)
      roots[std::size_t(corner)].row(row) = (derivative[std::size_t(row)] * points.col(corner)).transpose();
  const Matrix3d C = Linear_root(points, roots).curl();
  for (int i = 0; i < 3; ++i)
    for (int l = 0; l < 3; ++l) {
      double expected = 0;
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          expected += levi_civita(l, k, j) * derivative[std::size_t(i)](j, k);
      EXPECT_NEAR(C(i, l), expected, 1e-12);
    }
}

TEST_F(Metric_test, pulled_back_metrics_stretch_much)
{
  double smallest = 1, largest = 1;
  for (int i = 0; i < 1000; ++i) {
    const auto stretch = twisting_jacobian(random_point().cwiseMax(-1).cwiseMin(1)).jacobiSvd().singularValues();
    smallest = std::min(smallest, stretch[2]);
    largest = std::max(largest, stretch[0]);
  }
  EXPECT_NEAR(smallest, 0.5, 0.1);
  EXPECT_NEAR(largest, 1.7, 0.1);
}

TEST_F(Metric_test, trapezoids_in_flat_metrics_converge_to_the_polar_rotations)
{
  for (int trial = 0; trial < 5; ++trial) {
    const Vector3d a = 0.5 * random_point(), b = a + random_point().normalized();
    const Matrix3d exact = polar_rotation(twisting_jacobian(b)).transpose() * polar_rotation(twisting_jacobian(a));
    std::vector<double> errors;
    for (const int n : {2, 4, 8, 16, 32})
      errors.push_back((exact_transport(twisting_root, a, b, n) - exact).norm());
    EXPECT_NEAR(order_of(errors), 2, 0.1);
    EXPECT_LT(errors.back(), 1e-3);
  }
}

TEST_F(Metric_test, transport_in_tetrahedra_converges_to_the_polar_rotations)
{
  std::vector<double> errors;
  for (const double h : {0.8, 0.4, 0.2, 0.1}) {
    engine.seed(1);
    double sum = 0;
    for (int trial = 0; trial < 20; ++trial) {
      const auto points = tetrahedron(0.5 * random_point(), h);
      std::array<Matrix3d, 4> roots, turns;
      for (int i = 0; i < 4; ++i) {
        const Matrix3d J = twisting_jacobian(points.col(i));
        roots[std::size_t(i)] = root_of(J);
        turns[std::size_t(i)] = polar_rotation(J).transpose();
      }
      const Linear_root root(points, roots);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          if (a != b)
            sum += (root.transport(a, b, 1e-6) - turns[b] * turns[a].transpose()).squaredNorm() / (20 * 12);
    }
    errors.push_back(std::sqrt(sum));
  }
  EXPECT_NEAR(order_of(errors), 2, 0.15);
  EXPECT_LT(errors.back(), 2e-3);
}

TEST_F(Metric_test, subdivision_keeps_the_tolerance_with_few_samples)
{
  // Almost singular at one end: W varies mostly there.
  const Vector3d thin = Vector3d(1, 2, 2) / 3;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const auto points = tetrahedron(random_point(), 1);
    std::array<Matrix3d, 4> roots;
    for (std::size_t i = 0; i < 4; ++i)
      roots[i] = root_of(Matrix3d::Identity() + 0.2 * random_matrix());
    roots[0] = Matrix3d::Identity() - 0.98 * thin * thin.transpose();
    const Linear_root root(points, roots);
    const auto speed = [&](double t) -> Vector3d {
      return connection_form((1 - t) * roots[0] + t * roots[1], root.curl()) * (points.col(1) - points.col(0));
    };
    const Matrix3d exact = trapezoids(1 << 17, speed);
    int samples = 0;
    const Matrix3d transport = root.transport(0, 1, tolerance, &samples);
    const double error = (transport - exact).norm();
    EXPECT_LT(error, tolerance);
    const double uniform_error = (trapezoids(samples - 1, speed) - exact).norm();
    EXPECT_GT(uniform_error, 3 * error);
    int needed = samples;
    while ((trapezoids(needed - 1, speed) - exact).norm() > error)
      needed += std::max(1, needed / 20);
    EXPECT_GT(needed, 2 * samples);
    EXPECT_LT((root.transport(1, 0, tolerance) - transport.transpose()).norm(), 1e-13);
  }
}

TEST_F(Metric_test, holonomy_of_the_sphere_is_the_area)
{
  const Matrix3d turn = random_rotation();
  std::vector<double> errors;
  for (const double h : {0.4, 0.2, 0.1}) {
    // Equilateral around a point off the centre.
    std::array<Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = 2 * std::acos(-1.0) * double(i) / 3;
      corners[i] = Vector3d(0.3, 0.2, -0.4) + h * turn * Vector3d(std::cos(angle), std::sin(angle), 0);
    }
    Matrix3d around = Matrix3d::Identity();
    for (std::size_t i = 0; i < 3; ++i)
      around = (exact_transport(sphere_root, corners[i], corners[(i + 1) % 3], 64) * around).eval();
    const double stretch = sphere_root((corners[0] + corners[1] + corners[2]) / 3)(0, 0);
    const double area = 0.75 * std::sqrt(3.0) * h * h * stretch * stretch;
    errors.push_back(std::abs(angle_of(around) / area - 1));
    // Vectors that are carried around counterclockwise turn counterclockwise.
    EXPECT_GT(Eigen::AngleAxisd(around).axis().dot(turn.col(2)), 0.9);
  }
  EXPECT_LT(errors.back(), 0.01);
  EXPECT_NEAR(order_of(errors), 2, 0.2);
}

TEST_F(Metric_test, holonomy_around_squares_of_a_mesh_is_the_area)
{
  // Planes through the origin are great spheres, so that the turn is the area, also of a large square.
  const double side = 1;
  double area = 0;
  const int samples = 200;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      const Vector3d p(side * (i + 0.5) / samples, side * (j + 0.5) / samples, 0);
      area += std::pow(sphere_root(p)(0, 0) * side / samples, 2);
    }
  std::vector<double> errors;
  for (const int n : {4, 8, 16}) { // edges in a side; there are two layers of cells around the square
    const double h = side / n;
    const Tetrahedral_mesh mesh = mapped(box_of_tetrahedra({n + 4, n + 4, 4}, {side + 4 * h, side + 4 * h, 4 * h}),
                                         [&](const Vector3d& p) -> Vector3d { return p - 2 * h * Vector3d::Ones(); });
    const Metric_connection connection(mesh, Metric_field::sampled(mesh, [](const Vector3d& p) -> Matrix3d {
                                         const Matrix3d A = sphere_root(p);
                                         return A * A;
                                       }));
    const auto vertex = [&](int i, int j) { return (2 * (n + 5) + j + 2) * (n + 5) + i + 2; };
    std::vector<int> loop;
    for (int i = 0; i < n; ++i)
      loop.push_back(vertex(i, 0));
    for (int j = 0; j < n; ++j)
      loop.push_back(vertex(n, j));
    for (int i = n; i > 0; --i)
      loop.push_back(vertex(i, n));
    for (int j = n; j > 0; --j)
      loop.push_back(vertex(0, j));
    Matrix3d around = Matrix3d::Identity();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int u = loop[i], v = loop[(i + 1) % loop.size()];
      around = (connection(u, v) * around).eval();
      EXPECT_LT((connection(u, v) * connection(v, u) - Matrix3d::Identity()).norm(), 1e-14);
    }
    const Matrix3d expected = Eigen::AngleAxisd(area, Vector3d::UnitZ()).toRotationMatrix();
    errors.push_back((around - expected).norm());
  }
  EXPECT_LT(errors.back(), 0.01 * area);
  EXPECT_GT(order_of(errors), 1.8);
}

TEST_F(Metric_test, turns_do_not_depend_on_scale_and_threads)
{
  const Tetrahedral_mesh mesh = jittered(cube_of_tetrahedra(3), 0.02, 1);
  const Metric_connection connection(mesh, Metric_field::pulled_back(mesh, twisting_jacobian), 1e-4, 1);
  for (const double scale : {1e8, 1e-8}) {
    const Tetrahedral_mesh scaled = mapped(mesh, [&](const Vector3d& p) -> Vector3d { return scale * p; });
    const auto jacobian = [&](const Vector3d& p) -> Matrix3d { return twisting_jacobian(p / scale) / scale; };
    const Metric_connection of_scaled(scaled, Metric_field::pulled_back(scaled, jacobian), 1e-4, 1);
    const Metric_connection with_threads(mesh, Metric_field::pulled_back(mesh, twisting_jacobian), 1e-4, 3);
    for (const auto& t : mesh.tetrahedra)
      for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_LT((connection(t[0], t[i]) - of_scaled(t[0], t[i])).norm(), 1e-12);
        EXPECT_EQ(connection(t[0], t[i]), with_threads(t[0], t[i]));
      }
  }
}

TEST(Metric_field_test, roots)
{
  const Tetrahedral_mesh mesh = cube_of_tetrahedra(1);
  const Metric_field metric = Metric_field::pulled_back(mesh, twisting_jacobian);
  ASSERT_EQ(metric.size(), 8u);
  for (std::size_t v = 0; v < 8; ++v) {
    const Matrix3d J = twisting_jacobian(mesh.point(v));
    EXPECT_LT((metric[v] * metric[v] - J.transpose() * J).norm(), 1e-14);
    EXPECT_LT((metric[v] - metric[v].transpose()).norm(), 1e-14);
    EXPECT_GT(metric[v].eigenvalues().real().minCoeff(), 0);
  }
  EXPECT_LT((Metric_field::of_sizes({0.5, 4})[1] - 0.25 * Matrix3d::Identity()).norm(), 1e-15);
}

TEST(Metric_field_test, errors_name_the_vertex)
{
  const auto expect_refused = [](const Matrix3d& bad, const std::string& reason) {
    for (const double scale : {1.0, 1e16, 1e-16}) {
      std::vector<Matrix3d> metrics(5, scale * Matrix3d::Identity());
      EXPECT_NO_THROW(Metric_field{metrics});
      metrics[3] = scale * bad;
      try {
        Metric_field{metrics};
        ADD_FAILURE() << "accepted: not " << reason;
      } catch (const Invalid_input_error& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 3 is not " + reason), std::string::npos) << error.what();
      }
    }
  };
  Matrix3d bad = Matrix3d::Identity();
  bad(0, 1) = 1e-6;
  expect_refused(bad, "symmetric");
  bad(1, 0) = 1e-6;
  EXPECT_NO_THROW(Metric_field({bad}));
  bad(0, 1) = std::numeric_limits<double>::quiet_NaN();
  expect_refused(bad, "finite");
  bad(0, 1) = std::numeric_limits<double>::infinity();
  expect_refused(bad, "finite");
  expect_refused(Eigen::Vector3d(1, 2, -1e-3).asDiagonal(), "positive definite");
  expect_refused(Eigen::Vector3d(1, 0, 2).asDiagonal(), "positive definite");
  expect_refused(Matrix3d::Zero(), "positive definite");

  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    try {
      Metric_field::of_sizes({1, 2, size, 1});
      ADD_FAILURE() << "accepted: " << size;
    } catch (const Invalid_input_error& error) {
      EXPECT_NE(std::string(error.what()).find("size at vertex 2 is"), std::string::npos) << error.what();
    }
}
