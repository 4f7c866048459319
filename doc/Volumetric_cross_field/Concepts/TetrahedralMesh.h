/// A tetrahedral mesh whose vertices and tetrahedra are numbered from 0: read-only, and cheap to ask.
///
/// Has models: `Quadrille::Tetrahedral_mesh`, `Quadrille::Indexed_tetrahedra` (of CGAL's triangulations and mesh
/// complexes).
class TetrahedralMesh {
public:
  std::size_t number_of_vertices() const;
  std::size_t number_of_tetrahedra() const;

  /// Convertible to `Eigen::Vector3d`.
  Eigen::Vector3d point(std::size_t vertex) const;

  /// Four numbers of vertices, convertible to `int`, by `operator[]`: corners a, b, c, d with
  /// (b - a) x (c - a) . (d - a) > 0.
  std::array<int, 4> tetrahedron(std::size_t tetrahedron) const;
};
