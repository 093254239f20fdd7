#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {

double added_mass_scale(Eigen::Index i, Eigen::Index j, double ulen) {
  return std::pow(ulen, 3 + !is_translation(i) + !is_translation(j));
}
double restoring_scale(Eigen::Index i, Eigen::Index j, double ulen) { return added_mass_scale(i, j, ulen) / ulen; }
double excitation_scale(Eigen::Index i, double ulen) { return std::pow(ulen, 2 + !is_translation(i)); }

double frequency_of_per(double per, int iperout, const Water& water, double ulen) {
  switch (iperout) {  // (P9)
    case 1:
      return 2 * std::numbers::pi / per;
    case 2:
      return per;
    case 3:
      return std::sqrt(per * water.gravity / ulen);
    default:
      return frequency_of_wavenumber(per / ulen, water);
  }
}

namespace {

namespace fs = std::filesystem;

struct WamitFiles {
  fs::path radiation, excitation, restoring;
};

/// The set of files, from any of them or from the stem.
WamitFiles find_files(const fs::path& path) {
  std::string stem = path.string();
  const std::string extension = path.extension().string();
  const bool is_member = extension == ".1" || extension == ".3" || extension == ".hst";
  if (is_member) stem.resize(stem.size() - extension.size());
  const WamitFiles files{stem + ".1", stem + ".3", stem + ".hst"};
  if (fs::exists(files.radiation)) return files;
  if (!fs::exists(path))
    throw InputError(
        fmt::format("cannot read \"{}\": no such file, nor a set of WAMIT files of that stem", path.string()), {},
        "check the path; paths in a scene are relative to the scene file");
  if (is_member)
    throw InputError(fmt::format("\"{}\" has no \"{}\" beside it", path.string(), files.radiation.filename().string()),
                     {}, "added mass and damping are needed too: put the .1 file in the same folder");
  throw InputError("not a file of coefficients that Froude knows", {.file = path.string()},
                   "give a Capytaine .nc, a BEMIO .h5, a Froude .h5, or a WAMIT .1 file (or the stem of its set)");
}

Water stated_water(const ReadOptions& options, const fs::path& file) {
  std::vector<std::string> missing;
  if (!options.density) missing.push_back("density");
  if (!options.gravity) missing.push_back("gravity");
  if (!options.depth) missing.push_back("water depth");
  if (!missing.empty())
    throw InputError(
        fmt::format("WAMIT's numeric files do not hold the {}", fmt::join(missing, ", ")), {.file = file.string()},
        "state density, gravity and depth: in the [water] table of a scene, or as options of `froude bem`");
  require(*options.density > 0, "density must be positive, got {} kg/m³", *options.density);
  require(*options.gravity > 0, "gravity must be positive, got {} m/s²", *options.gravity);
  require(std::isfinite(options.ulen) && options.ulen > 0, "ULEN must be positive, got {} m", options.ulen);
  if (options.iperout)
    require(*options.iperout >= 1 && *options.iperout <= 4,
            "IPEROUT must be 1 (period), 2 (frequency), 3 (KL) or 4 (νL), got {}", *options.iperout);
  return {*options.density, *options.gravity, *options.depth};
}

std::vector<RadiationBlock> blocks_of(const WamitTable& table) {
  int highest = 0;
  for (const auto& row : table.rows()) highest = std::max({highest, table.mode(row, 1), table.mode(row, 2)});
  const Eigen::Index n = (highest + 5) / 6 * 6;
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

SortedBlocks sorted(const std::vector<RadiationBlock>& blocks, int iperout, const Water& water, double ulen,
                    const WamitTable& table) {
  SortedBlocks out;
  for (const RadiationBlock& block : blocks) {
    if (block.per > 0) {
      out.finite.push_back(&block);
    } else if (std::exchange(block.per < 0 ? out.negative : out.zero, &block) != nullptr) {
      throw InputError("a second negative PER; one limit is written this way", table.place(block.first_row, 0));
    }
  }
  if (out.finite.empty()) throw InputError("there is no finite, positive period", {.file = table.path().string()});
  const auto omega = [&](const RadiationBlock* b) { return frequency_of_per(b->per, iperout, water, ulen); };
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
std::vector<double> fill_radiation(Coefficients& c, const WamitTable& table, int iperout, double ulen) {
  const auto blocks = blocks_of(table);
  require_same_entries(blocks, table);
  const SortedBlocks s = sorted(blocks, iperout, c.water, ulen, table);
  const double rho = c.water.density;
  std::vector<double> per;
  for (std::size_t k = 0; k < s.finite.size(); ++k) {
    c.A.push_back(dimensional(s.finite[k]->A, rho, ulen));
    c.B.push_back(dimensional(s.finite[k]->B, rho * s.omega[k], ulen));
    per.push_back(s.finite[k]->per);
  }
  c.omega = s.omega;
  const WamitLimits limits = assign_limits(s.negative, s.zero, s.finite, iperout, table);
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
  c.C = C;
}

/// A doubtful IPEROUT that nobody stated is an error; one that was stated is the caller's word against the file's.
void examine_iperout(Coefficients& c, const ReadOptions& options, const fs::path& file) {
  const auto doubt = sign_of_wrong_iperout(c);
  if (!options.iperout) {
    if (doubt)
      throw InputError("the first column does not look like periods: " + *doubt, {.file = file.string()},
                       "state IPEROUT: 1 period, 2 frequency in rad/s, 3 ω²L/g, 4 finite-depth wavenumber times L");
    c.notes.push_back("IPEROUT is not stated: the first column is taken for periods in seconds (IPEROUT = 1)");
  } else if (doubt) {
    c.notes.push_back(fmt::format("IPEROUT = {} is doubtful: {}", *options.iperout, *doubt));
  }
}

}  // namespace

Coefficients read_wamit(const fs::path& path, const ReadOptions& options) {
  const WamitFiles files = find_files(path);
  Coefficients c;
  c.water = stated_water(options, files.radiation);
  const int iperout = options.iperout.value_or(1);
  c.source = fmt::format("WAMIT numeric files {}", files.radiation.string());
  const auto per = fill_radiation(c, WamitTable::read(files.radiation, {4, 5}, "PER I J A B"), iperout, options.ulen);
  if (fs::exists(files.excitation)) {
    fill_excitation(c, WamitTable::read(files.excitation, {7}, "PER BETA I Mod Pha Re Im"), per, options.ulen);
    c.source += ", .3";
  } else {
    c.notes.push_back(fmt::format("no excitation: there is no {}", files.excitation.filename().string()));
  }
  if (fs::exists(files.restoring)) {
    fill_restoring(c, WamitTable::read(files.restoring, {3}, "I J C"), options.ulen);
    c.source += ", .hst";
  } else {
    c.notes.push_back(fmt::format("no restoring matrix: there is no {}", files.restoring.filename().string()));
  }
  examine_iperout(c, options, files.radiation);
  c.notes.push_back("WAMIT's numeric files do not say where the reference points of the bodies (XBODY) are");
  return c;
}

}  // namespace hydro::potential
