#pragma once
/// \file  Bodies that touch and part: a set-valued law. No stiffness stands for it and no depth of overlap.
#include "dynamics/force/contact_law.hpp"

namespace dynamics {

/// Its loads are multipliers of an integrator, so it adds none: it knows the geometry, and keeps the accounts.
class ContactKind final : public ForceKind, public ContactLaw {
 public:
  /// \throws hydro::InputError for a restitution outside 0 … 1, a friction below zero, shapes that have no law
  /// (closest_points())
  explicit ContactKind(std::vector<Contact> elements);

  std::string effect() const override { return "contact"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "impacts, contact and friction set-valued, events located"; }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State&) const override {
    return std::make_unique<ContactMemory>(elements_.size());
  }
  void add_load(const Instant&, LoadSink&) const override {}
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;
  const ContactLaw* contact() const override { return this; }
  std::vector<Signal> signals() const override;

  const Contact& element(std::size_t i) const override { return elements_[i]; }
  ClosestPoints closest_points(std::size_t element, const State& state) const override;
  Motion motion(std::size_t element, const State& state) const override;
  std::optional<double> passing(std::size_t element, const State& before, const State& after) const override;
  Constraint closed(std::size_t element) const override;
  std::array<Constraint, 2> sticking(std::size_t element, const State& state) const override;
  Gradient along(std::size_t element, const Eigen::Vector3d& direction, const State& state) const override;
  double load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers) const override;

 private:
  std::vector<Contact> elements_;
};

}  // namespace dynamics
