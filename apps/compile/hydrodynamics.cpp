#include "compile/hydrodynamics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "compile/computed.hpp"
#include "compile/cylinders.hpp"
#include "compile/findings.hpp"
#include "compile/hulls.hpp"
#include "compile/hydrostatics.hpp"
#include "compile/kept.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/potential/doctor/check.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using hydro::potential::Coefficients;
using scene::Hydrodynamics;
using scene::Interaction;
using scene::Scene;

/// Scene bodies that take their coefficients from one reading of one file, and which of its bodies each is.
struct Use {
  std::string name;            // of the data, in what is kept
  const Coefficients* data;    // kept: those of many bodies take gigabytes, and are not copied
  std::vector<int> bodies;     // in the scene
  std::vector<int> file_body;  // in the file, from 0
};

const Hydrodynamics& hydrodynamics(const Scene& scene, int body) { return hydrodynamics_of(scene, body); }

/// Bodies that are solved together with one whose coefficients the program computes; none for one of a file.
std::vector<int> solved_together(const Scene& scene, const Hydrodynamics& h) {
  if (h.cylinders) return bodies_of_cylinders(scene);
  if (h.mesh) return bodies_of_meshes(scene);
  return {};
}

/// What the coefficients are from: a file of them, a mesh, or nothing that lies on the disk.
std::string file_name(const Hydrodynamics& h) {
  return h.mesh ? h.mesh->file.filename().string() : h.file.value.filename().string();
}

/// By which what is kept knows the coefficients: what they are read from or computed of, and in which water.
std::string name_of_data(const Scene& scene, const Hydrodynamics& h) {
  if (h.cylinders) return what_is_solved(scene, bodies_of_cylinders(scene));
  if (h.mesh) return what_hulls_are_solved(scene, bodies_of_meshes(scene));
  const auto& w = scene.water;
  return fmt::format("{}|{}|{}|{}|{}|{}", h.file.value.string(), w.density, w.gravity, w.depth.metres(),
                     h.ulen.value_or(0), h.iperout.value_or(0));
}

/// From the file, or computed for all bodies of cylinders or meshes together; once for all scenes that share what is
/// kept.
const Coefficients& read(const Scene& scene, const Hydrodynamics& h, const std::string& name, Kept& kept) {
  if (h.cylinders)
    return kept.coefficients(name, [&] { return coefficients_of_cylinders(scene, bodies_of_cylinders(scene)); });
  if (h.mesh) return kept_coefficients_of_hulls(scene, kept);
  hydro::potential::ReadOptions options;
  options.density = scene.water.density;
  options.gravity = scene.water.gravity;
  options.depth = scene.water.depth;
  options.ulen = h.ulen;
  options.iperout = h.iperout;
  return scene::placed(h.file.place, [&]() -> const Coefficients& {
    return kept.coefficients(name, [&] { return hydro::potential::read(h.file.value, options); });
  });
}

/// Of another density alone coefficients are the same numbers times the ratio of densities (P29).
std::string remedy_of_water(const Coefficients& data, const hydro::Water& scene) {
  if (std::abs(data.water.gravity - scene.gravity) > 1e-3 * std::abs(scene.gravity))
    return "make [water] agree with the data, or compute the coefficients for this water";
  return fmt::format(
      "make [water] agree with the data, or the data with it: `froude bem convert FILE --density-ratio {:.10g} -o "
      "converted.h5`; masses of bodies that float change with it",
      scene.density / data.water.density);
}

/// Density and gravity of the data must be those of the scene; a file that states none was read with the scene's.
void require_same_water(const Scene& scene, const Coefficients& data, const hydro::Place& place) {
  const auto differs = [](double a, double b) { return a != b && !(std::abs(a - b) <= 1e-3 * std::abs(b)); };
  const auto& w = scene.water;
  if (differs(data.water.density, w.density) || differs(data.water.gravity, w.gravity))
    throw InputError(fmt::format("the coefficients are for ρ = {:.6g} kg/m³ and g = {:.6g} m/s²; the scene has {:.6g} "
                                 "and {:.6g}",
                                 data.water.density, data.water.gravity, w.density, w.gravity),
                     place, remedy_of_water(data, w));
}

