#include "dynamics/force/member.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace dynamics {
namespace {

using hydro::waves::WaveField;

/// A vertical member has sections without rise; this much of the diameter keeps the derivatives finite.
constexpr double least_rise = 1e-6;

/// Gauss' two points lie at ± this share of a piece from its middle, 1/(2√3): loads up to the third power of the place
/// are summed exactly.
constexpr double off_middle = 0.28867513459481288;

}  // namespace

PlacedMember placed(const SlenderMember& member, const State& state) {
  const Pose& pose = state.pose[static_cast<std::size_t>(member.body)];
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  PlacedMember out;
  out.centre = pose.centre;
  out.from = R * member.from;
  out.along = R * (member.to - member.from);
  out.length = out.along.norm();
  out.axis = out.along / out.length;
  out.velocity = state.twist(member.body).head<3>();
  out.omega = state.twist(member.body).tail<3>();
  out.rise = member.diameter * std::sqrt(std::max(0.0, 1 - out.axis.z() * out.axis.z()) + least_rise * least_rise);
  return out;
}

std::vector<double> heights(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t) {
  std::vector<double> g;
  find_heights(member, at, water, t, g);
  return g;
}

void find_heights(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t,
                  std::vector<double>& g) {
  g.assign(static_cast<std::size_t>(member.pieces) + 1, std::numeric_limits<double>::infinity());
  if (member.immersion == Immersion::whole) return;
  for (std::size_t j = 0; j < g.size(); ++j) {
    const Eigen::Vector3d p = at.centre + at.arm(static_cast<double>(j) / member.pieces);
    g[j] = -p.z();
    if (member.immersion == Immersion::surface) g[j] += water.elevation(t, p.x(), p.y());
  }
}

double wetness(double height, double rise) { return std::clamp(0.5 + height / rise, 0.0, 1.0); }

WetShare wet_share(double g0, double g1, double h) {
  // (D42): β is straight between the places where the surface leaves and meets the section's lowest and highest points.
  const double d = g1 - g0;
  const auto crossing = [&](double level) { return (g0 - level) * (g1 - level) < 0 ? (level - g0) / d : 0.0; };
  std::array<double, 4> s{0, crossing(-h / 2), crossing(h / 2), 1};
  std::sort(s.begin(), s.end());
  double share = 0, moment = 0;
  Eigen::Vector3d share_by = Eigen::Vector3d::Zero(), moment_by = share_by;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const double a = s[i], b = s[i + 1], length = b - a;
    if (length == 0) continue;
    // Between two crossings a section is all wet, all dry, or in between throughout; asked at a crossing itself,
    // round-off of g over a small h would make it something else.
    const double middle = g0 + d * (a + b) / 2;
    const bool between = std::abs(middle) < h / 2;
    const double wet_a = wetness(between ? g0 + d * a : middle, h), wet_b = wetness(between ? g0 + d * b : middle, h);
    share += length * (wet_a + wet_b) / 2;
    moment += length * (a * (wet_a + wet_b) / 2 + length * (wet_a + 2 * wet_b) / 6);
    if (!between) continue;  // wholly wet or dry stays so
    const double m0 = length, m1 = (b * b - a * a) / 2, m2 = (b * b * b - a * a * a) / 3;
    share_by += Eigen::Vector3d(m0 - m1, m1, -(g0 * m0 + d * m1) / h) / h;
    moment_by += Eigen::Vector3d(m1 - m2, m2, -(g0 * m1 + d * m2) / h) / h;
  }
  if (share == 0) return {0, 0.5, share_by, Eigen::Vector3d::Zero()};
  const double place = moment / share;
  return {share, place, share_by, (moment_by - place * share_by) / share};
}

