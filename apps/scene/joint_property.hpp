#pragma once
/// \file  Forces against the coordinate of a slider or hinge, `[joint.NAME]`: each is one file, joints/NAME.cpp, named
///        in CMakeLists.txt, which defines
///
///          std::unique_ptr<const JointProperty> NAME_of_joints();
///
///        Private to apps/scene.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/force/coordinate_force.hpp"
#include "scene/element.hpp"

namespace froude::scene {

/// What a kind of joint measures its coordinate in, and what a record of it calls that.
struct Measure {
  const char *joint, *coordinate_name, *load;
  hydro::Dimension coordinate, force;
  const char* no_damping;
  std::string of(const std::string& table) const { return table + " of a " + joint; }
};
extern const Measure of_slider, of_hinge;

/// Tables of joints, each with the place of its joint in the scene.
using JointRecords = std::vector<std::pair<std::size_t, const Record*>>;

class JointProperty {
 public:
  virtual ~JointProperty() = default;
  virtual const std::string& name() const = 0;
  virtual const Table& keys(const Measure& of) const = 0;
  /// All of one scene. \throws hydro::InputError, placed in the scene
  virtual std::unique_ptr<const Elements> read(const JointRecords& tables, const Scene& scene) const = 0;
};

/// All that are listed, in the order of the reference.
const std::vector<std::unique_ptr<const JointProperty>>& joint_properties();

namespace detail {

template <class Law>
class CoordinateElements final : public Elements {
 public:
  CoordinateElements(std::string table, std::vector<std::pair<std::size_t, Law>> all, dynamics::CoordinateWords words)
      : table_(std::move(table)), all_(std::move(all)), words_(std::move(words)) {}
  std::string table() const override { return table_; }
  std::size_t count() const override { return all_.size(); }
  std::unique_ptr<const dynamics::ForceKind> force(const Site& site) const override {
    return force_of(site, std::vector<bool>(all_.size(), true));
  }
  std::unique_ptr<const dynamics::ForceKind> force_of(const Site& site,
                                                      const std::vector<bool>& counts) const override {
    std::vector<dynamics::OnCoordinate<Law>> out;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!counts[i]) continue;
      const auto& [index, law] = all_[i];
      const dynamics::Joint& joint = site.joints[index];
      out.push_back({{site.bodies, joint, static_cast<int>(index)}, law, joint.sign, joint.name});
    }
    return std::make_unique<dynamics::CoordinateForceKind<Law>>(std::move(out), words_);
  }
  std::vector<Attack> attacks(const Site& site) const override {
    std::vector<Attack> out;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const dynamics::Joint& joint = site.joints[all_[i].first];
      const dynamics::JointArms arms = dynamics::arms_at_rest(site.bodies, joint);
      out.push_back({i, joint.name, joint.first, arms.first});
      if (joint.second) out.push_back({i, joint.name, *joint.second, arms.second});
    }
    return out;
  }

 private:
  std::string table_;
  std::vector<std::pair<std::size_t, Law>> all_;
  dynamics::CoordinateWords words_;
};

template <class Law>
class LawOfJoints final : public JointProperty {
 public:
  LawOfJoints(Binding<Law> (*of)(const Measure&), dynamics::CoordinateWords words)
      : slider_(of(of_slider)), hinge_(of(of_hinge)), words_(std::move(words)) {}
  const std::string& name() const override { return words_.effect; }
  const Table& keys(const Measure& of) const override { return &of == &of_slider ? slider_.table() : hinge_.table(); }
  std::unique_ptr<const Elements> read(const JointRecords& tables, const Scene& scene) const override {
    std::vector<std::pair<std::size_t, Law>> out;
    for (const auto& [joint, record] : tables) {
      const bool slides = scene.joints[joint].kind == dynamics::JointKind::slider;
      out.push_back({joint, (slides ? slider_ : hinge_).read(*record)});
    }
    return std::make_unique<CoordinateElements<Law>>("joint." + name(), std::move(out), words_);
  }

 private:
  Binding<Law> slider_, hinge_;
  dynamics::CoordinateWords words_;
};

}  // namespace detail

/// `[joint.NAME]`, NAME the effect of its words, whose keys make a law by coordinate and rate, dynamics::OnCoordinate.
template <class Law>
std::unique_ptr<const JointProperty> law_of_joints(Binding<Law> (*keys)(const Measure&),
                                                   dynamics::CoordinateWords words) {
  return std::make_unique<detail::LawOfJoints<Law>>(keys, std::move(words));
}

}  // namespace froude::scene