/// Which body of the file each scene body is; see scene.hpp on `body`.
void assign(const Scene& scene, Use& use) {
  const int in_file = use.data->bodies(), in_scene = static_cast<int>(use.bodies.size());
  for (int i = 0; i < in_scene; ++i) {
    const auto& body = scene.bodies[static_cast<std::size_t>(use.bodies[static_cast<std::size_t>(i)])];
    const Hydrodynamics& h = *body.hydrodynamics;
    int index = 0;
    if (const auto all = solved_together(scene, h); !all.empty()) {
      index =
          static_cast<int>(std::find(all.begin(), all.end(), use.bodies[static_cast<std::size_t>(i)]) - all.begin());
    } else if (h.body) {
      index = h.body->value - 1 + (body.copy > 0 && in_file > 1 ? body.copy - 1 : 0);
      if (index < 0 || index >= in_file)
        throw InputError(fmt::format("body {} of \"{}\" is asked for; the file holds {}", index + 1,
                                     h.file.value.filename().string(),
                                     in_file == 1 ? "one body" : fmt::format("{} bodies", in_file)),
                         h.body->place, "bodies of a file are counted from 1");
    } else if (in_file > 1) {
      if (in_scene != in_file)
        throw InputError(fmt::format("\"{}\" holds {} bodies, but {} of the scene take their coefficients from it",
                                     h.file.value.filename().string(), in_file, in_scene),
                         h.file.place, "say which body each is: body = 1");
      index = i;
    }
    use.file_body.push_back(index);
  }
  for (std::size_t i = 0; i < use.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (in_file > 1 && use.file_body[i] == use.file_body[j])
        throw InputError(fmt::format("two bodies take body {} of the same file", use.file_body[i] + 1),
                         hydrodynamics(scene, use.bodies[i]).file.place);
}

std::vector<Use> uses(const Scene& scene, Kept& kept) {
  std::vector<Use> out;
  std::map<std::string, std::size_t> known;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto& h = scene.bodies[b].hydrodynamics;
    if (!h) continue;
    const std::string key = fmt::format(
        "{}{}|{}|{}|{}|{}{}{}", h->file.value.string(), h->mesh ? "meshes" : "", h->ulen.value_or(0),
        h->iperout.value_or(0), h->interaction != Interaction::self, h->radiation, h->excitation, h->hydrostatics);
    const auto [at, is_new] = known.try_emplace(key, out.size());
    if (is_new) {
      const std::string name = name_of_data(scene, *h);
      out.push_back({name, &read(scene, *h, name, kept), {}, {}});
      require_same_water(scene, *out.back().data, h->file.place);
    }
    out[at->second].bodies.push_back(static_cast<int>(b));
  }
  for (Use& use : out) assign(scene, use);
  return out;
}

/// What the scene does not name is not judged.
Coefficients used(const Scene& scene, const Use& use) {
  Coefficients c = *use.data;
  const Hydrodynamics& h = hydrodynamics(scene, use.bodies.front());
  if (!h.excitation) {
    c.X.clear();
    c.heading.clear();
  }
  if (!h.hydrostatics) c.C.reset();
  return c;
}

/// A rotation about the centre of gravity moves the point that the data are about, so it needs the translations too.
TakenCoefficients taken_by(const Scene& scene, const Use& use) {
  TakenCoefficients out{use.file_body, {}, hydrodynamics(scene, use.bodies.front()).radiation};
  for (const int b : use.bodies) {
    std::array<bool, 6> modes = scene.bodies[static_cast<std::size_t>(b)].free;
    if (modes[3] || modes[4] || modes[5]) std::fill_n(modes.begin(), 3, true);
    out.modes.push_back(modes);
  }
  return out;
}

/// What the doctor finds in what is used, once for all scenes that use the same.
const std::vector<hydro::potential::Finding>& findings(const Scene& scene, const Use& use, Kept& kept) {
  const Hydrodynamics& h = hydrodynamics(scene, use.bodies.front());
  const TakenCoefficients taken = taken_by(scene, use);
  std::string name =
      fmt::format("{}|{}|{}|{}|{}", use.name, h.radiation, h.excitation, h.hydrostatics, fmt::join(taken.bodies, " "));
  for (const auto& modes : taken.modes) name += fmt::format("|{}", fmt::join(modes, " "));
  return kept.findings(name, [&] { return findings_in(used(scene, use), taken); });
}

