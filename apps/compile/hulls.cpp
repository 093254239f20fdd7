#include "compile/hulls.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "compile/archive.hpp"
#include "compile/computed.hpp"
#include "compile/kept.hpp"
#include "compile/kept_coefficients.hpp"
#include "compile/kept_files.hpp"
#include "fit_sources.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/waves/dispersion.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

namespace hp = hydro::panels;
using hydro::hydrostatics::TriangleMesh;
using hydro::potential::Coefficients;
using scene::HullMesh;
using scene::Scene;

std::mutex watcher_lock;
std::function<void(int, int)> watcher_of_process;

std::function<void(int, int)> watcher_of_hulls() {
  const std::scoped_lock one_at_a_time(watcher_lock);
  return watcher_of_process;
}

/// What hydro::panels is asked. A mesh that is symmetric in x = 0 or y = 0 is solved by its half or quarter, so the
/// bodies stand about the origin for that: `from_origin` is the way from there to their places.
struct HullRequest {
  std::vector<hp::HullBody> bodies;
  std::vector<double> omega, headings;
  hp::Options options;
  Eigen::Vector2d from_origin = Eigen::Vector2d::Zero();
  hydro::Place place;
};

Eigen::Vector2d middle_of(const Scene& scene, const std::vector<int>& bodies) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int b : bodies) sum += scene.bodies[static_cast<std::size_t>(b)].position.head<2>();
  return sum / static_cast<double>(bodies.size());
}

/// Bodies that are copies share a file, which is read once.
class HullMeshes {
 public:
  hydro::hydrostatics::Hull at(const HullMesh& mesh, const Eigen::Vector3d& place) {
    const auto key = std::tuple(mesh.file, mesh.unit, mesh.reverse);
    if (!known_.contains(key))
      known_.emplace(key, hydro::hydrostatics::read_mesh(mesh.file, {.unit = mesh.unit, .reverse = mesh.reverse}));
    TriangleMesh moved = known_.at(key);
    for (Eigen::Vector3d& v : moved.vertices) v += place;
    return hydro::hydrostatics::Hull(std::move(moved));
  }

 private:
  std::map<std::tuple<std::filesystem::path, std::optional<double>, bool>, TriangleMesh> known_;
};

void require_same_panels(const HullMesh& first, const HullMesh& other, const hydro::Place& place) {
  require_same_table("meshes", first, other, place);
  if (other.tolerance != first.tolerance || other.lid != first.lid || other.interaction != first.interaction)
    throw hydro::InputError("bodies of meshes state different mesh_tolerance, lid or mesh_interaction", place,
                            "they are solved together: give all the same");
}

/// By name, or what the scene asks of its answers: they are no better than the coefficients.
double tolerance_of(const HullMesh& mesh, const Scene& scene) { return mesh.tolerance.value_or(scene.accuracy); }

/// \throws InputError at a section that does not cut the hull
void add_sections(const scene::Body& body, const Eigen::Vector3d& at, hp::HullBody& out) {
  for (const scene::Section& section : body.sections) {
    out.sections.push_back({section.name, at + section.at, section.normal});
    scene::placed(section.place, [&] { hp::check_section(out, out.sections.back()); });
  }
}

HullRequest hull_request(const Scene& scene, const std::vector<int>& bodies) {
  const scene::Hydrodynamics& first = hydrodynamics_of(scene, bodies.front());
  HullRequest r{{}, first.mesh->omega, first.mesh->headings, {}, middle_of(scene, bodies), first.file.place};
  HullMeshes meshes;
  for (const int b : bodies) {
    const scene::Hydrodynamics& h = hydrodynamics_of(scene, b);
    require_same_panels(*first.mesh, *h.mesh, h.file.place);
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(b)];
    const Eigen::Vector3d at = body.position - Eigen::Vector3d(r.from_origin.x(), r.from_origin.y(), 0);
    r.bodies.push_back(scene::placed(h.file.place, [&] {
      return hp::HullBody{body.name, at, at + body.centre_of_gravity, meshes.at(*h.mesh, at)};
    }));
    add_sections(body, at, r.bodies.back());
  }
  if (r.headings.empty()) r.headings = headings_asked(scene);
  r.options.tolerance = tolerance_of(*first.mesh, scene);
  r.options.frequency_tolerance = first.mesh->frequency_tolerance;
  r.options.lid = first.mesh->lid;
  r.options.interaction = first.mesh->interaction;
  return r;
}

