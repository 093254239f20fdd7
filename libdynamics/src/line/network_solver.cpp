#include "network_solver.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/kept_lu.hpp"

namespace dynamics::line {
namespace {

int place_row(int node) { return 4 * node + 1; }

}  // namespace

struct NetworkSolver::Border {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::SparseMatrix<double> matrix;
  std::vector<std::size_t> place;  // of each entry, in their order, among the values of `matrix`
  KeptSparseLu lu;

  /// Entries of one place are added up, in their order.
  void fill(int size) {
    if (place.empty()) sort(size);
    std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
    for (std::size_t k = 0; k < entries.size(); ++k) matrix.valuePtr()[place[k]] += entries[k].value();
  }

 private:
  void sort(int size) {
    matrix.resize(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    place.reserve(entries.size());
    for (const auto& e : entries)
      place.push_back(static_cast<std::size_t>(&matrix.coeffRef(e.row(), e.col()) - matrix.valuePtr()));
  }
};

NetworkSolver::NetworkSolver(const Line& line) : size_(4 * line.nodes()), matrix_(std::make_unique<Border>()) {
  unknowns_ = 3 * static_cast<int>(line.description().ties.size());
  find_spans(line);
  find_rows(line);
  scale_.assign(rows_.size(), 1);
}

NetworkSolver::~NetworkSolver() = default;

long NetworkSolver::factor_entries() const { return matrix_->lu.entries(); }

/// Between two stops one tension goes to the border: a straight stretch of fixed lengths has one more of them than its
/// nodes can balance while both stops stay where they are. The rest hangs from one stop, which always has a solution.
void NetworkSolver::add_span(const Line& line, int left, int right, int begin, int end) {
  Span s{.begin = begin, .end = end};
  const int stops[2] = {left, right};
  for (int k = 0; k < 2; ++k) {
    if (stops[k] < 0) continue;
    s.tie[k] = line.tie(stops[k]);
    if (s.tie[k] >= 0) s.colour[k] = colour_of_[static_cast<std::size_t>(stops[k])];
  }
  if (left >= 0 && right >= 0 && (s.tie[0] >= 0 || s.tie[1] >= 0)) {
    s.tension_row = s.tie[1] >= 0 ? 4 * right : 4 * (left + 1);
    s.tension_at = unknowns_++;
  }
  spans_.push_back(s);
}

void NetworkSolver::find_spans(const Line& line) {
  colour_of_.assign(static_cast<std::size_t>(line.nodes()), 0);
  for (int c = 0; c < line.chains(); ++c) {
    int stop = -1, begin = 4 * line.first_of_chain(c), ties = 0;
    for (int i = line.first_of_chain(c); i <= line.last_of_chain(c); ++i) {
      const bool end_of_chain = line.before(i) < 0 || line.after(i) < 0;
      // A line that bends over a node that holds it has equations across that.
      const bool stops = line.tie(i) >= 0 || (line.held(i) != nullptr && (end_of_chain || line.bending(i) == 0));
      if (!stops) continue;
      if (line.tie(i) >= 0) colour_of_[static_cast<std::size_t>(i)] = ties++ % 2;
      if (line.before(i) >= 0) add_span(line, stop, i, begin, place_row(i));
      stop = i;
      begin = place_row(i) + 3;
    }
    if (stop < line.last_of_chain(c)) add_span(line, stop, -1, begin, 4 * line.last_of_chain(c) + 4);
  }
}

void NetworkSolver::find_rows(const Line& line) {
  const auto span_of = [&](int row) {
    for (std::size_t k = 0; k < spans_.size(); ++k)
      if (row >= spans_[k].begin && row < spans_[k].end) return static_cast<int>(k);
    return -1;
  };
  for (int i = 0; i < line.nodes(); ++i) {
    if (line.tie(i) < 0) continue;
    const int left = line.before(i) < 0 ? -1 : span_of(4 * i), right = line.after(i) < 0 ? -1 : span_of(4 * (i + 1));
    for (int r = 0; r < 3; ++r)
      rows_.push_back(
          {place_row(i) + r, 3 * line.tie(i) + r, place_row(i), place_row(i) + 3, left, right, 3 * line.tie(i)});
  }
  for (std::size_t k = 0; k < spans_.size(); ++k)
    if (const Span& s = spans_[k]; s.tension_row >= 0)
      rows_.push_back({s.tension_row, s.tension_at, size_, size_, static_cast<int>(k), -1, -1});
}

/// The border's equations leave the band, whose own then say that the border's unknowns are what is put into them.
void NetworkSolver::take_out(BandMatrix& matrix, const BandMatrix::Columns& b) {
  const int half = matrix.half(), room = 2 * half + 1;
  width_ = static_cast<int>(b.cols());
  room_ = width_ == 1 ? &single_ : &several_;
  BandMatrix::Columns& work = room_->work;
  work.setZero(size_, width_ + columns);
  work.leftCols(width_) = b;
  room_->kept.resize(static_cast<Eigen::Index>(rows_.size()), width_);
  saved_.assign(rows_.size() * static_cast<std::size_t>(room), 0);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const int at = rows_[k].at;
    double* to = &saved_[k * static_cast<std::size_t>(room)];
    double largest = 0;
    for (int c = std::max(0, at - half); c <= std::min(size_ - 1, at + half); ++c) {
      to[c - at + half] = matrix(at, c);
      largest = std::max(largest, std::abs(matrix(at, c)));
      matrix(at, c) = 0;
    }
    scale_[k] = largest > 0 ? largest : 1;
    matrix(at, at) = scale_[k];
    room_->kept.row(static_cast<Eigen::Index>(k)) = b.row(at);
    work.row(at).setZero();
  }
}

void NetworkSolver::put_units() {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    const int column =
        row.own < 0 ? 6 : 3 * colour_of_[static_cast<std::size_t>(row.at / 4)] + (row.at - row.own_begin);
    room_->work(row.at, width_ + column) = scale_[k];
  }
}

