#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "hydro/potential/formats/responses.hpp"
#include "potential/readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {

double added_mass_scale(Eigen::Index i, Eigen::Index j, double ulen) {
  return std::pow(ulen, 3 + !is_translation(i) + !is_translation(j));
}
double restoring_scale(Eigen::Index i, Eigen::Index j, double ulen) { return added_mass_scale(i, j, ulen) / ulen; }
double excitation_scale(Eigen::Index i, double ulen) { return std::pow(ulen, 2 + !is_translation(i)); }

double frequency_of_per(double per, FirstColumn column, const Water& water, double ulen) {
  switch (column) {  // (P9)
    case FirstColumn::period:
      return 2 * std::numbers::pi / per;
    case FirstColumn::omega:
      return per;
    case FirstColumn::deep_wavenumber:
      return std::sqrt(per * water.gravity / ulen);
    case FirstColumn::wavelength:
      return frequency_of_wavenumber(2 * std::numbers::pi / per, water);
    case FirstColumn::wavenumber:
      break;
  }
  return frequency_of_wavenumber(per / ulen, water);
}

namespace fs = std::filesystem;

WamitFiles find_wamit_files(const fs::path& path) {
  std::string stem = path.string();
  const std::string extension = path.extension().string();
  constexpr std::array members{".1", ".2", ".3", ".3fk", ".3sc", ".hst", ".out"};
  const bool is_member = std::find(members.begin(), members.end(), extension) != members.end();
  if (is_member) stem.resize(stem.size() - extension.size());
  const WamitFiles files{stem + ".1", stem};
  if (fs::exists(files.radiation)) return files;
  if (!fs::exists(path))
    throw InputError(
        fmt::format("cannot read \"{}\": no such file, nor a set of WAMIT files of that stem", path.string()), {},
        "check the path; paths in a scene are relative to the scene file");
  if (is_member)
    throw InputError(fmt::format("\"{}\" has no \"{}\" beside it", path.string(), files.radiation.filename().string()),
                     {}, "added mass and damping are needed too: put the .1 file in the same folder");
  if (response_kind(path) != ResponseKind::none)
    throw InputError("the file holds motions or second-order loads, no coefficients", {.file = path.string()},
                     "give the .1 file of its set; `froude bem info` tells what this file holds");
  throw InputError("not a file of coefficients that Froude knows", {.file = path.string()},
                   "give a Capytaine .nc, a BEMIO .h5, a Froude .h5, an AQWA .AH1, a Nemoh.cal, a HAMS ControlFile.in, "
                   "a VERES .re7, a .hdb, or a WAMIT .1 file (or the stem of its set)");
}

constexpr const char* rigid_bodies_only =
    "Froude reads rigid bodies, six modes each: run WAMIT without generalised modes (NEWMDS = 0)";

int count_bodies(const WamitTable& table, const std::vector<std::size_t>& columns, std::optional<int> told) {
  int highest = 0, highest_of_first = 0;
  WamitTable::Row where;
  for (const auto& row : table.rows())
    for (const std::size_t column : columns) {
      const int mode = table.mode(row, column);
      if (mode > highest) where = row;
      highest = std::max(highest, mode);
      if (mode <= 6) highest_of_first = std::max(highest_of_first, mode);
    }
  const int bodies = (highest + 5) / 6, of_last = highest - 6 * (bodies - 1);
  if (told && bodies > *told)
    throw InputError(fmt::format("mode {} is one too many for the {} rigid {} that the .out file tells of: the modes "
                                 "from {} on are generalised (flexible) ones",
                                 highest, *told, *told == 1 ? "body" : "bodies", 6 * *told + 1),
                     table.place(where), rigid_bodies_only);
  // Modes that a body lacks by symmetry may be absent, so six are not always there; but a last body that lacks what the
  // first one has is none.
  if (!told && bodies > 1 && of_last < highest_of_first && of_last < 6)
    throw InputError(fmt::format("the modes end with {}, which is not six a body: those from {} on look like "
                                 "generalised (flexible) modes",
                                 highest, 6 * (bodies - 1) + 1),
                     table.place(where),
                     fmt::format("{}; if they are of a rigid body {}, put the .out file beside, or add a row of zeros "
                                 "for mode {}",
                                 rigid_bodies_only, bodies, 6 * bodies));
  return bodies;
}