/// What decides on every bit of the coefficients: the program that solves, and all that it is asked.
std::string key_of_hulls(const HullRequest& r, const hydro::Water& water) {
  ArchiveWriter out{maker("solution by panels", FROUDE_PANEL_SOURCES)};
  out(water.density);
  out(water.gravity);
  out(water.depth.metres());
  out(r.omega);
  out(r.headings);
  out(r.options.tolerance);
  out(r.options.frequency_tolerance);
  out(r.options.refined_frequencies);
  out(r.options.lid);
  out(static_cast<int>(r.options.interaction));
  out.list(r.bodies, [](ArchiveWriter& to, const hp::HullBody& body) {
    to(body.name);
    to(body.reference_point);
    to(body.centre_of_gravity);
    to(body.hull.source());
    to(body.hull.vertices());
    to.list(body.hull.triangles(), [](ArchiveWriter& corners, const std::array<int, 3>& triangle) {
      for (const int corner : triangle) corners(corner);
    });
    to.list(body.sections, [](ArchiveWriter& of, const hp::HullSection& section) {
      of(section.name);
      of(section.at);
      of(section.normal);
    });
  });
  return std::move(out.bytes);
}

Coefficients in_place(Coefficients c, const HullRequest& r) {
  if (r.from_origin.isZero(0)) return c;
  return hydro::potential::translated(std::move(c), r.from_origin);
}

constexpr std::size_t doubted_sets = 3;  // hydro::panels::Solution::doubted, with a tolerance

/// The coefficients of a solution, each with what it is called beside the first.
std::vector<std::pair<std::string, Coefficients*>> sets_of(hp::Solution& s) {
  std::vector<std::pair<std::string, Coefficients*>> out{{"", &s.coefficients}};
  if (s.parts) out.emplace_back("parts", &*s.parts);
  for (std::size_t i = 0; i < s.doubted.size(); ++i) {
    out.emplace_back(fmt::format("doubted{}", i), &s.doubted[i].coefficients);
    out.emplace_back(fmt::format("doubted{} parts", i), &s.doubted[i].parts);
  }
  return out;
}

hp::Solution solved_and_kept(const HullRequest& r, const hydro::Water& water) {
  hp::Options options = r.options;
  options.progress = watcher_of_hulls();
  hp::Solution s = scene::placed(r.place, [&] { return hp::solve(r.bodies, water, r.omega, r.headings, options); });
  const std::string key = key_of_hulls(r, water);
  for (const auto& [name, set] : sets_of(s)) {
    keep_coefficients(key + name, *set);
    *set = in_place(std::move(*set), r);
  }
  return s;
}

}  // namespace

std::vector<int> bodies_of_meshes(const Scene& scene) {
  return bodies_where(scene, [](const scene::Hydrodynamics& h) { return h.mesh.has_value(); });
}

void watch_hulls(std::function<void(int, int)> watcher) {
  const std::scoped_lock one_at_a_time(watcher_lock);
  watcher_of_process = std::move(watcher);
}

hp::Solution solve_hulls(const Scene& scene, const std::vector<int>& bodies) {
  return solved_and_kept(hull_request(scene, bodies), scene.water);
}

