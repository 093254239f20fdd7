#pragma once
/// \file  Force elements of a scene: a table of the grammar and the force that is made of it, declared in one place.
///
/// An element of one's own, in a program that links froude::scene:
///
///   struct Thruster {
///     Eigen::Vector3d at = Eigen::Vector3d::Zero();
///     double thrust = 0;
///   };
///   const froude::scene::Binding<Thruster>& thruster();              // keys of [[thruster]], scene/binding.hpp
///
///   froude::add_element(froude::on_bodies<Thruster>("thruster", thruster(), [](const auto& all, const auto& site) {
///     return std::make_unique<ThrusterKind>(all, site);              // a dynamics::ForceKind
///   }));
///
/// From then on scenes may hold [[thruster]]; its loads, energies and signals are in runs, responses and plans as those
/// of any other element.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/joint.hpp"
#include "dynamics/state/point.hpp"
#include "hydro/base/types.hpp"
#include "scene/binding.hpp"

namespace froude {

/// What an element knows of its scene when its force is made.
struct Site {
  const std::vector<dynamics::RigidBody>& bodies;  ///< in the order of the scene
  const hydro::Water& water;
  const std::vector<dynamics::Joint>& joints;  ///< in the order of the scene
  /// A point of a body, given from its origin in body axes, m.
  dynamics::PointOnBody point(int body, const Eigen::Vector3d& from_origin) const;
};

/// One element on one body.
template <class T>
struct OnBody {
  std::string name;  ///< of the element: "thruster1"
  int body;          ///< index into Site::bodies
  T value;           ///< what its table says
};

namespace scene {

/// Where an element acts on a body.
struct Attack {
  std::size_t element;  ///< which of its table
  std::string name;
  int body;
  std::optional<Eigen::Vector3d> arm;  ///< from the centre of gravity, body axes, m; empty: that cannot be told
};

/// All elements of one table in one scene.
class Elements {
 public:
  virtual ~Elements() = default;
  virtual std::string table() const = 0;  ///< "thruster" of [[thruster]]
  virtual std::size_t count() const = 0;
  virtual std::unique_ptr<const dynamics::ForceKind> force(const Site& site) const = 0;
  /// The force of some of them: `counts` has one entry an element.
  virtual std::unique_ptr<const dynamics::ForceKind> force_of(const Site& site,
                                                              const std::vector<bool>& counts) const = 0;
  /// Of all of them, on each of their bodies.
  virtual std::vector<Attack> attacks(const Site& site) const = 0;
};

/// A table of the grammar whose entries are force elements.
class ElementTable {
 public:
  /// `name` without brackets; `keys` as a scene writes them, the common ones among them.
  ElementTable(std::string name, Table keys) : name_(std::move(name)), keys_(std::move(keys)) {}
  virtual ~ElementTable() = default;
  const std::string& name() const { return name_; }
  const Table& keys() const { return keys_; }
  /// The elements of these tables, on bodies of the scene. \throws hydro::InputError, placed in the scene
  virtual std::unique_ptr<const Elements> read(const std::vector<Record>& tables, const Scene& scene,
                                               class Names& names) const = 0;

 private:
  std::string name_;
  Table keys_;
};

/// All that are known: Froude's own, then those that were added.
const std::vector<std::unique_ptr<const ElementTable>>& element_tables();

namespace detail {

/// The keys `name` and `on`, before those of the element.
Table with_bodies(const std::string& name, Table keys);
/// Names and bodies of what one table describes: one element for each body that `on` fits.
std::vector<std::pair<std::string, int>> placed_on_bodies(const Record& record, const Scene& scene, Names& names);

template <class T>
class BodyElements final : public Elements {
 public:
  using Make = std::function<std::unique_ptr<const dynamics::ForceKind>(const std::vector<OnBody<T>>&, const Site&)>;
  BodyElements(std::string table, std::vector<OnBody<T>> all, Make make)
      : table_(std::move(table)), all_(std::move(all)), make_(std::move(make)) {}
  std::string table() const override { return table_; }
  std::size_t count() const override { return all_.size(); }
  std::unique_ptr<const dynamics::ForceKind> force(const Site& site) const override { return make_(all_, site); }
  std::unique_ptr<const dynamics::ForceKind> force_of(const Site& site,
                                                      const std::vector<bool>& counts) const override {
    std::vector<OnBody<T>> some;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (counts[i]) some.push_back(all_[i]);
    return make_(some, site);
  }
  /// At the member `at` of what the table says, a point from the body's origin, where it has one.
  std::vector<Attack> attacks(const Site& site) const override {
    std::vector<Attack> out;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      std::optional<Eigen::Vector3d> arm;
      if constexpr (requires(const T& value) { Eigen::Vector3d(value.at); })
        arm = site.point(all_[i].body, all_[i].value.at).arm;
      out.push_back({i, all_[i].name, all_[i].body, arm});
    }
    return out;
  }

 private:
  std::string table_;
  std::vector<OnBody<T>> all_;
  Make make_;
};

template <class T>
class BodyElementTable final : public ElementTable {
 public:
  using Make = typename BodyElements<T>::Make;
  BodyElementTable(const std::string& name, const Binding<T>& binding, Make make)
      : ElementTable(name, with_bodies(name, binding.table())), binding_(binding), make_(std::move(make)) {}
  std::unique_ptr<const Elements> read(const std::vector<Record>& tables, const Scene& scene,
                                       Names& names) const override {
    std::vector<OnBody<T>> all;
    for (const Record& record : tables)
      for (const auto& [name, body] : placed_on_bodies(record, scene, names))
        all.push_back({name, body, binding_.read(record)});
    return std::make_unique<BodyElements<T>>(this->name(), std::move(all), make_);
  }

 private:
  const Binding<T>& binding_;
  Make make_;
};

}  // namespace detail
}  // namespace scene

/// Elements that act on one body each. A scene gives them `name`, `on` and the keys of the binding, which must live as
/// long as the program; `make` gets all elements of a scene and returns their force.
template <class T, class MakeForce>
std::unique_ptr<const scene::ElementTable> on_bodies(const std::string& name, const scene::Binding<T>& binding,
                                                     MakeForce make) {
  return std::make_unique<scene::detail::BodyElementTable<T>>(name, binding, std::move(make));
}

/// Makes a table known to all scenes that are read from then on. \throws std::logic_error where a scene was read
/// before, or the grammar has a table of this name
void add_element(std::unique_ptr<const scene::ElementTable> table);

}  // namespace froude
