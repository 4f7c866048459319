/// A direct solver for sparse symmetric positive definite systems whose pattern stays the same over many solves.
///
/// Has models: `Quadrille::Cholesky_solver`.
class SparseCholeskySolver {
public:
  /// Analyses the pattern of a symmetric matrix given by its lower triangle.
  void analyze(const Eigen::SparseMatrix<double>& lower);
  /// Factorises a matrix with that pattern; `false` if it is not positive definite, which is not an error.
  bool factorize(const Eigen::SparseMatrix<double>& lower);
  /// Solves with the last factorisation that returned `true`.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
};