// About the middle of the bodies the wave has another phase: motions are per metre of a wave with its crest there.
hydro::potential::WaveField field_of_hulls(const Scene& scene, const std::vector<int>& bodies,
                                           const hydro::potential::FieldQuestion& question) {
  HullRequest r = hull_request(scene, bodies);
  r.options.frequency_tolerance.reset();  // there is one frequency
  const std::complex<double> phase = hydro::potential::incident_elevation(
      r.from_origin.transpose(), hydro::waves::wavenumber(question.omega, scene.water), question.heading)(0);
  hydro::potential::FieldQuestion there = question;
  there.point.rowwise() -= r.from_origin.transpose();
  there.motion /= phase;
  hydro::potential::WaveField field =
      scene::placed(r.place, [&] { return hp::wave_field(r.bodies, scene.water, there, r.options); });
  for (Eigen::VectorXcd* part : {&field.incident, &field.scattered, &field.radiated}) *part *= phase;
  if (!field.on_hulls) return field;
  field.on_hulls->dynamic *= phase;
  field.on_hulls->hydrostatic *= phase;
  const Eigen::Vector3d way(r.from_origin.x(), r.from_origin.y(), 0);
  for (hydro::potential::WetPanel& panel : field.on_hulls->panel) {
    panel.centre += way;
    for (Eigen::Vector3d& corner : panel.corners) corner += way;
  }
  return field;
}

Coefficients coefficients_of_hulls(const Scene& scene, const std::vector<int>& bodies) {
  const HullRequest r = hull_request(scene, bodies);
  auto kept = kept_coefficients(key_of_hulls(r, scene.water), scene.water);
  return kept ? in_place(std::move(*kept), r) : solved_and_kept(r, scene.water).coefficients;
}

namespace {

/// Of hulls with sections, without its check: as an earlier process kept it, or solved.
hp::Solution solution_with_parts(const Scene& scene, const std::vector<int>& bodies) {
  const HullRequest r = hull_request(scene, bodies);
  const std::string key = key_of_hulls(r, scene.water);
  hp::Solution s;
  s.parts.emplace();
  s.doubted.resize(doubted_sets);
  for (const auto& [name, set] : sets_of(s)) {
    auto kept = kept_coefficients(key + name, scene.water);
    if (!kept) return solved_and_kept(r, scene.water);
    *set = in_place(std::move(*kept), r);
  }
  return s;
}

/// The set that is asked for; all of them are known to `kept` from then on.
const Coefficients& set_of_hulls(const Scene& scene, Kept& kept, const std::string& wanted) {
  const std::vector<int> bodies = bodies_of_meshes(scene);
  const std::string title = what_hulls_are_solved(scene, bodies);
  hp::Solution s;
  s.parts.emplace();
  s.doubted.resize(doubted_sets);
  bool solved = false;
  const Coefficients* out = nullptr;
  for (std::size_t i = 0; i < sets_of(s).size(); ++i) {
    const std::string name = sets_of(s)[i].first;
    const Coefficients& known = kept.coefficients(title + name, [&] {
      if (!std::exchange(solved, true)) s = solution_with_parts(scene, bodies);
      return std::move(*sets_of(s)[i].second);
    });
    if (name == wanted) out = &known;
  }
  return *out;
}

}  // namespace

hp::HullBody hull_of(const Scene& scene, int body) {
  const scene::Body& of = scene.bodies[static_cast<std::size_t>(body)];
  const scene::Hydrodynamics& h = hydrodynamics_of(scene, body);
  const Eigen::Vector3d centre = of.position + of.centre_of_gravity;
  return scene::placed(h.file.place, [&] {
    hp::HullBody out{of.name, centre, centre, HullMeshes().at(*h.mesh, of.position)};
    add_sections(of, of.position, out);
    return out;
  });
}

const Coefficients& parts_of_hulls(const Scene& scene, Kept& kept) { return set_of_hulls(scene, kept, "parts"); }