/// Lets the doctor look at a file: an error stops the scene unless it is accepted, and what is accepted is recorded.
void examine(const Scene& scene, const Use& use, Kept& kept, std::vector<std::string>& notes) {
  const Hydrodynamics& h = hydrodynamics(scene, use.bodies.front());
  if (h.cylinders) return;  // exact, with a self-check of their own
  std::vector<std::string> accepted;
  for (const int b : use.bodies)
    for (const auto& name : hydrodynamics(scene, b).accept)
      if (std::find(accepted.begin(), accepted.end(), name) == accepted.end()) accepted.push_back(name);
  const auto& found = findings(scene, use, kept);
  const std::string file = file_name(h);
  if (const auto refused = hydro::potential::refused(found, accepted); !refused.empty()) {
    std::vector<std::string> names;
    for (const auto& f : refused)
      if (names.empty() || names.back() != f.check) names.push_back(f.check);
    throw InputError(fmt::format("\"{}\": {}: {} (at {})", file, refused.front().check, refused.front().message,
                                 refused.front().where),
                     h.file.place,
                     fmt::format("{}; or take the data as they are: accept = [\"{}\"]", refused.front().remedy,
                                 fmt::join(names, "\", \"")));
  }
  std::size_t warnings = 0;
  for (const auto& f : found) {
    const bool is_accepted = std::find(accepted.begin(), accepted.end(), f.check) != accepted.end();
    if (f.severity == hydro::potential::Severity::error && is_accepted)
      notes.push_back(fmt::format("{}: accepted, {}: {} (at {})", file, f.check, f.message, f.where));
    if (f.severity == hydro::potential::Severity::warning) ++warnings;
  }
  if (h.mesh && h.mesh->tolerance.value_or(0) > scene.accuracy)
    notes.push_back(fmt::format(
        "{}: its coefficients may be off by up to {:.2g} of their modes by panels, as mesh_tolerance takes; "
        "errors that are told of motions do not hold that",
        file, *h.mesh->tolerance));
  if (warnings > 0)
    notes.push_back(fmt::format("{}: {} warning{}: run {}", file, warnings, warnings == 1 ? "" : "s",
                                h.mesh ? "`froude bem solve` of this scene, and `froude bem check` of its file"
                                       : fmt::format("`froude bem check {}`", file)));
}

/// What the data's depth leaves wrong in the scene's, if they differ. \return the depth to go on with: waves have the
/// scene's length, so that those that arrive at bodies elsewhere are those of its sea
hydro::WaterDepth take_depth(const Scene& scene, const Use& use, std::vector<OtherDepth>& other_depths) {
  const Hydrodynamics& h = hydrodynamics(scene, use.bodies.front());
  if (!are_apart(use.data->water.depth, scene.water.depth)) return use.data->water.depth;
  if (h.radiation || h.excitation) {
    // Copies of the one body of a file do not feel each other: each is as the first.
    const std::size_t count = use.data->bodies() == 1 ? 1 : use.bodies.size();
    const Coefficients taken = hydro::potential::select(
        *use.data, std::vector(use.file_body.begin(), use.file_body.begin() + static_cast<std::ptrdiff_t>(count)));
    std::vector<double> volumes;
    std::vector<Eigen::Vector3d> places;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& body = scene.bodies[static_cast<std::size_t>(use.bodies[i])];
      volumes.push_back(taken.body[i].displaced_volume.value_or(body.mass / scene.water.density));
      places.push_back(body.position);
    }
    other_depths.push_back(other_depth(scene, taken, volumes, places, h.file.place));
  }
  return scene.water.depth;
}

/// Bodies that radiate onto each other: all of a use, or each by itself if the file has one body or the scene wants no
/// interaction.
std::vector<std::vector<std::size_t>> interacting(const Scene& scene, const Use& use) {
  const bool apart =
      use.data->bodies() == 1 || hydrodynamics(scene, use.bodies.front()).interaction == Interaction::self;
  std::vector<std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < use.bodies.size(); ++i) {
    if (sets.empty() || apart) sets.emplace_back();
    sets.back().push_back(i);
  }
  return sets;
}

