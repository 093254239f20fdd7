#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "potential/readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// 17 significant digits: what is read back is the very double that was written.
std::string number(double value) { return fmt::format("{:24.16e}", value); }

void append_radiation(std::string& text, const Coefficients& c, double per, const Eigen::MatrixXd& A,
                      const Eigen::MatrixXd* B, double omega, double ulen) {
  const double rho = c.water.density;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double scale = rho * added_mass_scale(i, j, ulen);
      text += fmt::format("{} {:5} {:5} {}", number(per), i + 1, j + 1, number(A(i, j) / scale));
      if (B != nullptr) text += ' ' + number((*B)(i, j) / (scale * omega));
      text += '\n';
    }
}

double period_of(double omega) { return 2 * std::numbers::pi / omega; }

std::string radiation_text(const Coefficients& c, double ulen) {
  std::string text;
  if (c.A_zero) append_radiation(text, c, -1, *c.A_zero, nullptr, 0, ulen);
  if (c.A_inf) append_radiation(text, c, 0, *c.A_inf, nullptr, 0, ulen);
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    append_radiation(text, c, period_of(c.omega[k]), c.A[k], &c.B[k], c.omega[k], ulen);
  return text;
}

std::string excitation_text(const Coefficients& c, double ulen) {
  std::string text;
  const double rho_g = c.water.density * c.water.gravity;
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    for (std::size_t b = 0; b < c.heading.size(); ++b)
      for (Eigen::Index i = 0; i < c.modes(); ++i) {
        const auto X = c.X[b](i, static_cast<Eigen::Index>(k)) / (rho_g * excitation_scale(i, ulen));
        text += fmt::format("{} {} {:5} {} {} {} {}\n", number(period_of(c.omega[k])),
                            number(Angle::from_radians(c.heading[b]).degrees()), i + 1, number(std::abs(X)),
                            number(Angle::from_radians(std::arg(X)).degrees()), number(X.real()), number(X.imag()));
      }
  return text;
}

std::string restoring_text(const Coefficients& c, double ulen) {
  std::string text;
  const double rho_g = c.water.density * c.water.gravity;
  for (Eigen::Index i = 0; i < c.modes(); ++i)
    for (Eigen::Index j = 0; j < c.modes(); ++j)
      text += fmt::format("{:5} {:5} {}\n", i + 1, j + 1, number((*c.C)(i, j) / (rho_g * restoring_scale(i, j, ulen))));
  return text;
}

/// A file left from an earlier set would be read as part of this one.
void refuse_stale(const fs::path& file, bool is_written, const char* what) {
  if (!is_written && fs::exists(file))
    throw InputError(fmt::format("\"{}\" stands there already, and there is no {} to replace it", file.string(), what),
                     {}, "remove that file or choose another stem");
}

std::vector<std::string> explain(const Coefficients& c, double ulen) {
  std::vector<std::string> left_out{fmt::format(
      "density {} kg/m³, gravity {} m/s², depth {} and ULEN {} m: WAMIT's numeric files do not hold them; state them "
      "on reading",
      c.water.density, c.water.gravity,
      c.water.depth.is_infinite() ? std::string("infinite") : fmt::format("{} m", c.water.depth.metres()), ulen)};
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    const BodyData& body = c.body[b];
    if (body.name != fmt::format("body{}", b + 1))
      left_out.push_back(fmt::format("the name of body \"{}\"", body.name));
    const auto point = [&](const std::optional<Eigen::Vector3d>& p, const char* what) {
      if (p)
        left_out.push_back(
            fmt::format("the {} of body \"{}\": ({:.6g}, {:.6g}, {:.6g}) m", what, body.name, p->x(), p->y(), p->z()));
    };
    point(body.reference_point, "reference point (XBODY)");
    point(body.centre_of_gravity, "centre of gravity");
    point(body.centre_of_buoyancy, "centre of buoyancy");
    if (body.displaced_volume)
      left_out.push_back(
          fmt::format("the displaced volume of body \"{}\": {:.6g} m³", body.name, *body.displaced_volume));
  }
  if (!c.notes.empty()) left_out.push_back("notes on where the data come from");
  return left_out;
}

}  // namespace

std::vector<std::string> write_wamit(const Coefficients& c, const fs::path& stem, double ulen) {
  c.validate();
  require(std::isfinite(ulen) && ulen > 0, "ULEN must be positive, got {} m", ulen);
  const fs::path excitation = stem.string() + ".3", restoring = stem.string() + ".hst";
  refuse_stale(excitation, !c.X.empty(), "excitation");
  refuse_stale(restoring, c.C.has_value(), "restoring matrix");
  io::write_atomically(fs::path(stem.string() + ".1"), radiation_text(c, ulen));
  if (!c.X.empty()) io::write_atomically(excitation, excitation_text(c, ulen));
  if (c.C) io::write_atomically(restoring, restoring_text(c, ulen));
  return explain(c, ulen);
}

}  // namespace hydro::potential
