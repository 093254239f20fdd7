#pragma once
/// \file  Private to compile/: what is fastened to the part of a body that a section describes, and its loads there.
/// (D172) in docs/theory/loads.md.
#include <memory>
#include <vector>

#include "compile/compile.hpp"

namespace froude::compile {

/// Loads of moorings, connectors, lines, power take-offs, joints and other elements on one part of a body.
class FastenedToPart {
 public:
  /// `model`: of small motions, made of `prepared`; it must live as long. \throws hydro::InputError, at the section,
  /// naming what lies in its plane, acts on both sides of it, or is of a kind whose share of the load is not known
  FastenedToPart(const scene::Scene& scene, const Prepared& prepared, const dynamics::Model& model, int body,
                 const scene::Section& section);

  /// About the body's centre of gravity where the bodies are still, along axes of the body, N and N m.
  dynamics::Vector6 at_rest(const dynamics::Still& still) const;
  /// How its six components vary with small motions.
  std::vector<dynamics::Variation> variations(const dynamics::Still& still) const;

 private:
  struct JointEnd {
    int joint;
    dynamics::End end;
    dynamics::Matrix6 to_centre;  ///< of a load about the joint, along axes of the body
  };
  void add_forces(std::vector<dynamics::Variation>& out, const dynamics::State& still) const;

  const dynamics::JointSet& joints_;
  int body_;
  std::shared_ptr<const dynamics::Model> forces_;  ///< of the bodies, with the elements that act on the part alone
  std::vector<JointEnd> ends_;
};

/// What m does to six signals that vary so: one row of m each.
std::vector<dynamics::Variation> product(const dynamics::Matrix6& m, const std::vector<dynamics::Variation>& six);

}  // namespace froude::compile