/// Waves of one body of the file reach the other, in the data: copies that were put side by side have no such blocks.
bool coupled(const Coefficients& data, int i, int j) {
  const auto reaches = [i, j](const Eigen::MatrixXd& m) { return !m.block<6, 6>(6 * i, 6 * j).isZero(0); };
  return std::any_of(data.A.begin(), data.A.end(), reaches) || std::any_of(data.B.begin(), data.B.end(), reaches);
}

/// Bodies that make waves, in sets within which those of one reach the others, each set in the order of the scene.
std::vector<std::vector<int>> sharing_waves(const Scene& scene, const std::vector<Use>& uses) {
  std::vector<std::vector<int>> out;
  for (const Use& use : uses) {
    if (!hydrodynamics(scene, use.bodies.front()).makes_waves()) continue;
    for (const auto& set : interacting(scene, use)) {
      std::vector<std::vector<std::size_t>> parts;
      for (const std::size_t i : set) {
        std::vector<std::size_t> joined;
        std::erase_if(parts, [&](const std::vector<std::size_t>& part) {
          if (std::none_of(part.begin(), part.end(),
                           [&](std::size_t j) { return coupled(*use.data, use.file_body[i], use.file_body[j]); }))
            return false;
          joined.insert(joined.end(), part.begin(), part.end());
          return true;
        });
        joined.push_back(i);
        parts.push_back(std::move(joined));
      }
      for (const auto& part : parts) {
        out.emplace_back();
        for (const std::size_t i : part) out.back().push_back(use.bodies[i]);
        std::sort(out.back().begin(), out.back().end());
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Why no waves pass between two bodies, neither of which says so.
std::string why_apart(const Scene& scene, int a, int b) {
  const auto name = [&](int body) {
    const Hydrodynamics& h = hydrodynamics(scene, body);
    return h.cylinders ? "its cylinders" : fmt::format("\"{}\"", file_name(h));
  };
  const Hydrodynamics &first = hydrodynamics(scene, a), &second = hydrodynamics(scene, b);
  const bool of_one_kind =
      first.cylinders.has_value() == second.cylinders.has_value() && first.mesh.has_value() == second.mesh.has_value();
  if (first.file.value != second.file.value || !of_one_kind)
    return fmt::format("{} has its coefficients from {}, {} from {}, computed one without the other",
                       scene.bodies[static_cast<std::size_t>(a)].name, name(a),
                       scene.bodies[static_cast<std::size_t>(b)].name, name(b));
  const auto keys = [](const Hydrodynamics& h) {
    return std::tuple(h.radiation, h.excitation, h.hydrostatics, h.ulen, h.iperout);
  };
  if (keys(first) != keys(second)) return fmt::format("they take {} by different keys", name(a));
  return fmt::format("{} holds no coupling of the two", name(a));
}

/// A scene says so where waves of one body do not reach another: that is an approximation, and not one to make in
/// silence.
void require_said(const Scene& scene, const std::vector<std::vector<int>>& sets) {
  const auto full = [&](int body) { return hydrodynamics(scene, body).interaction == Interaction::full; };
  const auto& bodies = scene.bodies;
  int first = -1;
  for (const auto& set : sets) {
    const auto one = std::find_if(set.begin(), set.end(), full);
    if (one == set.end()) continue;
    if (first >= 0)
      throw InputError(
          fmt::format("no waves pass between {} and {}, which interaction = \"full\", the default, asks for: {}",
                      bodies[static_cast<std::size_t>(first)].name, bodies[static_cast<std::size_t>(*one)].name,
                      why_apart(scene, first, *one)),
          hydrodynamics(scene, *one).interaction_place,
          "compute them together (`froude bem solve` does so for cylinders and for meshes) and name that file for "
          "both, with body = 1 "
          "and body = 2; or say that they do not feel each other: interaction = \"self\", or \"file\" for bodies that "
          "feel those of their own file alone");
    first = *one;
  }
}

/// What the result records where waves do not pass between all.
void note_sets(const Scene& scene, const std::vector<std::vector<int>>& sets, std::vector<std::string>& notes) {
  if (sets.size() < 2) return;
  std::vector<int> all;
  std::vector<std::string> together;
  for (const auto& set : sets) {
    all.push_back(set.front());
    if (set.size() > 1) together.push_back(listed_bodies(scene, set));
  }
  notes.push_back(
      fmt::format("no waves pass between {}, as the scene says{}", listed_bodies(scene, all),
                  together.empty() ? "" : fmt::format("; they do among {}", fmt::join(together, "; among "))));
}

/// Puts one set of interacting bodies in its place and about the scene's centres of gravity.
class Placement {
 public:
  Placement(const Scene& scene, Coefficients data, std::vector<int> bodies, bool single_in_file,
            std::vector<std::string>& notes)
      : scene_(scene), c_(std::move(data)), bodies_(std::move(bodies)), single_(single_in_file), notes_(notes) {}

  Coefficients place() {
    find_reference_points();
    complete_facts();
    correct_gravity();
    std::vector<Eigen::Vector3d> centres;
    for (const int b : bodies_) centres.push_back(body(b).position + body(b).centre_of_gravity);
    return hydro::potential::about(std::move(c_), points_, centres);
  }

 private:
  const scene::Body& body(int b) const { return scene_.bodies[static_cast<std::size_t>(b)]; }

  void find_reference_points() {
    const auto& first = body(bodies_.front());
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
    if (c_.body.front().reference_point) {
      shift = (first.position - *c_.body.front().reference_point).head<2>();
    } else if (single_) {
      shift = first.position.head<2>();
      if (shift.norm() > 0)
        notes_.push_back(
            fmt::format("{}: the file does not say where the body was; taken to be at x = y = 0 and translated to {}",
                        c_.source, first.name));
    }
    if (shift.norm() > 0) c_ = hydro::potential::translated(std::move(c_), shift);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto& b = body(bodies_[i]);
      const auto& stated = c_.body[i].reference_point;
      const auto& given = b.hydrodynamics->reference_point;
      if (stated && given && (*stated - *given).norm() > 1e-6)
        throw InputError(
            fmt::format("the file has the reference point ({:.6g}, {:.6g}, {:.6g}) m; the scene says otherwise",
                        stated->x(), stated->y(), stated->z()),
            b.hydrodynamics->file.place, "leave out reference_point");
      if (stated && (b.position - *stated).head<2>().norm() > 1e-3)
        throw InputError(fmt::format("body \"{}\" is at x = {:.6g}, y = {:.6g} m; in the data its reference point is "
                                     "at ({:.6g}, {:.6g}) when \"{}\" is in place",
                                     b.name, b.position.x(), b.position.y(), stated->x(), stated->y(), first.name),
                         b.place, "bodies that interact must stand as they stood when the coefficients were computed");
      points_.push_back(stated ? *stated : given.value_or(b.position));
    }
  }

  /// Volume and centre of buoyancy of files that lack them are those of the scene.
  void complete_facts() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto& b = body(bodies_[i]);
      const Hydrodynamics& h = *b.hydrodynamics;
      auto& facts = c_.body[i];
      constexpr double same = 1e-3;
      const auto refuse = [&](const char* key) {
        throw InputError(fmt::format("the file has another {} of body \"{}\" than the scene", key, b.name),
                         h.file.place, fmt::format("leave out {}", key));
      };
      if (h.displaced_volume) {
        if (facts.displaced_volume && std::abs(*facts.displaced_volume / *h.displaced_volume - 1) > same)
          refuse("displaced_volume");
        facts.displaced_volume = h.displaced_volume;
      }
      if (!h.centre_of_buoyancy) continue;
      const Eigen::Vector3d given = b.position + *h.centre_of_buoyancy;
      if (facts.centre_of_buoyancy && (*facts.centre_of_buoyancy - given).norm() > same) refuse("centre_of_buoyancy");
      facts.centre_of_buoyancy = given;
    }
  }

  void correct_gravity() {
    if (!c_.C || !body(bodies_.front()).hydrodynamics->hydrostatics) return;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto& b = body(bodies_[i]);
      const auto& facts = c_.body[i];
      // About its own centre of gravity a body is restored by buoyancy alone; what it lacks in weight acts there,
      // lift().
      const double weight = b.mass * scene_.water.gravity + lift(scene_, bodies_[i], facts);
      if (!facts.centre_of_gravity) {
        notes_.push_back(fmt::format(
            "{}: the file does not say for which centre of gravity its restoring matrix is; taken to be that of {}",
            c_.source, b.name));
        continue;
      }
      if (facts.displaced_volume && !is_jointed(scene_, bodies_[i]) &&
          std::abs(scene_.water.density * *facts.displaced_volume / b.mass - 1) > 0.01)
        notes_.push_back(
            fmt::format("{}: displaces {:.6g} kg of water but weighs {:.6g} kg: a linear restoring matrix takes them "
                        "to be in balance",
                        b.name, scene_.water.density * *facts.displaced_volume, b.mass));
      const double weight_in_data =
          facts.displaced_volume ? scene_.water.density * scene_.water.gravity * *facts.displaced_volume : weight;
      const auto row = 6 * static_cast<Eigen::Index>(i);
      c_.C->block<6, 6>(row, row) += gravity_restoring(weight, b.position + b.centre_of_gravity - points_[i]) -
                                     gravity_restoring(weight_in_data, *facts.centre_of_gravity - points_[i]);
    }
  }

  const Scene& scene_;
  Coefficients c_;
  std::vector<int> bodies_;
  bool single_;
  std::vector<std::string>& notes_;
  std::vector<Eigen::Vector3d> points_;
};

