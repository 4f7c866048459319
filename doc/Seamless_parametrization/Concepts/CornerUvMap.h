/// Writable property map: the coordinates (u, v) of the corners of all faces. It ties
/// `Quadrille::seamless_parametrization` to the extraction of quadrilaterals, which reads the same map, and to any
/// other user of seamless maps.
///
/// The value of halfedge `h` is that of the corner at `target(h)` in `face(h)`. Border halfedges have no value. Two
/// faces at one edge either agree on the values of its ends or differ by a transition (u, v) -> R^k (u, v) + T.
///
/// Has models: any property map from halfedges to `CGAL::Point_2<Kernel>` with a kernel of doubles.
class CornerUvMap {
public:
  using key_type = boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  /// Constructible from two doubles, which it stores without rounding.
  using value_type = Point_2;
  using category = boost::writable_property_map_tag;
};