std::vector<std::shared_ptr<Kept>> kept_doubted(const Scene& scene, Kept& kept) {
  const std::string title = what_hulls_are_solved(scene, bodies_of_meshes(scene));
  std::vector<std::shared_ptr<Kept>> out;
  for (std::size_t i = 0; i < doubted_sets; ++i) {
    const std::string of = fmt::format("doubted{}", i);
    const Coefficients &whole = set_of_hulls(scene, kept, of), &parts = set_of_hulls(scene, kept, of + " parts");
    out.push_back(std::make_shared<Kept>());
    hp::Solution names;
    names.parts.emplace();
    names.doubted.resize(doubted_sets);
    for (const auto& set : sets_of(names))
      out.back()->coefficients(title + set.first, [&] { return set.first.ends_with("parts") ? parts : whole; });
  }
  return out;
}

const Coefficients& kept_coefficients_of_hulls(const Scene& scene, Kept& kept) {
  const std::vector<int> bodies = bodies_of_meshes(scene);
  if (std::any_of(bodies.begin(), bodies.end(),
                  [&](int b) { return !scene.bodies[static_cast<std::size_t>(b)].sections.empty(); }))
    return set_of_hulls(scene, kept, "");
  return kept.coefficients(what_hulls_are_solved(scene, bodies), [&] { return coefficients_of_hulls(scene, bodies); });
}

std::string what_hulls_are_solved(const Scene& scene, const std::vector<int>& bodies) {
  const HullMesh& table = *hydrodynamics_of(scene, bodies.front()).mesh;
  std::string out = fmt::format(
      "meshes {} {} {} {} {} {} {} | {} | {}", scene.water.density, scene.water.gravity, scene.water.depth.metres(),
      tolerance_of(table, scene), table.frequency_tolerance.value_or(0), table.lid, static_cast<int>(table.interaction),
      fmt::join(table.omega, " "), fmt::join(table.headings.empty() ? headings_asked(scene) : table.headings, " "));
  for (const int b : bodies) {
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(b)];
    const HullMesh& mesh = *body.hydrodynamics->mesh;
    out += fmt::format(" | {} {} {} {} {} {}", body.name, fmt::join(body.position, " "),
                       fmt::join(body.centre_of_gravity, " "), mesh.file.string(), mesh.unit.value_or(0), mesh.reverse);
    for (const scene::Section& s : body.sections)
      out += fmt::format(" | section {} {} {}", s.name, fmt::join(s.at, " "), fmt::join(s.normal, " "));
  }
  return out;
}

std::string size_of_hulls(const hp::Cost& c, std::size_t frequencies, std::size_t headings) {
  const std::string refined = c.refined_unknowns > 0 ? fmt::format(", {} in the refined mesh", c.refined_unknowns) : "";
  const std::string kinds =
      c.partial_waves > 0 ? fmt::format(" for each kind of hull, up to {} partial waves a hull", c.partial_waves) : "";
  return fmt::format("{} panels, {}, {} headings; {} x {} unknowns{}{}, {:.3g} MB, about {:.2g} s", c.panels,
                     frequencies_in_words(frequencies, c.frequencies), headings, c.systems, c.unknowns, refined, kinds,
                     std::ceil(c.bytes / 1e6), std::max(0.1, c.seconds));
}

std::string HullPlan::method() const {
  return kept_in ? fmt::format("panels, solved before and kept in {}", kept_in->string())
         : cost.partial_waves > 0
             ? std::string("panels, each kind of hull by elimination, and partial waves between hulls")
             : std::string("panels, the equations by elimination");
}

std::string HullPlan::size() const {
  return left_to_do(size_of_hulls(cost, frequencies, headings), kept_in.has_value());
}

HullPlan plan_hulls(const Scene& scene, const std::vector<int>& bodies) {
  const HullRequest r = hull_request(scene, bodies);
  HullPlan plan{{}, r.omega.size(), r.headings.size(), {}};
  scene::placed(r.place, [&] { plan.cost = hp::cost(r.bodies, scene.water, r.omega, r.headings, r.options); });
  plan.kept_in = folder_of_kept(key_of_hulls(r, scene.water));
  return plan;
}

}  // namespace froude::compile