namespace {

using Row = WetPiece::Row;

/// How the height of the water above one point changes with the body: −δz, and the slope of the surface there.
Row height_by(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t,
              const Eigen::Vector3d& arm) {
  Eigen::Vector3d n(0, 0, -1);
  if (member.immersion == Immersion::surface) {
    const double e = 1e-6 * member.diameter;
    const Eigen::Vector3d p = at.centre + arm;
    const double here = water.elevation(t, p.x(), p.y());
    n.x() = (water.elevation(t, p.x() + e, p.y()) - here) / e;
    n.y() = (water.elevation(t, p.x(), p.y() + e) - here) / e;
  }
  Row row;
  row << n.transpose(), arm.cross(n).transpose();
  return row;
}

/// How the rise of a section changes as the member turns.
Row rise_by(const SlenderMember& member, const PlacedMember& at) {
  Row row = Row::Zero();
  row.tail<3>() =
      -member.diameter * member.diameter * at.axis.z() / at.rise * at.axis.cross(Eigen::Vector3d::UnitZ()).transpose();
  return row;
}

/// A place along a member, m from its first end, and how it moves with the body.
struct Along {
  double at;
  Row by;
};

void add_gauss_points(const PlacedMember& at, const Along& begin, const Along& end, std::vector<WetPiece>& out) {
  const double length = end.at - begin.at;
  for (const double place : {0.5 - off_middle, 0.5 + off_middle})
    out.push_back({length / 2, at.arm((begin.at + place * length) / at.length), (end.by - begin.by) / 2,
                   begin.by + place * (end.by - begin.by)});
}

/// Where the axis goes through still water, if it does. There the flow that linear theory continues upwards has a kink.
std::optional<Along> still_water_line(const SlenderMember& member, const PlacedMember& at, const WaveField& water,
                                      double t) {
  const double below = -(at.centre.z() + at.from.z()), rise = at.along.z();
  if (!(below * rise > 0 && std::abs(below) < std::abs(rise))) return {};
  const double share = below / rise;
  return Along{share * at.length, at.length / rise * height_by(member, at, water, t, at.arm(share))};
}

/// Of a member that is always wet: Gauss' points of its pieces. The one that is cut by still water counts as two.
void find_gauss_points(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t,
                       std::vector<WetPiece>& out) {
  const double piece = at.length / member.pieces;
  const std::optional<Along> cut = still_water_line(member, at, water, t);
  Along begin{0, Row::Zero()};
  for (int j = 1; j <= member.pieces; ++j) {
    const Along end{j * piece, Row::Zero()};
    if (cut && begin.at < cut->at && cut->at < end.at) {
      add_gauss_points(at, begin, *cut, out);
      add_gauss_points(at, *cut, end, out);
    } else {
      add_gauss_points(at, begin, end, out);
    }
    begin = end;
  }
}

}  // namespace

std::vector<WetPiece> wet_pieces(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t,
                                 bool derivatives) {
  std::vector<WetPiece> out;
  find_wet_pieces(member, at, water, t, derivatives, out);
  return out;
}

void find_wet_pieces(const SlenderMember& member, const PlacedMember& at, const WaveField& water, double t,
                     bool derivatives, std::vector<WetPiece>& out) {
  const double piece = at.length / member.pieces;
  out.clear();
  out.reserve(static_cast<std::size_t>(member.pieces * points_per_piece(member.immersion)));
  if (member.immersion == Immersion::whole) return find_gauss_points(member, at, water, t, out);
  thread_local std::vector<double> g;  // its room is kept from call to call
  find_heights(member, at, water, t, g);
  const auto by = [&](std::size_t j) {
    return height_by(member, at, water, t, at.arm(static_cast<double>(j) / member.pieces));
  };
  for (std::size_t j = 0; j + 1 < g.size(); ++j) {
    const double start = static_cast<double>(j);
    const WetShare wet = wet_share(g[j], g[j + 1], at.rise);
    if (wet.share == 0) continue;
    out.push_back({piece * wet.share, at.arm((start + wet.place) / member.pieces)});
    if (!derivatives || (wet.share_by.isZero(0) && wet.place_by.isZero(0))) continue;
    const Row first = by(j), second = by(j + 1), rise = rise_by(member, at);
    out.back().length_by = piece * (wet.share_by[0] * first + wet.share_by[1] * second + wet.share_by[2] * rise);
    out.back().place_by = piece * (wet.place_by[0] * first + wet.place_by[1] * second + wet.place_by[2] * rise);
  }
}

}  // namespace dynamics
