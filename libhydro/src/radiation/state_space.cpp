#include "hydro/radiation/state_space.hpp"

#include <cmath>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/hdf5.hpp"

namespace hydro::radiation {
namespace {

/// One mode's oscillations: blocks [−a b; −b −a] with the input on the first state; outputs C and −S. (R12)
struct Realisation {
  Eigen::MatrixXd A;
  Eigen::VectorXd B;
};

Realisation of_poles(const PoleModel& model) {
  Realisation r{Eigen::MatrixXd::Zero(model.order(), model.order()), Eigen::VectorXd::Zero(model.order())};
  Eigen::Index at = 0;
  for (const Pole& p : model.poles) {
    r.A(at, at) = -p.decay;
    r.B[at] = 1;
    if (p.omega > 0) {
      r.A(at, at + 1) = p.omega;
      r.A(at + 1, at) = -p.omega;
      r.A(at + 1, at + 1) = -p.decay;
      ++at;
    }
    ++at;
  }
  return r;
}

Eigen::RowVectorXd output(const PoleModel& model, Eigen::Index i, Eigen::Index j) {
  Eigen::RowVectorXd row(model.order());
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < model.poles.size(); ++k) {
    row[at++] = model.C[k](i, j);
    if (model.poles[k].omega > 0) row[at++] = -model.S[k](i, j);
  }
  return row;
}

void require_whole_bodies(const PoleModel& model) {
  require(model.modes() > 0 && model.modes() % 6 == 0, "a state-space file holds six modes a body; the model has {}",
          model.modes());
}

void add_rows(std::string& text, const Eigen::MatrixXd& m) {
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) text += fmt::format("{}{:.17g}", j == 0 ? "" : " ", m(i, j));
    text += '\n';
  }
}

}  // namespace

StateSpace state_space(const PoleModel& model) {
  const Realisation one = of_poles(model);
  const Eigen::Index n = model.modes(), order = model.order();
  StateSpace s{Eigen::MatrixXd::Zero(n * order, n * order), Eigen::MatrixXd::Zero(n * order, n),
               Eigen::MatrixXd(n, n * order)};
  for (Eigen::Index j = 0; j < n; ++j) {
    s.A.block(j * order, j * order, order, order) = one.A;
    s.B.block(j * order, j, order, 1) = one.B;
    for (Eigen::Index i = 0; i < n; ++i) s.C.block(i, j * order, 1, order) = output(model, i, j);
  }
  return s;
}

void write_openfast(const PoleModel& model, const std::string& title, const std::filesystem::path& file) {
  require_whole_bodies(model);
  const StateSpace s = state_space(model);
  std::string text = title + "\n";
  for (int i = 0; i < model.modes(); ++i) text += i == 0 ? "1" : " 1";
  text += fmt::format("\n{}\n", s.A.rows());
  for (int i = 0; i < model.modes(); ++i) text += fmt::format("{}{}", i == 0 ? "" : " ", model.order());
  text += '\n';
  add_rows(text, s.A);
  add_rows(text, s.B);
  add_rows(text, -s.C);
  io::write_atomically(file, text);
}

void write_bemio_state_space(const PoleModel& model, double density, double step, double length,
                             const std::filesystem::path& file) {
  require_whole_bodies(model);
  require(density > 0 && step > 0 && length >= step, "a state-space file needs a density, a step and a longer length");
  const Realisation one = of_poles(model);
  const auto n = static_cast<std::size_t>(model.modes()), order = static_cast<std::size_t>(model.order());
  const auto samples = static_cast<std::size_t>(std::floor(length / step + 1e-9)) + 1;
  std::vector<double> t;
  std::vector<Eigen::MatrixXd> K;
  for (std::size_t i = 0; i < samples; ++i) {
    t.push_back(step * static_cast<double>(i));
    K.push_back(model.kernel(t.back()));
  }
  io::Hdf5Writer out;
  for (std::size_t body = 0; body < n / 6; ++body) {
    const std::string group = fmt::format("/body{}/hydro_coeffs/radiation_damping/", body + 1);
    std::vector<double> A, B, C, kernel;
    for (Eigen::Index i = 0; i < 6; ++i)
      for (Eigen::Index j = 0; j < model.modes(); ++j) {
        const Eigen::Index row = 6 * static_cast<Eigen::Index>(body) + i;
        for (Eigen::Index r = 0; r < model.order(); ++r)
          for (Eigen::Index c = 0; c < model.order(); ++c) A.push_back(one.A(r, c));
        B.insert(B.end(), one.B.begin(), one.B.end());
        const Eigen::RowVectorXd out_row = output(model, row, j) / density;
        C.insert(C.end(), out_row.begin(), out_row.end());
        for (const auto& sample : K) kernel.push_back(sample(row, j) / density);
      }
    out.write(group + "state_space/A/all", A, {6, n, order, order});
    out.write(group + "state_space/B/all", B, {6, n, order, 1});
    out.write(group + "state_space/C/all", C, {6, n, 1, order});
    out.write(group + "state_space/D/all", std::vector<double>(6 * n, 0.0), {6, n});
    out.write(group + "state_space/it", std::vector<double>(6 * n, static_cast<double>(order)), {6, n});
    out.write(group + "impulse_response_fun/K", kernel, {6, n, samples});
    out.write(group + "impulse_response_fun/t", t, {samples, 1});
  }
  out.save(file);
}

}  // namespace hydro::radiation
