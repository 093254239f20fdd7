#include "hydro/waves/synthesis/boxed_field.hpp"

#include <algorithm>

namespace hydro::waves {

BoxedField::BoxedField(const HarmonicField& field, const FieldUse& use) : sum_(field) {
  ChosenField chosen = choose_field(field, use);
  if (chosen.method != FieldMethod::table) return;
  table_.reset(static_cast<const TabulatedField*>(chosen.field.release()));
}

bool BoxedField::holds(double t) const { return table_ && t >= table_->box().start_s && t <= table_->box().end_s; }

bool BoxedField::holds(double x, double y) const {
  const FieldBox& box = table_->box();
  return x >= box.low.x() && x <= box.high.x() && y >= box.low.y() && y <= box.high.y();
}

bool BoxedField::holds(const Eigen::Vector3d& p) const {
  return holds(p.x(), p.y()) && p.z() >= table_->box().low.z() && p.z() <= table_->box().high.z();
}

double BoxedField::elevation(double t, double x, double y) const {
  return holds(t) && holds(x, y) ? table_->elevation(t, x, y) : sum_.elevation(t, x, y);
}

Kinematics BoxedField::at(double t, const Eigen::Vector3d& point) const {
  return holds(t) && holds(point) ? table_->at(t, point) : sum_.at(t, point);
}

void BoxedField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  const auto inside = [&](const Eigen::Vector3d& p) { return holds(p); };
  if (holds(t) && std::all_of(points.begin(), points.end(), inside))
    table_->at(t, points, out);
  else if (holds(t) && std::any_of(points.begin(), points.end(), inside))
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(t, points[i]);
  else
    sum_.at(t, points, out);
}

}  // namespace hydro::waves