namespace {

std::vector<RadiationBlock> blocks_of(const WamitTable& table, std::optional<int> bodies) {
  const Eigen::Index n = 6 * count_bodies(table, {1, 2}, bodies);
  std::vector<RadiationBlock> blocks;
  std::map<double, std::size_t> index_of;
  for (const auto& row : table.rows()) {
    const auto [at, is_new] = index_of.try_emplace(row.value[0], blocks.size());
    if (is_new) {
      blocks.push_back({row.value[0], row, Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}});
      blocks.back().present.setConstant(n, n, false);
    }
    RadiationBlock& block = blocks[at->second];
    const int i = table.mode(row, 1) - 1, j = table.mode(row, 2) - 1;
    if (std::exchange(block.present(i, j), true))
      throw InputError(fmt::format("entry ({}, {}) of PER = {} is there twice", i + 1, j + 1, row.value[0]),
                       table.place(row), "keep one of the two rows");
    if (row.value.size() == 4 && row.value[0] > 0)
      throw InputError("the row has no damping: four numbers are enough for the limits (PER = 0 and PER < 0) only",
                       table.place(row), "a row is: PER I J A B");
    block.A(i, j) = row.value[3];
    block.B(i, j) = row.value.size() == 5 ? row.value[4] : 0;
  }
  return blocks;
}

/// An entry may be absent, being zero, but then at every frequency.
void require_same_entries(const std::vector<RadiationBlock>& blocks, const WamitTable& table) {
  const RadiationBlock& model = blocks.front();
  for (const RadiationBlock& block : blocks)
    for (Eigen::Index i = 0; i < block.present.rows(); ++i)
      for (Eigen::Index j = 0; j < block.present.cols(); ++j)
        if (block.present(i, j) != model.present(i, j)) {
          const auto& lacking = block.present(i, j) ? model : block;
          const auto& having = block.present(i, j) ? block : model;
          throw InputError(
              fmt::format("PER = {} has no entry ({}, {}), which PER = {} has", lacking.per, i + 1, j + 1, having.per),
              table.place(lacking.first_row), "the file may be cut short or mixed from two runs");
        }
}

struct SortedBlocks {
  std::vector<const RadiationBlock*> finite;  ///< ascending in ω
  std::vector<double> omega;
  const RadiationBlock* negative = nullptr;
  const RadiationBlock* zero = nullptr;
};

SortedBlocks sorted(const std::vector<RadiationBlock>& blocks, const WamitRun& run, const WamitTable& table) {
  SortedBlocks out;
  for (const RadiationBlock& block : blocks) {
    if (block.per > 0) {
      out.finite.push_back(&block);
    } else if (std::exchange(block.per < 0 ? out.negative : out.zero, &block) != nullptr) {
      throw InputError("a second negative PER; one limit is written this way", table.place(block.first_row, 0));
    }
  }
  if (out.finite.empty()) throw InputError("there is no finite, positive period", {.file = table.path().string()});
  const auto omega = [&](const RadiationBlock* b) { return frequency_of_per(b->per, run.column, run.water, run.ulen); };
  std::sort(out.finite.begin(), out.finite.end(), [&](auto* a, auto* b) { return omega(a) < omega(b); });
  for (const RadiationBlock* b : out.finite) out.omega.push_back(omega(b));
  return out;
}

Eigen::MatrixXd dimensional(const Eigen::MatrixXd& m, double factor, double ulen) {
  return Eigen::MatrixXd::NullaryExpr(m.rows(), m.cols(), [&](Eigen::Index i, Eigen::Index j) {
    return m(i, j) * factor * added_mass_scale(i, j, ulen);
  });
}

/// A = ρ Ā L^k, B = ρ ω B̄ L^k  (P8). Returns the values of PER in the order of c.omega.
std::vector<double> fill_radiation(Coefficients& c, const WamitTable& table, const WamitRun& run) {
  const double ulen = run.ulen;
  const auto blocks = blocks_of(table, run.bodies);
  require_same_entries(blocks, table);
  const SortedBlocks s = sorted(blocks, run, table);
  const double rho = c.water.density;
  std::vector<double> per;
  for (std::size_t k = 0; k < s.finite.size(); ++k) {
    c.A.push_back(dimensional(s.finite[k]->A, rho, ulen));
    c.B.push_back(dimensional(s.finite[k]->B, rho * s.omega[k], ulen));
    per.push_back(s.finite[k]->per);
  }
  c.omega = s.omega;
  const WamitLimits limits = assign_limits(s.negative, s.zero, s.finite, run.column, table);
  if (limits.zero != nullptr) c.A_zero = dimensional(limits.zero->A, rho, ulen);
  if (limits.infinite != nullptr) c.A_inf = dimensional(limits.infinite->A, rho, ulen);
  if (limits.note) c.notes.push_back(*limits.note);
  for (const RadiationBlock* limit : {limits.zero, limits.infinite})
    if (limit != nullptr && !limit->B.isZero(0))
      c.notes.push_back(
          fmt::format("damping written for the limit PER = {} is left out: it is zero there", limit->per));
  for (Eigen::Index b = 0; b < blocks.front().A.rows() / 6; ++b)
    c.body.push_back({.name = fmt::format("body{}", b + 1),
                      .reference_point = {},
                      .centre_of_gravity = {},
                      .centre_of_buoyancy = {},
                      .displaced_volume = {}});
  return per;
}

