// froude bem solve, of hulls given as meshes: reads, tells the cost, solves by panels, writes.
#include "froude/bem/solve_hulls.hpp"

#include <ostream>
#include <set>

#include "compile/hulls.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

namespace hp = hydro::panels;

std::vector<hp::HullBody> hull_bodies(const BemHullArguments& a) {
  std::vector<hp::HullBody> bodies;
  std::set<std::string> names;
  for (std::size_t b = 0; b < a.meshes.size(); ++b) {
    const std::string stem = a.meshes[b].stem().string();
    std::string name = stem;
    for (int copy = 2; !names.insert(name).second; ++copy) name = fmt::format("{}{}", stem, copy);
    bodies.push_back({.name = name,
                      .reference_point = a.reference.empty() ? Eigen::Vector3d::Zero() : a.reference[b],
                      .centre_of_gravity = {},
                      .hull = hydro::hydrostatics::Hull(hydro::hydrostatics::read_mesh(a.meshes[b], a.mesh))});
    if (!a.centre_of_gravity.empty()) bodies.back().centre_of_gravity = a.centre_of_gravity[b];
  }
  return bodies;
}

std::vector<NamedFile> mesh_inputs(const std::vector<Path>& meshes) {
  std::vector<NamedFile> files;
  for (const Path& mesh : meshes) files.push_back({"the mesh", mesh});
  return files;
}

}  // namespace

void write_hulls(const hp::Solution& solution, CoefficientFormat format, const Path& output, const Console& console) {
  const WrittenCoefficients written = write_as(format, solution.coefficients, output);
  const auto& check = solution.check;
  Report out;
  out.say("wrote {}", fact("files", written.files, fmt::join(written.files, ", ")));
  out.sentences("notes", "  {}", solution.coefficients.notes);
  out.sentences("left_out", "  left out or changed: {}", written.left_out);
  out.keep("panels", check.panels).keep("lid_panels", check.lid_panels);
  out.keep("planes_of_symmetry", check.planes_of_symmetry);
  out.keep("kinds_of_hulls", check.kinds).keep("partial_waves", check.partial_waves);
  out.keep("self_check/energy", check.energy).keep("self_check/haskind", check.haskind);
  out.keep("self_check/reciprocity", check.reciprocity);
  out.keep("extrapolated_from_panels", check.extrapolated_from);
  tell(out.keep("self_check/estimated_error", check.estimate), console);
}

void bem_solve_hulls(const BemHullArguments& a, const Console& console) {
  const CoefficientFormat target = format_of(a.output, a.format);
  require_outputs(files_to_write(target, a.output), mesh_inputs(a.meshes));
  const std::vector<hp::HullBody> bodies = hull_bodies(a);
  const hp::Cost cost = hp::cost(bodies, a.water, a.omega, a.heading, a.options);
  if (console.show_progress) console.err << compile::size_of_hulls(cost, a.omega.size(), a.heading.size()) << '\n';
  Progress progress(console.err, "solve", console.show_progress);
  hp::Options options = a.options;
  options.progress = [&](int done, int all) { progress.update(static_cast<double>(done) / all); };
  write_hulls(hp::solve(bodies, a.water, a.omega, a.heading, options), target, a.output, console);
}

}  // namespace froude
