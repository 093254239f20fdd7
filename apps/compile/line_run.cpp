/// \file  A line on its way: its steps, and what its signals are read off.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compile/lines.hpp"
#include "hydro/base/error.hpp"

namespace froude::compile {

namespace dl = dynamics::line;

void LineRun::begin() {
  first_height_ = energies().height;
  for (const dl::LinkAngles& a : model_.before) angles_.push_back({a, 0, 0});
  for (const LineModel::Part& part : model_.parts) {
    snaps_.emplace_back();
    if (part.snaps) snaps_.back().emplace(part.segments, part.snaps->slack_below, part.snaps->snap_above);
  }
  look();
  note_turnover();
  looked_ = false;  // bodies may have been brought to their start meanwhile
}

/// After each step: energies between two samples count too.
void LineRun::note_turnover() {
  const dl::Energies& e = energies();
  turnover_ = std::max(
      {turnover_, e.kinetic, e.axial, std::abs(e.height - first_height_), std::abs(e.supplied()), e.dissipated()});
}

void LineRun::note(double h) {
  looked_ = false;
  note_turnover();
  for (std::size_t k = 0; k < snaps_.size(); ++k) {
    const LineModel::Part& part = model_.parts[k];
    if (snaps_[k]) snaps_[k]->note(state().time, h, state().tension.segment(part.first_segment, part.segments));
  }
}

LineRun::LineRun(const LineModel& model, dl::DrivenLine& driven) : model_(model), driven_(&driven) { begin(); }

LineRun::LineRun(const LineModel& model)
    : model_(model), state_(model.start), stepper_(std::make_unique<dl::Stepper>(*model.line, model.settings)) {
  stepper_->start(state_);
  if (model.lyapunov) perturbed_ = std::make_unique<dl::PerturbedTrajectory>(*model.line, model.settings, state_);
  begin();
}

dl::StepReport LineRun::step(double h) {
  if (driven_ != nullptr) return {};
  try {
    const dl::StepReport report = stepper_->step(state_, h);
    if (perturbed_) perturbed_->follow(state_, report, h);
    return report;
  } catch (const hydro::NumericsError& e) {
    throw hydro::NumericsError(fmt::format("{}: {}", quoted_names_of(model_), e.what()));
  }
}

std::optional<dynamics::Exponent> LineRun::exponent() const {
  if (!perturbed_) return std::nullopt;
  return perturbed_->growth().exponent(model_.lyapunov->from);
}

void LineRun::keep_state(hydro::StateBytes& bytes) {
  if (driven_ == nullptr) {
    bytes.pass(state_);
    stepper_->keep_state(state_, bytes);
  }
  if (perturbed_) bytes.pass(*perturbed_);
  for (auto& snaps : snaps_)
    if (snaps) bytes.pass(*snaps);
  bytes.pass(angles_, first_height_, turnover_);
  looked_ = false;
}

void LineRun::look() {
  if (looked_) return;
  looked_ = true;
  if (driven_ == nullptr && !stepper_->find_balance(state_, balance_)) {
    balance_ = {.acceleration = dl::Places::Zero(3, model_.line->nodes()),
                .tension = state_.tension,
                .holding = dl::Places::Zero(3, model_.line->nodes())};
  }
  const bool first = angles_.empty();
  angles_.resize(static_cast<std::size_t>(model_.line->segments()));
  for (int j = 0; j < model_.line->segments(); ++j) {
    Angles& a = angles_[static_cast<std::size_t>(j)];
    const int node = model_.line->first(j);
    const dl::LinkAngles now = first ? dl::first_link_angles(state(), node) : dl::link_angles(state(), node, a);
    const dl::LinkAngles rate = dl::link_rates(state(), node, now);
    a = {{now.polar, now.azimuth}, rate.polar, rate.azimuth};
  }
}

}  // namespace froude::compile
