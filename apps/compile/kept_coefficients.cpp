#include "compile/kept_coefficients.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "compile/archive.hpp"
#include "compile/fit_folder.hpp"

namespace froude::compile {
namespace {

using hydro::potential::Coefficients;

constexpr const char* extension_of_coefficients = ".coefficients";

/// All of them, either way, but for what they were asked for: the water.
template <class Archive, class Table>
void pass_coefficients(Archive& archive, Table& coefficients) {
  auto& [water, body, omega, heading, A, B, A_zero, A_inf, X, C, source, notes] = coefficients;
  archive.list(body, [](auto& of, auto& one) {
    auto& [name, reference_point, centre_of_gravity, centre_of_buoyancy, displaced_volume] = one;
    of(name);
    of(reference_point);
    of(centre_of_gravity);
    of(centre_of_buoyancy);
    of(displaced_volume);
  });
  archive(omega);
  archive(heading);
  archive(A);
  archive(B);
  archive(A_zero);
  archive(A_inf);
  archive(X);
  archive(C);
  archive(source);
  archive(notes);
}

std::optional<Coefficients> coefficients_in(const KeptFiles& files, const std::string& key) {
  const auto bytes = files.find(key, extension_of_coefficients);
  if (!bytes) return std::nullopt;
  try {
    ArchiveReader reader(*bytes);
    Coefficients out;
    pass_coefficients(reader, out);
    if (reader.at_end()) return out;
  } catch (const std::length_error&) {
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::filesystem::path> folder_of_kept(const std::string& key) {
  const auto folder = fit_folder();
  if (folder && coefficients_in(folder->files(), key)) return folder->path();
  return std::nullopt;
}

std::optional<Coefficients> kept_coefficients(const std::string& key, const hydro::Water& water) {
  const auto folder = fit_folder();
  auto out = folder ? coefficients_in(folder->files(), key) : std::nullopt;
  if (!out) return std::nullopt;
  out->water = water;
  out->notes.push_back(fmt::format("{}: solved before and kept in {}; FROUDE_CACHE=off solves anew", out->source,
                                   folder->path().string()));
  return out;
}

void keep_coefficients(const std::string& key, const Coefficients& coefficients) {
  const auto folder = fit_folder();
  if (!folder) return;
  ArchiveWriter out;
  pass_coefficients(out, coefficients);
  folder->files().keep(key, out.bytes, extension_of_coefficients);
}

}  // namespace froude::compile
