/// What `Quadrille::seamless_parametrization_with_traits` has to know of a triangulated surface: an orthonormal basis
/// of every face's plane, in which vectors of the face have two coordinates, and how these bases turn from face to
/// face.
///
/// Has models: `Quadrille::Planar_tangent_traits`, `Quadrille::Surface_tangent_traits`.
class TangentPlaneTraits {
public:
  /// The mesh's halfedges.
  using halfedge_descriptor = unspecified_type;

  /// The vector from the source of `h` to its target, in the basis of `face(h)`. The three vectors of a face add up to
  /// zero and run counterclockwise: the basis is oriented like the face. Never called for border halfedges.
  std::array<double, 2> edge_vector(halfedge_descriptor h) const;

  /// What to add to the angle of a direction in the basis of `face(h)` to have the angle of the same direction in the
  /// basis of `face(opposite(h))`, when both faces are unfolded into one plane around their edge. Any representative
  /// modulo full turns; the opposite halfedge has the opposite angle. Called for interior edges only.
  double transport_angle(halfedge_descriptor h) const;
};
