#include "hydro/panels/field.hpp"

#include "discretisation.hpp"
#include "potential/solver_request.hpp"
#include "refine.hpp"
#include "request.hpp"

namespace hydro::panels {

potential::WaveField wave_field(const std::vector<HullBody>& bodies, const Water& water,
                                const potential::FieldQuestion& question, const Options& options) {
  check_request({question.omega}, {question.heading}, options);
  const auto given = discretised(bodies, water, {question.omega}, 1, options);
  potential::check(question, bodies.size());
  const int threads = potential::thread_count(options.threads, static_cast<std::size_t>(question.point.rows()));
  // Away from hulls the surface does not see how fine their edges are.
  const auto coarse = given->graded(question.omega, 0);
  const potential::WaveField before = coarse->solver()->field(question, threads);
  potential::WaveField out = coarse->refined()->solver()->field(question, threads);
  out.estimate = difference(before, out);
  if (out.on_hulls) out.on_hulls->estimate = difference(*before.on_hulls, *out.on_hulls, &pieces_when_refined);
  if (out.on_bodies)
    out.on_bodies->estimate = difference(*before.on_bodies, *out.on_bodies) +
                              missed(*out.on_bodies, mean_drift(out.far, question.omega, water));
  if (const auto more = coarse->with_more_partial_waves()) {
    const potential::WaveField with_more = more->field(question, threads);
    out.estimate += difference(before, with_more);
    if (out.on_bodies) out.on_bodies->estimate += difference(*before.on_bodies, *with_more.on_bodies);
  }
  return out;
}

}  // namespace hydro::panels
