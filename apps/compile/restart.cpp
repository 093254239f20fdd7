#include "compile/restart.hpp"

#include "dynamics/model/assemble.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {
namespace {

namespace dl = dynamics::line;

/// Orthonormal columns x with `constraints` x = 0.
Eigen::MatrixXd free_directions(const Eigen::MatrixXd& constraints, Eigen::Index unknowns) {
  if (constraints.rows() == 0 || unknowns == 0) return Eigen::MatrixXd::Identity(unknowns, unknowns);
  const auto svd = hydro::dense::svd(constraints.transpose() * constraints);
  Eigen::Index rank = 0;
  while (rank < unknowns && svd.values[rank] > 1e-12 * svd.values[0]) ++rank;
  return svd.V.rightCols(unknowns - rank);
}

/// Of all bodies, rows of modes that are not free zero.
Eigen::MatrixXd body_directions(const dynamics::Model& model, const dynamics::State& state) {
  std::vector<int> free;
  for (int mode = 0; mode < model.modes(); ++mode)
    if (model.is_free(mode)) free.push_back(mode);
  Eigen::MatrixXd constraints(0, std::ssize(free));
  if (model.joints().count() > 0) {
    const Eigen::MatrixXd all = model.joints().dense(model.joints().gradients(state));
    constraints = all(Eigen::all, free);
  }
  const Eigen::MatrixXd own = free_directions(constraints, std::ssize(free));
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(model.modes(), own.cols());
  for (std::size_t i = 0; i < free.size(); ++i) out.row(free[i]) = own.row(static_cast<Eigen::Index>(i));
  return out;
}

std::vector<int> free_nodes(const dl::Line& line) {
  std::vector<int> out;
  for (int i = 0; i < line.nodes(); ++i)
    if (line.moves(i)) out.push_back(i);
  return out;
}

void close(const dynamics::Model& model, dynamics::State& state) {
  const std::vector<bool> none_kept(state.pose.size(), false);
  dynamics::close_joints(model, none_kept, state);
  dynamics::close_joint_velocities(model, none_kept, state);
}

/// Gradients of the kept lengths by the places of the free nodes: unit vectors along the links.
Eigen::MatrixXd length_gradients(const dl::Line& line, const dl::State& s) {
  const auto nodes = free_nodes(line);
  std::vector<int> kept;
  for (int j = 0; j < line.segments(); ++j)
    if (line.segment(j).is_inextensible()) kept.push_back(j);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(std::ssize(kept), 3 * std::ssize(nodes));
  for (std::size_t r = 0; r < kept.size(); ++r) {
    const int i = line.first(kept[r]);
    const Eigen::RowVector3d along = (s.position.col(i + 1) - s.position.col(i)).normalized().transpose();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(r);
      if (nodes[n] == line.same_as(i + 1)) out.block<1, 3>(row, 3 * static_cast<Eigen::Index>(n)) += along;
      if (nodes[n] == line.same_as(i)) out.block<1, 3>(row, 3 * static_cast<Eigen::Index>(n)) -= along;
    }
  }
  return out;
}

/// By how much the kept lengths are off; and at what rate.
Eigen::VectorXd length_errors(const dl::Line& line, const dl::State& s, bool rates) {
  std::vector<double> out;
  for (int j = 0; j < line.segments(); ++j) {
    if (!line.segment(j).is_inextensible()) continue;
    const int i = line.first(j);
    const Eigen::Vector3d way = s.position.col(i + 1) - s.position.col(i);
    out.push_back(rates ? way.normalized().dot(s.velocity.col(i + 1) - s.velocity.col(i))
                        : way.norm() - line.segment(j).length);
  }
  return Eigen::Map<const Eigen::VectorXd>(out.data(), std::ssize(out));
}

void add_to_free(const dl::Line& line, const Eigen::VectorXd& change, dl::Places& places) {
  const auto nodes = free_nodes(line);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    places.col(nodes[n]) += change.segment<3>(3 * static_cast<Eigen::Index>(n));
  for (int i = 0; i < line.nodes(); ++i) places.col(i) = places.col(line.same_as(i)).eval();
}

}  // namespace

void restore_lengths(const dl::Line& line, dl::State& s) {
  for (int i = 0;; ++i) {
    const Eigen::VectorXd off = length_errors(line, s, false);
    if (off.size() == 0) return;
    if (off.cwiseAbs().maxCoeff() < 1e-13 * line.length()) break;
    if (i == 30) throw hydro::NumericsError("the links of a line cannot be brought to their lengths");
    add_to_free(line, length_gradients(line, s).completeOrthogonalDecomposition().solve(-off), s.position);
  }
  const Eigen::VectorXd off = length_errors(line, s, true);
  add_to_free(line, length_gradients(line, s).completeOrthogonalDecomposition().solve(-off), s.velocity);
}

MovingState start_of(const TimeModel& model) {
  MovingState out{model.start, {}, {}};
  for (const auto& line : model.lines) out.lines.push_back(line.start);
  return out;
}

std::string kept_memory(const TimeModel& model) {
  const dynamics::Workspace workspace(model.model, model.start);
  for (std::size_t k = 0; k < workspace.memory.size(); ++k)
    if (workspace.needs_memory(k)) return std::string(model.model.forces()[k]->effect());
  return "";
}

StateChart::StateChart(const TimeModel& model, MovingState middle) : middle_(std::move(middle)) {
  directions_.push_back(body_directions(model.model, middle_.bodies));
  for (std::size_t k = 0; k < model.lines.size(); ++k) {
    const dl::Line& line = *model.lines[k].line;
    directions_.push_back(free_directions(length_gradients(line, middle_.lines[k]), 3 * std::ssize(free_nodes(line))));
  }
}

Eigen::Index StateChart::coordinates() const {
  Eigen::Index out = 0;
  for (const auto& d : directions_) out += 2 * d.cols();
  return out;
}

MovingState StateChart::at(const TimeModel& model, const Eigen::VectorXd& coordinates) const {
  MovingState out = middle_;
  if (coordinates.size() == 0 || coordinates.isZero(0)) return out;
  const Eigen::MatrixXd& bodies = directions_.front();
  Eigen::Index from = 2 * bodies.cols();
  if (bodies.cols() > 0) {
    out.bodies = dynamics::moved(out.bodies, bodies * coordinates.head(bodies.cols()));
    out.bodies.velocity += bodies * coordinates.segment(bodies.cols(), bodies.cols());
    close(model.model, out.bodies);
  }
  for (std::size_t k = 0; k < out.lines.size(); ++k) {
    const Eigen::MatrixXd& d = directions_[k + 1];
    const dl::Line& line = *model.lines[k].line;
    add_to_free(line, d * coordinates.segment(from, d.cols()), out.lines[k].position);
    add_to_free(line, d * coordinates.segment(from + d.cols(), d.cols()), out.lines[k].velocity);
    restore_lengths(line, out.lines[k]);
    from += 2 * d.cols();
  }
  return out;
}

void start_from(const MovingState& state, TimeModel& model) {
  model.start = state.bodies;
  // A step keeps joints and lengths at its end, but velocities only in its mean.
  close(model.model, model.start);
  for (std::size_t k = 0; k < model.lines.size(); ++k) {
    model.lines[k].start = state.lines[k];
    model.lines[k].start.time = state.bodies.time;
    restore_lengths(*model.lines[k].line, model.lines[k].start);
    if (!state.angles.empty()) model.lines[k].before = state.angles[k];
  }
}

}  // namespace froude::compile
