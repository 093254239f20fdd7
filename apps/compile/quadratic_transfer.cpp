#include "compile/quadratic_transfer.hpp"

#include <algorithm>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/potential/operations/headings.hpp"

namespace froude::compile {

using hydro::InputError, hydro::potential::QuadraticTransfer;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Headings round the whole circle, the first of which is not there again at its end: it is put there.
void close_circle(QuadraticTransfer& T) {
  if (!hydro::potential::goes_round(T.heading)) return;
  const std::size_t n = T.heading.size();
  std::vector<Matrices> closed;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j) closed.push_back(T.of_headings[i % n * n + j % n]);
  T.of_headings = std::move(closed);
  T.heading.push_back(T.heading.front() + 2 * std::numbers::pi);
}

QuadraticTransfer read(const scene::Located<std::filesystem::path>& file, const scene::SecondOrder& asked,
                       const hydro::Water& water, std::vector<std::string>& notes) {
  QuadraticTransfer out = hydro::potential::read_second_order(file.value, {.density = water.density,
                                                                           .gravity = water.gravity,
                                                                           .ulen = asked.ulen,
                                                                           .iperout = asked.iperout,
                                                                           .body = asked.body});
  notes.insert(notes.end(), out.notes.begin(), out.notes.end());
  close_circle(out);
  return out;
}

/// Which kinds of file a method takes.
void require_kind(bool right, const scene::Located<std::filesystem::path>& file, const char* needed) {
  if (!right)
    throw InputError(fmt::format("\"{}\" does not have what is asked for", file.value.filename().string()), file.place,
                     needed);
}

Matrices weighted(const Matrices& a, double by_a, const Matrices& b, double by_b) {
  Matrices out;
  for (std::size_t i = 0; i < 6; ++i) out[i] = by_a * a[i] + by_b * b[i];
  return out;
}

}  // namespace

hydro::Stencil between(const QuadraticTransfer& T, double heading) {
  const auto at = hydro::potential::between_headings(T.heading, heading);
  // The first heading is there again at the end of a closed circle, so that neighbours follow one another.
  if (at) return {.first = at->first, .weight = {1 - at->share, at->share}};
  throw InputError(fmt::format("waves go towards {:.4g} deg, and the second-order loads are for {:.4g} to {:.4g} deg",
                               heading / degree, T.heading.front() / degree, T.heading.back() / degree),
                   {}, "compute the loads for that heading too");
}

const Matrices& of_pair(const QuadraticTransfer& T, std::size_t h1, std::size_t h2) {
  if (!T.has(h1, h2))
    throw InputError(fmt::format("the second-order loads have no waves of {:.4g} and {:.4g} deg together",
                                 T.heading[h1] / degree, T.heading[h2] / degree),
                     {}, "compute the loads for all pairs of headings, or take long-crested waves");
  return T.at(h1, h2);
}

Matrices about(Matrices m, const Eigen::Vector3d& r) {
  if (m[0].size() == 0) return m;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    m[3 + i] += m[j] * r[static_cast<Eigen::Index>(k)] - m[k] * r[static_cast<Eigen::Index>(j)];
  }
  return m;
}

void require_little_outside(double share, const QuadraticTransfer& T, double accuracy) {
  if (share > accuracy)
    throw InputError(fmt::format("{:.2g} of the waves' energy is outside the frequencies of the second-order loads, "
                                 "{:.4g} to {:.4g} rad/s, more than the accuracy asked",
                                 share, T.omega.front(), T.omega.back()),
                     {}, "compute the loads at more frequencies, or ask for other waves");
}

void refuse_newman() {
  throw InputError("Newman's approximation is for waves of one heading", {},
                   "take method = \"full\" with all pairs of headings, or \"mean\"");
}

Matrices of_heading(const QuadraticTransfer& T, double heading) {
  const hydro::Stencil s = between(T, heading);
  const Matrices& first = of_pair(T, s.first, s.first);
  if (s.weight[1] == 0) return weighted(first, s.weight[0], first, 0);
  return weighted(first, s.weight[0], of_pair(T, s.first + 1, s.first + 1), s.weight[1]);
}

QuadraticTransfer of_equal_waves(QuadraticTransfer T) {
  for (Matrices& of : T.of_headings)
    for (Eigen::MatrixXcd& m : of)
      if (m.cols() > 1) m = m.diagonal().eval();
  return T;
}

Matrices of_two_headings(const QuadraticTransfer& T, double first, double second) {
  const hydro::Stencil h1 = between(T, first), h2 = between(T, second);
  Matrices out = weighted(of_pair(T, h1.first, h2.first), 0, of_pair(T, h1.first, h2.first), 0);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      if (const double w = h1.weight[i] * h2.weight[j]; w != 0)
        out = weighted(out, 1, of_pair(T, h1.first + i, h2.first + j), w);
  return out;
}

SecondOrderFiles read_second_order_files(const scene::SecondOrder& asked, const hydro::Water& water,
                                         std::vector<std::string>& notes) {
  using Kind = QuadraticTransfer::Kind;
  SecondOrderFiles out{read(asked.file, asked, water, notes), {}};
  require_kind(out.difference.kind != Kind::sum, asked.file, "name a file of sum frequencies as `sum`");
  require_kind(asked.method != scene::SecondOrder::Method::full || out.difference.kind == Kind::difference, asked.file,
               "method = \"full\" needs .10d, .11d or .12d; a mean drift serves \"newman\" and \"mean\"");
  if (!asked.sum) return out;
  out.sum = read(*asked.sum, asked, water, notes);
  require_kind(out.sum->kind == Kind::sum, *asked.sum, "`sum` takes .10s, .11s or .12s");
  return out;
}

}  // namespace froude::compile
