/// What `Quadrille::Element_least_squares` sums: residuals of small groups of unknowns.
///
/// Has models: the energies of the field, of the untangling of a map and of the smoothing of a mesh.
class LeastSquaresTerm {
public:
  /// The largest number of residuals of an element; elements with fewer set the others to zero.
  static constexpr int max_residuals = 1;
  /// The largest number of unknowns of an element.
  static constexpr int max_unknowns = 1;
  /// Fixed-size vectors and matrix of these dimensions.
  using Unknowns = Eigen::Matrix<double, max_unknowns, 1>;
  using Residuals = Eigen::Matrix<double, max_residuals, 1>;
  using Jacobian = Eigen::Matrix<double, max_residuals, max_unknowns>;

  std::size_t number_of_elements() const;

  /// Writes the global indices of the unknowns of element `e`, all different, and returns their number. The answer must
  /// not change during the life of the problem.
  int element_unknowns(std::size_t e, std::array<int, max_unknowns>& index) const;

  /// The residuals of element `e` at the local unknowns `x`, and, unless `J` is null, their derivatives (columns beyond
  /// the element's number of unknowns are ignored). Returns `false` if `x` is outside the domain of the energy; then
  /// `r` and `J` are ignored. Called for different elements from different threads at the same time.
  bool evaluate(std::size_t e, const Unknowns& x, Residuals& r, Jacobian* J) const;

  /// Optional, with `evaluate_batch()`: so many consecutive elements are evaluated together, which vectorised terms do
  /// faster. `evaluate()` is then not called by `Element_least_squares`.
  static constexpr int batch_size = 4;

  /// What the elements from `first` on contribute, `count` of them (less than `batch_size` at the end), at their local
  /// unknowns `x`: energies, gradients unless `detail` is `energy`, and matrices if it is `matrix`. Returns `false` if
  /// an element is outside the domain; then `results` is ignored. It must say the same as `evaluate()`.
  bool evaluate_batch(std::size_t first, int count, const Unknowns* x, Detail detail,
                      Element_contribution<max_unknowns>* results) const;
};
