/// Readable property map: the two gradients that a map (u, v) shall have in each face. It ties any source of frame
/// fields
/// (`Quadrille::odeco_frame_field`, a cross-field library, a file) to `Quadrille::seamless_parametrization`.
///
/// For a frame of orthogonal vectors with sizes l and m the gradients are u / l^2 and v / m^2: their lengths are 1 / l
/// and 1 / m. They need not be orthogonal, and each face may list any of the four pairs (du, dv), (-dv, du), (-du,
/// -dv), (dv, -du); which of them belong together across an edge is found by the function.
///
/// Has models: any property map from faces to `std::pair<CGAL::Vector_2, CGAL::Vector_2>` or to a pair of
/// `Eigen::Vector2d`.
class FaceGradientMap {
public:
  using key_type = boost::graph_traits<TriangleMesh>::face_descriptor;
  /// A pair of vectors with members `x()` and `y()`, in the tangent basis of the face (in the plane: its coordinates),
  /// finite and right-handed: du.x() * dv.y() - du.y() * dv.x() is positive.
  using value_type = std::pair<Vector_2, Vector_2>;
  using category = boost::readable_property_map_tag;
};
