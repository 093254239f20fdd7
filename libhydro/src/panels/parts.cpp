#include "parts.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace hydro::panels {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using potential::Coefficients;
using Corners = std::vector<Vector3d>;
using Generalised = Eigen::Matrix<double, 6, 1>;

/// A section and its body.
struct Cut {
  int body;
  const HullSection& section;
};

std::vector<Cut> cuts_of(const std::vector<HullBody>& bodies) {
  std::vector<Cut> out;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const HullSection& section : bodies[b].sections) out.push_back({static_cast<int>(b), section});
  return out;
}

Corners in_image(const Panel& panel, const Image& image) {
  Corners out;
  for (const Vector3d& p : panel.shape.corners) out.emplace_back(image * p);
  if (image.x * image.y < 0) std::reverse(out.begin(), out.end());
  return out;
}

Vector3d twice_area(const Corners& c) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < c.size(); ++i) sum += (c[i] - c[0]).cross(c[i + 1] - c[0]);
  return sum;
}

/// What of a convex figure is on the part. A figure in the plane itself bounds the part that is behind it, seen from
/// the water.
Corners on_part(const Corners& figure, const HullSection& section, double near) {
  std::vector<double> height;
  for (const Vector3d& p : figure) height.push_back(section.normal.dot(p - section.at));
  if (std::all_of(height.begin(), height.end(), [&](double h) { return std::abs(h) <= near; }))
    return section.normal.dot(twice_area(figure)) < 0 ? figure : Corners{};
  Corners out;
  for (std::size_t i = 0; i < figure.size(); ++i) {
    const std::size_t j = (i + 1) % figure.size();
    if (height[i] >= 0) out.push_back(figure[i]);
    if (height[i] * height[j] < 0)
      out.emplace_back(figure[i] + (figure[j] - figure[i]) * (height[i] / (height[i] - height[j])));
  }
  return out;
}

/// Calls `use(row of the panel in its image, figure)` for all that is on the part.
template <class Use>
void for_all_pieces(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut, Use use) {
  constexpr double rounding = 1e-9;  // of the hull's diagonal
  const double near = rounding * bodies[static_cast<std::size_t>(cut.body)].hull.diagonal();
  Index row = 0;
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i, ++row) {
      if (mesh.body_of[i][s] != cut.body) continue;
      const Corners figure = on_part(in_image(mesh.hull[i], mesh.images[s]), cut.section, near);
      if (figure.size() > 2) use(row, figure);
    }
}

/// The largest extent along the normal of what the plane divides; zero where it goes along edges of panels.
double extent_of_divided(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut) {
  constexpr double rounding = 1e-9;  // of the hull's diagonal
  const double near = rounding * bodies[static_cast<std::size_t>(cut.body)].hull.diagonal();
  double out = 0;
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i) {
      if (mesh.body_of[i][s] != cut.body) continue;
      double low = 0, high = 0;
      for (const Vector3d& p : in_image(mesh.hull[i], mesh.images[s])) {
        const double height = cut.section.normal.dot(p - cut.section.at);
        low = std::min(low, height);
        high = std::max(high, height);
      }
      if (low < -near && high > near) out = std::max(out, high - low);
    }
  return out;
}

/// n and (x − about) × n.
Generalised generalised(const Vector3d& normal, const Vector3d& at, const Vector3d& about) {
  Generalised out;
  out << normal, (at - about).cross(normal);
  return out;
}

/// Calls `use(point, n times its weight)` for the middles of sides of the triangles of a figure: exact for polynomials
/// of second degree.
template <class Use>
void integrate(const Corners& c, Use use) {
  for (std::size_t i = 1; i + 1 < c.size(); ++i) {
    const Vector3d third = (c[i] - c[0]).cross(c[i + 1] - c[0]) / 6;
    use(Vector3d((c[0] + c[i]) / 2), third);
    use(Vector3d((c[i] + c[i + 1]) / 2), third);
    use(Vector3d((c[i + 1] + c[0]) / 2), third);
  }
}

