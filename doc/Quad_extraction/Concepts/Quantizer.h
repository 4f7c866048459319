/// Gives the arcs of a quadrilateral layout their numbers of quads.
///
/// Has models: `Quadrille::Greedy_quantizer`, `Quadrille::Optimal_quantizer`.
class Quantizer {
public:
  /// Returns the length of every arc of `layout`, an integer of at least 0.
  ///
  /// `layout.arcs[a].length` is the wanted, real length of arc `a`: it would be met with quads of exactly the wanted
  /// size. Lengths of opposite sides of each patch must agree; `layout.strips` helps with that, see
  /// `Quadrille::Quad_layout::Strip`. `constraints` tells which lengths are admissible: `constraints.sums()` are the
  /// conditions known so far, and `constraints.learn(lengths)` says whether lengths are admissible, and adds conditions
  /// if they would merge something that must stay apart. A quantizer need not use it, but its answer is checked by
  /// `learn`: one that is not admissible ends the extraction with a `Quadrille::No_result_error` of the stage
  /// "quantization".
  ///
  /// A model that knows a lower bound of the cost (see `Quadrille::Quantization`) sets it; the other numbers are
  /// computed by the extraction.
  Quadrille::Quantization operator()(const Quadrille::Quad_layout& layout,
                                     Quadrille::Length_constraints& constraints) const;
};
