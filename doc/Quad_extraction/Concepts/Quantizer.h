/// Gives the strips of a quadrilateral layout their numbers of quads.
///
/// Has model: `Quadrille::Greedy_quantizer`.
class Quantizer {
public:
  /// Returns the length of every strip of `layout`, an integer of at least 0; 0 collapses the strip.
  ///
  /// `layout.strips[s].length` is the wanted, real length of strip `s`: it would be met with quads of exactly the
  /// wanted size. `constraints` tells which lengths are admissible: `constraints.fix(s, n)` gives strip `s` the least
  /// admissible length of at least `n`, given the strips fixed before, and returns it. A quantizer need not use it, but
  /// its answer is checked: fixing the strips in the order of their indices with the returned lengths must change none
  /// of them, or the extraction ends with a `Quadrille::No_result_error` of the stage "quantization".
  std::vector<int> operator()(const Quadrille::Quad_layout& layout, Quadrille::Strip_constraints& constraints) const;
};
