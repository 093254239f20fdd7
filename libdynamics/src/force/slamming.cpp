#include "dynamics/force/slamming.hpp"

#include <algorithm>
#include <optional>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

using Eigen::Vector3d;
using hydro::waves::CylinderImpact;

/// One piece of a member: is it under, and by what was it last struck?
struct Piece {
  bool under = false;
  struct Strike {
    double begin;
    CylinderImpact impact;
    Vector3d direction, water;  // unit; velocity of the water at contact
  };
  std::optional<Strike> strike;
};

double level_of(const SlammingMember& m, const PlacedMember& at) {
  switch (m.begins) {
    case ImpactBegins::underside:
      return -at.rise / 2;
    case ImpactBegins::line:
      return 0;
    case ImpactBegins::submerged:
      break;
  }
  return at.rise / 2;
}

Vector3d middle_arm(const SlammingMember& m, const PlacedMember& at, std::size_t piece) {
  return at.arm((static_cast<double>(piece) + 0.5) / m.line.pieces);
}

Vector3d velocity_at(const PlacedMember& at, const Vector3d& arm) { return at.velocity + at.omega.cross(arm); }

class Struck final : public Memory {
 public:
  Struck(const SlammingKind& kind, const State& start) : kind_(kind) {
    for (const SlammingMember& m : kind.members()) pieces_.emplace_back(static_cast<std::size_t>(m.line.pieces));
    for_each(start, [](Piece& piece, bool under, auto&&) { piece.under = under; });
  }
  void accept(const State& state) override {
    for_each(state, [](Piece& piece, bool under, auto&& strike) {
      if (under && !piece.under) piece.strike = strike();
      piece.under = under;
    });
  }
  const std::vector<Piece>& pieces(std::size_t member) const { return pieces_[member]; }

 private:
  /// Calls act(piece, whether it is under now, function that makes the strike of this instant).
  template <class Act>
  void for_each(const State& state, const Act& act) {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const SlammingMember& m = kind_.members()[k];
      const PlacedMember at = placed(m.line, state);
      find_heights(m.line, at, kind_.water(), state.time, heights_);
      const double level = level_of(m, at);
      for (std::size_t j = 0; j < pieces_[k].size(); ++j)
        act(pieces_[k][j], (heights_[j] + heights_[j + 1]) / 2 > level, [&] { return strike(m, at, j, state.time); });
    }
  }
  std::optional<Piece::Strike> strike(const SlammingMember& m, const PlacedMember& at, std::size_t piece,
                                      double t) const {
    const Vector3d arm = middle_arm(m, at, piece);
    const Vector3d water = kind_.water().at(t, at.centre + arm).velocity;
    Vector3d across = water - velocity_at(at, arm);
    across -= at.axis * at.axis.dot(across);
    const double speed = across.norm();
    if (speed == 0) return std::nullopt;
    return Piece::Strike{t, CylinderImpact(m.theory, m.line.diameter / 2, speed, kind_.water().water().density),
                         across / speed, water};
  }

  const SlammingKind& kind_;
  std::vector<std::vector<Piece>> pieces_;
  std::vector<double> heights_;  // of the member that is looked at; kept, so that a step asks for no memory
};

/// Calls act(body, arm, force, velocity of the piece, velocity of the water at contact) for each piece of a member that
/// is under load.
template <class Act>
void for_each_load_on(const SlammingKind& kind, std::size_t member, double step, const Instant& now, const Act& act) {
  const SlammingMember& m = kind.members()[member];
  const auto& pieces = static_cast<const Struck&>(*now.memory).pieces(member);
  const PlacedMember at = placed(m.line, now.state);
  const double length = at.length / m.line.pieces;
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const auto& strike = pieces[j].strike;
    if (!strike) continue;
    const double since = now.state.time - strike->begin;
    if (since <= 0 || since - step >= strike->impact.duration()) continue;
    // (D47): the mean over the last step.
    const double mean = (strike->impact.impulse(since) - strike->impact.impulse(std::max(0.0, since - step))) / step;
    const Vector3d arm = middle_arm(m, at, j);
    act(m.line.body, arm, Vector3d(m.factor * length * mean * strike->direction), velocity_at(at, arm), strike->water);
  }
}

/// The same of all members.
template <class Act>
void for_each_load(const SlammingKind& kind, double step, const Instant& now, const Act& act) {
  for (std::size_t k = 0; k < kind.members().size(); ++k) for_each_load_on(kind, k, step, now, act);
}

Vector6 load_at(const Vector3d& arm, const Vector3d& force) {
  Vector6 load;
  load << force, arm.cross(force);
  return load;
}

}  // namespace

std::unique_ptr<Memory> SlammingKind::make_memory(const State& start) const {
  return std::make_unique<Struck>(*this, start);
}

void SlammingKind::add_load(const Instant& now, LoadSink& out) const {
  for_each_load(*this, step_, now,
                [&](int body, const Vector3d& arm, const Vector3d& force, const Vector3d&, const Vector3d&) {
                  out.add(body, load_at(arm, force));
                });
}

std::vector<Signal> SlammingKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!members_[k].told) continue;
    const auto load = [this, k](const Reading& now) {
      Vector6 sum = Vector6::Zero();
      for_each_load_on(*this, k, step_, {now.state, now.memory},
                       [&](int, const Vector3d& arm, const Vector3d& force, const Vector3d&, const Vector3d&) {
                         sum += load_at(arm, force);
                       });
      return sum;
    };
    for (Signal& s : member_load_signals(*members_[k].told, effect(), members_[k].line.body, load))
      out.push_back(std::move(s));
  }
  return out;
}

void SlammingKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for_each_load(*this, step_, now,
                [&](int body, const Vector3d& arm, const Vector3d& force, const Vector3d&, const Vector3d&) {
                  Matrix6 by_q = Matrix6::Zero();
                  by_q.bottomRightCorner<3, 3>() = cross_matrix(force) * cross_matrix(arm);
                  out.add(body, body, by_q, Matrix6::Zero());
                });
}

EnergyFlow SlammingKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for_each_load(*this, step_, now,
                [&](int, const Vector3d&, const Vector3d& force, const Vector3d& own, const Vector3d& water) {
                  flow.supplied += force.dot(water);
                  flow.dissipated += force.dot(water - own);
                });
  return flow;
}

}  // namespace dynamics