/// (G25): heave, roll and pitch of the body lower the pressure at its panels.
potential::Matrix6 hydrostatic_rows(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut,
                                    const Water& water) {
  const Vector3d about = bodies[static_cast<std::size_t>(cut.body)].reference_point;
  potential::Matrix6 C = potential::Matrix6::Zero();
  for_all_pieces(mesh, bodies, cut, [&](Index, const Corners& figure) {
    integrate(figure, [&](const Vector3d& at, const Vector3d& normal) {
      const Vector3d from = at - about;
      Eigen::Matrix<double, 1, 6> rise;
      rise << 0, 0, 1, from.y(), -from.x(), 0;
      C -= water.density * water.gravity * generalised(normal, at, about) * rise;
    });
  });
  return C;
}

/// The part's share of the wet area of its hull.
double share_of_area(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut) {
  double part = 0, whole = 0;
  for_all_pieces(mesh, bodies, cut, [&](Index, const Corners& figure) { part += twice_area(figure).norm() / 2; });
  for (std::size_t s = 0; s < mesh.images.size(); ++s)
    for (std::size_t i = 0; i < mesh.hull.size(); ++i)
      if (mesh.body_of[i][s] == cut.body) whole += mesh.hull[i].shape.area;
  return part / whole;
}

/// Rows of the bodies, which stay zero, and then those of the parts.
template <class Matrix>
Matrix below_bodies(const Matrix& rows, Index modes, Index columns) {
  Matrix out = Matrix::Zero(modes + rows.rows(), columns);
  out.bottomLeftCorner(rows.rows(), rows.cols()) = rows;
  return out;
}

}  // namespace

namespace {

using LoadRows = Eigen::Matrix<double, 6, Eigen::Dynamic>;

LoadRows load_rows(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut) {
  LoadRows out = LoadRows::Zero(6, mesh.hull_panels());
  const Vector3d about = bodies[static_cast<std::size_t>(cut.body)].reference_point;
  for_all_pieces(mesh, bodies, cut, [&](Index row, const Corners& figure) {
    integrate(figure,
              [&](const Vector3d& at, const Vector3d& normal) { out.col(row) += generalised(normal, at, about); });
  });
  return out;
}

/// (G30): the second difference of the rows, over the extent of the panels that the plane divides.
LoadRows bend_of_rows(const PanelMesh& mesh, const std::vector<HullBody>& bodies, const Cut& cut) {
  const double h = extent_of_divided(mesh, bodies, cut);
  if (h == 0) return LoadRows::Zero(6, mesh.hull_panels());
  HullSection ahead = cut.section, behind = cut.section;
  ahead.at += h * ahead.normal;
  behind.at -= h * behind.normal;
  return load_rows(mesh, bodies, {cut.body, ahead}) - 2 * load_rows(mesh, bodies, cut) +
         load_rows(mesh, bodies, {cut.body, behind});
}

}  // namespace

MatrixXd load_rows_of_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies) {
  const std::vector<Cut> cuts = cuts_of(bodies);
  const auto half = 6 * static_cast<Index>(cuts.size());
  MatrixXd out(2 * half, mesh.hull_panels());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    out.middleRows<6>(6 * static_cast<Index>(c)) = load_rows(mesh, bodies, cuts[c]);
    out.middleRows<6>(half + 6 * static_cast<Index>(c)) = bend_of_rows(mesh, bodies, cuts[c]);
  }
  return out;
}

OneFrequency with_division_doubted(const OneFrequency& result, const OneFrequency& coarsest) {
  constexpr double worst_of_cuts = 0.07;  // (G30)
  OneFrequency out = result;
  const Index half = out.A_parts.rows() / 2;
  out.A_parts.topRows(half) += worst_of_cuts * coarsest.A_parts.bottomRows(half);
  out.B_parts.topRows(half) += worst_of_cuts * coarsest.B_parts.bottomRows(half);
  out.X_parts.topRows(half) += worst_of_cuts * coarsest.X_parts.bottomRows(half);
  return out;
}

