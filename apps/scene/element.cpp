#include "scene/element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "scene/build.hpp"

namespace froude {
namespace scene {

// Each of the elements that are listed in CMakeLists.txt.
#define FROUDE_PART(name) std::unique_ptr<const ElementTable> name##_element();
#include "elements.inc"
#undef FROUDE_PART

namespace {

std::vector<std::unique_ptr<const ElementTable>>& known() {
  static std::vector<std::unique_ptr<const ElementTable>> tables = [] {
    std::vector<std::unique_ptr<const ElementTable>> own;
#define FROUDE_PART(name) own.push_back(name##_element());
#include "elements.inc"
#undef FROUDE_PART
    return own;
  }();
  return tables;
}

/// Once the grammar was asked for, it stays as it is.
std::atomic<bool>& is_read() {
  static std::atomic<bool> read = false;
  return read;
}

}  // namespace

const std::vector<std::unique_ptr<const ElementTable>>& element_tables() {
  is_read() = true;
  return known();
}

void build_elements(const Record& root, Names& names, Scene& scene) {
  for (const auto& table : element_tables())
    if (root.has(table->name())) scene.elements.push_back(table->read(root.tables(table->name()), scene, names));
}

namespace detail {

Table with_bodies(const std::string& name, Table keys) {
  keys.keys.insert(keys.keys.begin(), {name_key(name, "of the " + name),
                                       texts("on", "bodies it acts on, by name; * stands for any characters")});
  return keys;
}

std::vector<std::pair<std::string, int>> placed_on_bodies(const Record& record, const Scene& scene, Names& names) {
  const auto on = bodies_on(record, "on", scene.bodies);
  const auto called = names.of(record, on.size());
  std::vector<std::pair<std::string, int>> out;
  for (std::size_t i = 0; i < on.size(); ++i) out.emplace_back(called[i], on[i]);
  return out;
}

}  // namespace detail
}  // namespace scene

dynamics::PointOnBody Site::point(int body, const Eigen::Vector3d& from_origin) const {
  return {body, from_origin - bodies[static_cast<std::size_t>(body)].properties().centre_of_gravity.xyz};
}

void add_element(std::unique_ptr<const scene::ElementTable> table) {
  if (scene::is_read()) throw std::logic_error(fmt::format("[[{}]] comes after a scene was read", table->name()));
  const auto& own = scene::known();
  const bool taken = std::any_of(own.begin(), own.end(), [&](const auto& t) { return t->name() == table->name(); });
  if (taken) throw std::logic_error(fmt::format("the grammar has [[{}]] already", table->name()));
  scene::known().push_back(std::move(table));
}

}  // namespace froude