/// Still water does not hold a rigid body in surge and sway, and what another body does changes nothing.
void require_rigid(const Eigen::MatrixXd& C, const Eigen::MatrixXi& line, const WamitTable& table) {
  constexpr double round_off = 1e-6;  // of seven printed digits
  const double largest = C.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < C.rows(); ++i)
    for (Eigen::Index j = 0; j < C.cols(); ++j) {
      const bool is_other_body = i / 6 != j / 6, is_horizontal = i >= 6 && i == j && i % 6 < 2;
      if ((is_other_body || is_horizontal) && std::abs(C(i, j)) > round_off * largest)
        throw InputError(fmt::format("restoring ({}, {}) is not zero, as it is for rigid bodies: the modes from 7 on "
                                     "look like generalised (flexible) ones",
                                     i + 1, j + 1),
                         table.text_place(line(i, j)), rigid_bodies_only);
    }
}

/// C = ρ g C̄ L^k  (P8).
void fill_restoring(Coefficients& c, const WamitTable& table, double ulen) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(c.modes(), c.modes());
  Eigen::MatrixXi line = Eigen::MatrixXi::Zero(c.modes(), c.modes());
  for (const auto& row : table.rows()) {
    const Eigen::Index i = table.mode(row, 0) - 1, j = table.mode(row, 1) - 1;
    for (const std::size_t column : {0u, 1u})
      if (const int mode = table.mode(row, column); mode > c.modes())
        throw InputError(
            fmt::format("mode {} belongs to body {}, but the .1 file has {}", mode, (mode + 5) / 6, c.bodies()),
            table.place(row, column), "the files must come from one run");
    if (line(i, j) != 0)
      throw InputError(fmt::format("entry ({}, {}) is in line {} already", i + 1, j + 1, line(i, j)), table.place(row),
                       "keep one of the two rows");
    line(i, j) = row.line;
    C(i, j) = row.value[2] * c.water.density * c.water.gravity * restoring_scale(i, j, ulen);
  }
  require_rigid(C, line, table);
  for (Eigen::Index b = 0; b < c.bodies(); ++b)
    if (line.middleRows(6 * b, 6).isZero() && !c.A.front().middleRows(6 * b, 6).isZero(0))
      throw InputError(fmt::format("there is no row of body {}; the .1 file has {} bodies", b + 1, c.bodies()),
                       {.file = table.path().string()}, "the files must come from one run");
  c.C = C;
}

/// From diffraction (.3), by Haskind's relation (.2) or as Froude–Krylov and scattering parts, in this order.
void fill_excitation(Coefficients& c, const WamitFiles& files, const std::vector<double>& per, double ulen) {
  const auto add = [&](const fs::path& file) {
    fill_excitation(c, WamitTable::read(file, {7}, "PER BETA I Mod Pha Re Im"), per, ulen);
    c.source += ", " + file.extension().string();
  };
  const fs::path diffraction = files.member(".3"), haskind = files.member(".2"), krylov = files.member(".3fk"),
                 scattering = files.member(".3sc");
  if (fs::exists(diffraction)) return add(diffraction);
  if (fs::exists(haskind)) {
    c.notes.push_back("excitation is from Haskind's relation (.2): there is no .3 file");
    return add(haskind);
  }
  if (!fs::exists(krylov) || !fs::exists(scattering)) {
    c.notes.push_back(fmt::format("no excitation: there is no {}", diffraction.filename().string()));
    return;
  }
  add(krylov);
  const auto heading = std::exchange(c.heading, {});
  const auto X = std::exchange(c.X, {});
  add(scattering);
  if (c.heading != heading)
    throw InputError("the headings are not those of the .3fk file", {.file = scattering.string()},
                     "the files must come from one run");
  for (std::size_t b = 0; b < X.size(); ++b) c.X[b] += X[b];
  c.notes.push_back("excitation is the sum of the parts in .3fk and .3sc");
}

}  // namespace

Coefficients read_numeric_files(const WamitFiles& files, const WamitRun& run) {
  Coefficients c;
  c.water = run.water;
  c.source = files.radiation.string();
  const auto per = fill_radiation(c, WamitTable::read(files.radiation, {4, 5}, "PER I J A B"), run);
  fill_excitation(c, files, per, run.ulen);
  if (run.time_factor == TimeFactor::minus_i_omega_t)
    for (auto& X : c.X) X = X.conjugate().eval();  // (P7)
  const fs::path restoring = files.member(".hst");
  if (fs::exists(restoring)) {
    fill_restoring(c, WamitTable::read(restoring, {3}, "I J C"), run.ulen);
    c.source += ", .hst";
  } else {
    c.notes.push_back(fmt::format("no restoring matrix: there is no {}", restoring.filename().string()));
  }
  if (const auto doubt = sign_of_other_time_factor(c))
    throw InputError(doubt->rule, {.file = files.radiation.string()}, doubt->remedy);
  return c;
}

}  // namespace hydro::potential