/// Modes that the scene does not let the waves excite feel nothing of them.
void suppress(const Scene& scene, Coefficients& about_centres, const std::vector<int>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& excited = hydrodynamics(scene, bodies[i]).excited;
    for (std::size_t mode = 0; mode < 6; ++mode)
      if (!excited[mode])
        for (auto& X : about_centres.X) X.row(static_cast<Eigen::Index>(6 * i + mode)).setZero();
  }
}

}  // namespace

std::string listed_bodies(const Scene& scene, const std::vector<int>& set) {
  constexpr std::size_t most = 6;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, set.size()); ++i)
    names.push_back(scene.bodies[static_cast<std::size_t>(set[i])].name);
  if (set.size() > most) names.push_back(fmt::format("{} more", set.size() - most));
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

void add_hydrodynamics(const Scene& scene, Prepared& prepared) {
  std::vector<Use> all = uses(scene, *prepared.kept);
  prepared.sharing_waves = sharing_waves(scene, all);
  require_said(scene, prepared.sharing_waves);
  note_sets(scene, prepared.sharing_waves, prepared.notes);
  for (Use& use : all) {
    examine(scene, use, *prepared.kept, prepared.notes);
    const hydro::WaterDepth depth = take_depth(scene, use, prepared.other_depths);
    for (const auto& note : use.data->notes) prepared.notes.push_back(note);
    for (const auto& set : interacting(scene, use)) {
      std::vector<int> bodies, of_file;
      for (const std::size_t i : set) {
        bodies.push_back(use.bodies[i]);
        of_file.push_back(use.file_body[i]);
      }
      const Hydrodynamics& h = hydrodynamics(scene, bodies.front());
      Coefficients of_set = hydro::potential::select(*use.data, of_file);
      of_set.water.depth = depth;
      Coefficients c = Placement(scene, std::move(of_set), bodies, use.data->bodies() == 1, prepared.notes).place();
      add_hydrostatics(scene, c, bodies, prepared);
      suppress(scene, c, bodies);
      std::vector<Eigen::Vector3d> origins;
      for (const int b : bodies) origins.push_back(scene.bodies[static_cast<std::size_t>(b)].position);
      prepared.groups.push_back(
          {bodies, hydro::potential::FrequencyTable(std::move(c), origins), h.radiation, h.excitation});
      prepared.memory.push_back(h.memory);
    }
  }
}

void check_waves_of_rao(const Scene& scene, const Prepared& prepared, std::vector<std::string>& notes) {
  const double lowest = *std::min_element(scene.rao->omega.begin(), scene.rao->omega.end());
  note_other_depths(scene, prepared, {{lowest, 1, "the longest waves asked for"}}, notes);
  for (const auto& group : prepared.groups) {
    if (!group.excitation) continue;
    for (const double heading : scene.rao->headings) {
      scene::placed(scene.rao->headings_place, [&] { group.table.excitation(group.table.lowest(), heading); });
    }
  }
}

}  // namespace froude::compile
