// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_SIZE_SPECIFICATION_H
#define QUADRILLE_SIZE_SPECIFICATION_H

#include <Quadrille/Frame_size.h>
#include <Quadrille/Planar_domain.h>
#include <Quadrille/Triangulated_domain.h>
#include <Quadrille/exceptions.h>

#include <CGAL/Surface_mesh.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Quadrille {

/// Element sizes along the curves of a domain, in the domain's units.
struct Domain_sizes {
  /// Per edge of the domain's mesh: the sizes at source and target of `halfedge(edge)`; free where none is prescribed
  /// (inside the regions, and on curves that are only to be aligned with).
  std::vector<std::array<Frame_size, 2>> of_edge;
  bool by_default = false; ///< neither the user nor the file said anything about sizes
  /// What was chosen, one sentence per line, for the user.
  std::vector<std::string> notes;

  /// Whether the lengths of element edges on `e` are prescribed.
  bool is_prescribed(CGAL::SM_Edge_index e) const { return of_edge[std::size_t(e.idx())][0].tangential > 0; }
};

/// What the user says about element sizes, in the notation of the program's option `--size`.
///
/// * `S`, `NxT`: size S, or N across and T along, on every curve (border and inside) that no other item names;
/// * `NAME=S`: size S on the curves of physical group NAME, or on the curve with tag NAME;
/// * `NAME=A:B`: from A at the first to B at the last point, linear in arc length. The curves of a group are taken
///   together where they join end to end; the curve with the smallest tag says which way is forward;
/// * `NAME=NxT`: size N across and T along the curve, which needs an anisotropic field unless N = T;
/// * `NAME=N1xT1:N2xT2`: both, linear in arc length.
///
/// Instead of a number, `free` leaves a size open: `NAME=free`, `NAME=Nxfree`, `NAME=freexT`. What is said of a
/// curve by its tag wins over what is said of its group, and that over what is said of every curve; items of one kind
/// must not contradict each other.
class Size_specification {
public:
  Size_specification() = default;

  /// Adds one item. \throws Invalid_argument_error if `text` is in none of the forms above or a size is not a positive
  /// finite number.
  void add(const std::string& text);

  bool empty() const { return m_items.empty(); }

  /// A size for what has no curves: that of the item without a name, or else the bounding box's diagonal / 40.
  template <class Point> double typical_size(const Triangulated_domain<Point>& domain) const;

  /// The first item that asks for different sizes across and along a curve, which no isotropic field can have; empty if
  /// there is none.
  std::string anisotropic_item() const;

  /// The names (or tags) with sizes across that are smaller than those along, and the least of the former.
  std::map<std::string, double> thin_curves() const;

  /// Sizes for every curve of `domain`.
  ///
  /// Curves that no item names take the sizes that the file gives at their points (linear in arc length); where there
  /// are none, they are left free if any item was given, and otherwise get the bounding box's diagonal / 40, or less at
  /// holes and other round outlines: smooth curves that turn by half a circle get at least six elements there, down to
  /// an eighth of that size, and sizes grow from them by half the distance, as in a polar grid.
  /// \param factor of all sizes, that of the box included (so that round outlines count only if they need less)
  /// \throws Invalid_argument_error if a name does not exist in `domain` (listing those that do), if A and B differ on
  /// a closed or branching curve, or if two items give the same curve different sizes.
  /// Complexity: O(n log n) in the number of curves, edges and vertices.
  template <class Point> Domain_sizes apply(const Triangulated_domain<Point>& domain, double factor = 1) const;

private:
  struct Item {
    std::string text, name; ///< name is empty for every curve
    Frame_size first, last;

    bool is_same_size(const Item& other) const
    {
      return first.normal == other.first.normal && first.tangential == other.first.tangential &&
             last.normal == other.last.normal && last.tangential == other.last.tangential;
    }
    bool is_constant() const { return first.normal == last.normal && first.tangential == last.tangential; }
  };
  std::vector<Item> m_items;
};

} // namespace Quadrille

#include <Quadrille/Mesh_io/internal/Size_specification_impl.h>

#endif
