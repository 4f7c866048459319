/// Readable property map: an exactly seamless map of a triangulation, (u, v) per corner. What
/// `Quadrille::extract_quads` reads; where the map comes from does not matter.
///
/// The value of halfedge `h` is that of the corner at `target(h)` in `face(h)`; border halfedges are never asked for.
/// Exactly, as stored doubles:
///
/// - for the corner values (a, b) of an edge in one of its faces and (a', b') in the other there is a quarter turn R^k,
///   R (x, y) = (-y, x), such that b' - a' = R^k (b - a);
/// - u or v is constant along every edge that lies on a curve of the domain;
/// - all values are multiples of one power of two, and the largest has at most 50 bits above it, so that differences
/// and
///   the sums met in tracing are exact;
/// - every triangle is positively oriented.
///
/// One unit of the map is one quad. Integer values, or integer jumps, are not needed.
///
/// Has models: any property map from halfedges to `CGAL::Point_2<Kernel>` with a kernel of doubles, such as the result
/// of `Quadrille::seamless_parametrization`.
class SeamlessCornerMap {
public:
  using key_type = boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  /// Has members `x()` and `y()` that `CGAL::to_double` takes to doubles without rounding.
  using value_type = Point_2;
  using category = boost::readable_property_map_tag;
};