/// The share of columns `from` to `to` of a row, which see the stops and the tension of one span.
void NetworkSolver::add_up(const Row& row, int span, const double* entries, int from, int to, int first) {
  if (span < 0) return;
  const Span& s = spans_[static_cast<std::size_t>(span)];
  double sum[columns] = {};
  for (int q = from; q < to; ++q) {
    const double value = entries[q - first];
    if (value == 0) continue;
    const double* y = &room_->work(q, 0);
    for (int m = 0; m < width_; ++m) room_->right(row.equation, m) -= value * y[m];
    for (int k = 0; k < columns; ++k) sum[k] += value * y[width_ + k];
  }
  for (int end = 0; end < 2; ++end)
    for (int c = 0; s.tie[end] >= 0 && c < 3; ++c)
      matrix_->entries.emplace_back(row.equation, 3 * s.tie[end] + c, sum[3 * s.colour[end] + c]);
  if (s.tension_row >= 0) matrix_->entries.emplace_back(row.equation, s.tension_at, sum[6]);
}

void NetworkSolver::add_to_border(const Row& row, const double* entries, int first, int last) {
  add_up(row, row.left, entries, first, std::min(row.own_begin, last), first);
  for (int c = 0; row.own >= 0 && c < 3; ++c)
    matrix_->entries.emplace_back(row.equation, row.own + c, entries[row.own_begin + c - first]);
  add_up(row, row.right, entries, std::min(row.own_end, last), last, first);
}

bool NetworkSolver::solve_border() {
  Border& b = *matrix_;
  double sum = room_->right.sum();
  for (const auto& e : b.entries) sum += e.value();
  if (!std::isfinite(sum)) return false;
  b.fill(unknowns_);
  if (!b.lu.factorise(b.matrix)) return false;
  b.lu.solve_in_place(room_->right);
  return room_->right.allFinite();
}

void NetworkSolver::put_back(BandMatrix::Columns& b) {
  const BandMatrix::Columns& work = room_->work;
  const Eigen::MatrixXd& right = room_->right;
  b = work.leftCols(width_);
  Eigen::MatrixXd& z = room_->parts;
  for (const Span& s : spans_) {
    z.setZero(columns, width_);
    for (int end = 0; end < 2; ++end)
      if (s.tie[end] >= 0) z.middleRows<3>(3 * s.colour[end]) = right.middleRows<3>(3 * s.tie[end]);
    if (s.tension_row >= 0) z.row(6) = right.row(s.tension_at);
    for (int q = s.begin; q < s.end; ++q) {
      const double* y = &work(q, width_);
      for (int m = 0; m < width_; ++m)
        for (int k = 0; k < columns; ++k) b(q, m) += y[k] * z(k, m);
    }
  }
  for (const Row& row : rows_) b.row(row.at) = right.row(row.equation);
}

bool NetworkSolver::solve(BandMatrix& matrix, BandMatrix::Columns& b) {
  take_out(matrix, b);
  put_units();
  if (!matrix.solve(room_->work)) return false;
  room_->right.setZero(unknowns_, width_);
  matrix_->entries.clear();
  const int half = matrix.half(), room = 2 * half + 1;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    room_->right.row(row.equation) += room_->kept.row(static_cast<Eigen::Index>(k));
    const int first = std::max(0, row.at - half), last = std::min(size_, row.at + half + 1);
    add_to_border(row, &saved_[k * static_cast<std::size_t>(room)] + (first - row.at + half), first, last);
  }
  if (!solve_border()) return false;
  put_back(b);
  return true;
}

bool NetworkSolver::solve(BandMatrix& matrix, Eigen::VectorXd& b) {
  one_ = b;
  if (!solve(matrix, one_)) return false;
  b = one_;
  return true;
}

}  // namespace dynamics::line
