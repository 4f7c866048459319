// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_ODECO_QUADRICS_3_H
#define QUADRILLE_ODECO_QUADRICS_3_H

#include <Quadrille/Symmetric_tensor_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Quadrille {

/// The 27 quadrics of the odeco variety of space, as short sums of products of two entries of a tensor.
///
/// T is odeco exactly if the tensor of order six G_KL = sum_s T_Ks T_Ls, K and L being three indices each, does not
/// change when indices of K and L are exchanged. As K and L are symmetric, and G_KL = G_LK, such exchanges only mix the
/// products G_KL that have the same number of indices 1, 2 and 3 in K and L together: one class of products for each
/// of the 28 monomials of degree six. Of a class of m products the differences are m - 1 conditions; 55 products in all
/// leave 27. A product stands for w components of G, so its class adds sum w (G_KL - mean)^2 to |G - sym G|^2. The
/// conditions are what an update of weighted means makes of this sum: sqrt(w W / (w + W)) (G_KL - mean before), W the
/// sum of the weights before; their squares add up to it.
///
/// For entries of any number type `S`, also packs of numbers; `odeco_residuals()` is the form for a single tensor.
class Odeco_quadrics_3 {
public:
  static constexpr int number = 27;

  Odeco_quadrics_3()
  {
    std::array<std::array<int, 2>, 10> triples; // numbers of indices 2 and 3 among three
    std::size_t n_triples = 0;
    for (int n = 0; n <= 3; ++n)
      for (int c = 0; c <= n; ++c)
        triples[n_triples++] = {n - c, c};
    for (int n = 0; n <= 6; ++n)
      for (int c = 0; c <= n; ++c) {
        double sum = 0;
        const std::size_t first = m_products.size();
        for (std::size_t k = 0; k < triples.size(); ++k)
          for (std::size_t l = k; l < triples.size(); ++l)
            if (triples[k][0] + triples[l][0] == n - c && triples[k][1] + triples[l][1] == c) {
              const double weight = (k == l ? 1 : 2) * n_orders(triples[k]) * n_orders(triples[l]);
              m_products.push_back(make_product(triples[k], triples[l]));
              m_products.back().factor = std::sqrt(weight * sum / (weight + sum));
              m_products.back().share = weight / (weight + sum);
              sum += weight;
            }
        if (m_products.size() == first + 1)
          m_products.pop_back(); // nothing to compare it with
      }
  }

  /// Values for the entries `t` of a tensor.
  template <class S> std::array<S, number> values(const std::array<S, 15>& t) const
  {
    std::array<S, number> result;
    std::size_t row = 0;
    S mean(0.0);
    for (const Product& product : m_products) {
      S g(0.0);
      for (const std::array<std::size_t, 2>& pair : product.entries)
        g += t[pair[0]] * t[pair[1]];
      if (product.factor == 0) {
        mean = g;
        continue;
      }
      const S difference = g - mean;
      result[row++] = S(product.factor) * difference;
      mean += S(product.share) * difference;
    }
    return result;
  }

  /// The derivatives of the values, by quadric and entry.
  template <class S> std::array<std::array<S, 15>, number> jacobian(const std::array<S, 15>& t) const
  {
    std::array<std::array<S, 15>, number> result;
    std::array<S, 15> mean;
    mean.fill(S(0.0));
    std::size_t row = 0;
    for (const Product& product : m_products) {
      std::array<S, 15> g;
      g.fill(S(0.0));
      for (const std::array<std::size_t, 2>& pair : product.entries) {
        g[pair[0]] += t[pair[1]];
        g[pair[1]] += t[pair[0]];
      }
      if (product.factor == 0) {
        mean = g;
        continue;
      }
      for (std::size_t i = 0; i < 15; ++i) {
        const S difference = g[i] - mean[i];
        result[row][i] = S(product.factor) * difference;
        mean[i] += S(product.share) * difference;
      }
      ++row;
    }
    return result;
  }

private:
  struct Product {
    std::array<std::array<std::size_t, 2>, 3> entries; ///< of T_Ks and T_Ls, by s
    double factor;                                     ///< of the condition, 0 for the first product of a class
    double share;                                      ///< of the product in the mean up to it
  };

  /// Components of a symmetric tensor of order three with this entry.
  static double n_orders(const std::array<int, 2>& triple)
  {
    constexpr double factorial[] = {1, 1, 2, 6};
    return 6 / (factorial[3 - triple[0] - triple[1]] * factorial[triple[0]] * factorial[triple[1]]);
  }

  static Product make_product(const std::array<int, 2>& k, const std::array<int, 2>& l)
  {
    Product product;
    for (int s = 0; s < 3; ++s)
      product.entries[std::size_t(s)] = {std::size_t(internal::entry_number(k[0] + (s == 1), k[1] + (s == 2))),
                                         std::size_t(internal::entry_number(l[0] + (s == 1), l[1] + (s == 2)))};
    return product;
  }

  std::vector<Product> m_products; ///< class by class
};

/// The only one that is needed.
inline const Odeco_quadrics_3& odeco_quadrics_3()
{
  static const Odeco_quadrics_3 quadrics;
  return quadrics;
}

} // namespace Quadrille

#endif
