#pragma once
/// \file  Cylinders that stand as copies of a few on a lattice: what passes between them by Fourier transforms (C21).
/// Not installed.
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "array.hpp"
#include "hydro/base/product.hpp"

namespace hydro::cylinders {

/// Amplitudes of partial waves, one column for each thing that arrives or moves; a row is contiguous.
using Amplitudes = RowMajorXcd;

/// Every cylinder is one of a few kinds in one cell of rows × columns; cells may lack kinds.
struct Lattice {
  struct Site {
    std::size_t kind;
    Eigen::Index row, column;
  };
  std::vector<Site> site;  ///< of each cylinder
  std::size_t kinds = 0;
  Eigen::Index rows = 1, columns = 1;

  /// Complex multiplications a column of amplitudes, if the orders −order … order of all kinds pass over it.
  double work(double order) const;
};

/// The lattice on which a passage costs least, found from the places and radii alone; none if that is no less than
/// cylinder by cylinder.
std::optional<Lattice> find_lattice(const std::vector<Cylinder>& cylinders);

/// The wave's partial waves −order … order, passed from every cylinder to every other.
class LatticePassage {
 public:
  LatticePassage(const Lattice& lattice, int order);
  /// What passes to a cylinder of one kind from one of another that stands `row`, `column` cells before it: orders
  /// (2m + 1, 2m + 1) with m ≤ order.
  void set(std::size_t to_kind, std::size_t from_kind, Eigen::Index row, Eigen::Index column,
           const Eigen::MatrixXcd& G);
  void transform();  ///< once, after all set()
  /// a += G b.
  void add(const WaveIndex& index, const Amplitudes& b, Amplitudes& a) const;

 private:
  using Complex = std::complex<double>;
  Eigen::Index cells() const { return padded_rows_ * padded_columns_; }
  Eigen::Index orders() const { return 2 * order_ + 1; }
  Eigen::Index channels() const { return static_cast<Eigen::Index>(lattice_.kinds) * orders(); }
  /// In place over the cells, `width` numbers a cell.
  void transform(std::vector<Complex>& grid, Eigen::Index width, int sign) const;

  Lattice lattice_;
  int order_;
  Eigen::Index padded_rows_, padded_columns_;
  std::vector<Complex> kernel_;  // channels × channels, column by column, a cell
};

}  // namespace hydro::cylinders
