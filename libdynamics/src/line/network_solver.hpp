#pragma once
/// \file  Linear equations of a network of lines: chains by their band, what they share by a small border. (D111)
#include <Eigen/Core>

#include <memory>
#include <vector>

#include "band_matrix.hpp"
#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// Solves what BandMatrix::solve() solves, but with the nodes of each tie moving as one: their rows are one equation,
/// the sum of them. Cost: one elimination of the band with seven more right-hand sides, and a sparse border of three
/// unknowns a tie and one tension a stretch between two, ordered once: O(nodes) where ties form trees.
class NetworkSolver {
 public:
  explicit NetworkSolver(const Line& line);
  ~NetworkSolver();
  NetworkSolver(const NetworkSolver&) = delete;
  NetworkSolver& operator=(const NetworkSolver&) = delete;

  /// As BandMatrix has it. Rows of tied nodes: what is in them is added up; all get the same solution.
  bool solve(BandMatrix& matrix, Eigen::VectorXd& b);
  bool solve(BandMatrix& matrix, BandMatrix::Columns& b);

  /// Unknowns of the border, and numbers in its factors after a solve().
  int border() const { return unknowns_; }
  long factor_entries() const;

 private:
  /// A stretch of rows between two stops, which are nodes that are held or tied.
  struct Span {
    int begin, end;                        ///< rows between the stops
    int tie[2] = {-1, -1};                 ///< of the stops; −1: held, or a free end
    int colour[2] = {0, 0};                ///< of its ties, neighbours differ
    int tension_row = -1, tension_at = 0;  ///< in the band, in the border; −1: it stays in the band
  };
  /// An equation of the border that is taken out of the band.
  struct Row {
    int at, equation;
    int own_begin, own_end;  ///< columns that are the node's own place
    int left, right;         ///< spans of the columns before and after; −1: none
    int own;                 ///< first unknown of its own place
  };
  static constexpr int columns = 7;  ///< three for each colour, and the tensions

  void find_spans(const Line& line);
  void add_span(const Line& line, int left, int right, int begin, int end);
  void find_rows(const Line& line);
  void take_out(BandMatrix& matrix, const BandMatrix::Columns& b);
  void put_units();
  void add_to_border(const Row& row, const double* entries, int first, int last);
  void add_up(const Row& row, int span, const double* entries, int from, int to, int first);
  bool solve_border();
  void put_back(BandMatrix::Columns& b);

  struct Border;
  int size_, unknowns_ = 0, width_ = 1;
  std::vector<Span> spans_;
  std::vector<Row> rows_;
  std::vector<int> colour_of_;  // of each node that is tied
  std::vector<double> saved_;   // entries of rows_, one after the other
  std::vector<double> scale_;   // of their units in the band
  /// Kept from call to call: one for a single right-hand side and one for several, so that neither makes room anew
  /// where calls take turns.
  struct Room {
    BandMatrix::Columns work, kept;
    Eigen::MatrixXd right, parts;  // of the border, then its solution; what a span takes of that
  };
  Room single_, several_;
  Room* room_ = &single_;
  BandMatrix::Columns one_;
  std::unique_ptr<Border> matrix_;
};

}  // namespace dynamics::line
