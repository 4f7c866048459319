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
              m_products.back().weight = weight;
              m_products.back().factor = std::sqrt(weight * sum / (weight + sum));
              m_products.back().share = weight / (weight + sum);
              sum += weight;
            }
        if (m_products.size() == first + 1) {
          m_products.pop_back(); // nothing to compare it with
          continue;
        }
        add_class(first, sum);
      }
    make_gram_terms();
  }

  /// The sum of the values' squares, that is |G - sym G|^2, and half its derivatives by the entries.
  template <class S> S squared_norm(const std::array<S, 15>& t, std::array<S, 15>& half_gradient) const
  {
    half_gradient.fill(S(0.0));
    S sum(0.0);
    std::array<S, max_class> g;
    for (const Class& c : m_classes) {
      S mean(0.0);
      for (std::size_t m = 0; m < c.count; ++m) {
        g[m] = S(0.0);
        for (const std::array<std::size_t, 2>& pair : m_products[c.first + m].entries)
          g[m] += t[pair[0]] * t[pair[1]];
        mean += S(m_products[c.first + m].weight / c.weight) * g[m];
      }
      for (std::size_t m = 0; m < c.count; ++m) {
        const S difference = g[m] - mean, weighted = S(m_products[c.first + m].weight) * difference;
        sum += weighted * difference;
        for (const std::array<std::size_t, 2>& pair : m_products[c.first + m].entries) {
          half_gradient[pair[0]] += weighted * t[pair[1]];
          half_gradient[pair[1]] += weighted * t[pair[0]];
        }
      }
    }
    return sum;
  }

  /// J^T J of the Jacobian J: its entries i >= j, row by row.
  template <class S> std::array<S, 120> gram(const std::array<S, 15>& t) const
  {
    std::array<S, 120> pairs, result;
    for (std::size_t i = 0, n = 0; i < 15; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        pairs[n++] = t[i] * t[j];
    for (std::size_t e = 0; e < 120; ++e) {
      S sum(0.0);
      for (std::size_t k = m_first_term[e]; k < m_first_term[e + 1]; ++k)
        sum += S(m_terms[k].factor) * pairs[m_terms[k].pair];
      result[e] = sum;
    }
    return result;
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
    double weight;                                     ///< number of components
    double factor;                                     ///< of the condition, 0 for the first product of a class
    double share;                                      ///< of the product in the mean up to it
  };
  static constexpr std::size_t max_class = 6; ///< products of one monomial
  struct Class {
    std::size_t first, count; ///< products
    double weight;            ///< of all of them
  };
  struct Term {
    std::size_t pair; ///< of two entries i >= j: i (i + 1) / 2 + j
    double factor;
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

  void add_class(std::size_t first, double weight) { m_classes.push_back({first, m_products.size() - first, weight}); }

  /// J^T J is a quadratic form of the entries: the sum over all products of w dG dG^T, less that of their means.
  void make_gram_terms()
  {
    std::vector<std::array<double, 120>> form(120, std::array<double, 120>{}); // by entry and pair
    const auto number_of = [](std::size_t i, std::size_t j) {
      return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
    };
    const auto add = [&](const Product& a, const Product& b, double factor) {
      for (const std::array<std::size_t, 2>& p : a.entries)
        for (const std::array<std::size_t, 2>& q : b.entries)
          for (const std::size_t i : {0, 1})
            for (const std::size_t j : {0, 1}) // the derivatives by p[i] and q[j]
              if (p[i] >= q[j])
                form[number_of(p[i], q[j])][number_of(p[1 - i], q[1 - j])] += factor;
    };
    for (const Class& c : m_classes)
      for (std::size_t a = c.first; a < c.first + c.count; ++a)
        for (std::size_t b = c.first; b < c.first + c.count; ++b)
          add(m_products[a], m_products[b],
              (a == b ? m_products[a].weight : 0) - m_products[a].weight * m_products[b].weight / c.weight);
    for (std::size_t e = 0; e < 120; ++e) {
      m_first_term[e] = m_terms.size();
      for (std::size_t pair = 0; pair < 120; ++pair)
        if (std::abs(form[e][pair]) > 1e-12)
          m_terms.push_back({pair, form[e][pair]});
    }
    m_first_term[120] = m_terms.size();
  }

  std::vector<Product> m_products; ///< class by class
  std::vector<Class> m_classes;
  std::vector<Term> m_terms; ///< of the Gram matrix, entry by entry
  std::array<std::size_t, 121> m_first_term = {};
};

/// The only one that is needed.
inline const Odeco_quadrics_3& odeco_quadrics_3()
{
  static const Odeco_quadrics_3 quadrics;
  return quadrics;
}

} // namespace Quadrille

#endif
