#include "compile/fit_folder.hpp"

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "compile/archive.hpp"
#include "fit_sources.hpp"

namespace froude::compile {
namespace {

using hydro::radiation::RationalFit;

constexpr const char* extension_of_fits = ".fit";

/// All of a fit, either way.
template <class Archive, class Fit>
void pass_fit(Archive& archive, Fit& fit) {
  auto& [model, A_inf, report] = fit;
  auto& [poles, C, S] = model;
  archive.list(poles, [](auto& of, auto& pole) {
    auto& [decay, omega] = pole;
    of(decay);
    of(omega);
  });
  archive(C);
  archive(S);
  archive(A_inf);
  auto& [order, error, error_per_pair, error_before, passive, margin, most_negative, lift, shift, negative_share, why] =
      report;
  archive(order);
  archive(error);
  archive(error_per_pair);
  archive(error_before);
  archive(passive);
  archive(margin);
  archive(most_negative);
  archive(lift);
  archive(shift);
  archive(negative_share);
  archive(why);
}

/// What decides on every bit of a fit: the program that fits, and the data.
std::string key_of(const SymmetricData& data, double tolerance) {
  ArchiveWriter out{maker("radiation fit", FROUDE_FIT_SOURCES)};
  out(tolerance);
  out(data.damping.omega);
  out(data.damping.B);
  out(data.A);
  out(data.A_inf);
  return std::move(out.bytes);
}

}  // namespace

std::optional<RationalFit> FitFolder::find(const SymmetricData& data, double tolerance) const {
  const auto bytes = files_.find(key_of(data, tolerance), extension_of_fits);
  if (!bytes) return std::nullopt;
  try {
    ArchiveReader reader(*bytes);
    RationalFit out;
    pass_fit(reader, out);
    if (reader.at_end()) return out;
  } catch (const std::length_error&) {
  }
  return std::nullopt;
}

void FitFolder::keep(const SymmetricData& data, double tolerance, const RationalFit& fit) const {
  ArchiveWriter out;
  pass_fit(out, fit);
  files_.keep(key_of(data, tolerance), out.bytes, extension_of_fits);
}

namespace {
std::mutex folder_lock;
std::optional<FitFolder> folder_of_process;
}  // namespace

std::optional<FitFolder> fit_folder() {
  const std::scoped_lock one_at_a_time(folder_lock);
  return folder_of_process;
}

void set_fit_folder(std::optional<FitFolder> folder) {
  const std::scoped_lock one_at_a_time(folder_lock);
  folder_of_process = std::move(folder);
}

}  // namespace froude::compile
