/// Knows the true shape of a domain's curves, of which the triangulation has polylines.
///
/// Has model: `Quadrille::No_curve_projector`, which leaves points where they are.
class CurveProjector {
public:
  /// The point of curve `curve` nearest to `p`, a point of the polyline; `Point` is the value type of the vertex point
  /// map. Vertices that are corners, ends or junctions of curves are not asked for: they stay where they are.
  Point operator()(int curve, const Point& p) const;
};