// What made A and B of the whole symmetric and passive is shared out by area, so that parts still add up to the whole.
Coefficients loads_on_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies,
                            const std::vector<OneFrequency>& results, const Coefficients& whole) {
  const std::vector<Cut> cuts = cuts_of(bodies);
  const Index modes = whole.modes(), rows = 6 * static_cast<Index>(cuts.size()), all = modes + rows;
  Coefficients out;
  out.water = whole.water;
  out.omega = whole.omega;
  out.heading = whole.heading;
  out.source = whole.source;
  const auto add_body = [&](const std::string& name, const Vector3d& about) {
    out.body.push_back({name, about, std::nullopt, std::nullopt, std::nullopt});
  };
  for (const HullBody& body : bodies) add_body(body.name, body.reference_point);
  MatrixXd share = MatrixXd::Zero(rows, modes), C = MatrixXd::Zero(rows, modes);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const auto& [body, section] = cuts[c];
    const HullBody& of = bodies[static_cast<std::size_t>(body)];
    add_body(of.name + "." + section.name, of.reference_point);
    share.block<6, 6>(6 * static_cast<Index>(c), 6 * body).diagonal().setConstant(share_of_area(mesh, bodies, cuts[c]));
    C.block<6, 6>(6 * static_cast<Index>(c), 6 * body) = hydrostatic_rows(mesh, bodies, cuts[c], whole.water);
  }
  for (std::size_t w = 0; w < results.size(); ++w) {
    const OneFrequency& one = results[w];
    out.A.push_back(below_bodies<MatrixXd>(one.A_parts.topRows(rows) + share * (whole.A[w] - one.A), modes, all));
    out.B.push_back(below_bodies<MatrixXd>(one.B_parts.topRows(rows) + share * (whole.B[w] - one.B), modes, all));
  }
  for (Index h = 0; h < static_cast<Index>(out.heading.size()); ++h) {
    MatrixXcd X(rows, static_cast<Index>(results.size()));
    for (std::size_t w = 0; w < results.size(); ++w)
      X.col(static_cast<Index>(w)) = results[w].X_parts.topRows(rows).col(h);
    out.X.push_back(below_bodies<MatrixXcd>(X, modes, X.cols()));
  }
  out.C = below_bodies<MatrixXd>(C, modes, all);
  out.validate();
  return out;
}

Generalised still_water_load(const HullBody& body, const HullSection& section, const Water& water) {
  const std::vector<HullBody> alone{body};
  Generalised out = Generalised::Zero();
  for_all_pieces(panel_mesh(alone, water.depth, false), alone, {0, section}, [&](Index, const Corners& figure) {
    integrate(figure, [&](const Vector3d& at, const Vector3d& normal) {
      out += water.density * water.gravity * at.z() * generalised(normal, at, body.reference_point);
    });
  });
  return out;
}

void check_section(const HullBody& body, const HullSection& section) {
  require(section.at.allFinite() && std::abs(section.normal.norm() - 1) < 1e-9,
          "section \"{}\" of \"{}\" needs a finite point and a normal of unit length", section.name, body.name);
  double low = 0, high = 0;
  bool first = true;
  for (const Vector3d& p : body.hull.vertices()) {
    const double height = section.normal.dot(p - section.at);
    low = first ? height : std::min(low, height);
    high = first ? height : std::max(high, height);
    first = false;
  }
  const double near = 1e-6 * body.hull.diagonal();  // what welds corners of a mesh
  if (low <= near && high >= -near) return;
  throw InputError(fmt::format("section \"{}\" does not cut \"{}\": along its normal the hull reaches from {:.6g} m to "
                               "{:.6g} m, from the point of the section",
                               section.name, body.name, low, high),
                   {}, "put its point within the hull");
}

void require_parts_can_be_told(const std::vector<HullBody>& bodies, const Water& water, const Options& options) {
  if (cuts_of(bodies).empty()) return;
  for (const HullBody& body : bodies) {
    for (const HullSection& section : body.sections) check_section(body, section);
    require(!stands_on_bed(body, water.depth),
            "loads on parts of hulls are told of those that float; \"{}\" stands on "
            "the sea bed",
            body.name);
  }
  if (options.interaction == Interaction::partial_waves)
    throw InputError("loads on parts of hulls need pressures, which partial waves between hulls do not give", {},
                     "take all panels in one set of equations: mesh_interaction = \"panels\"");
  if (options.frequency_tolerance)
    throw InputError(
        "loads on parts of hulls are told at the frequencies that are asked for, not between those that a "
        "frequency_tolerance chooses",
        {}, "leave out frequency_tolerance, and name the frequencies");
}

}  // namespace hydro::panels
