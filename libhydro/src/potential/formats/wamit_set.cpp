#include <algorithm>
#include <cmath>

#include "potential/readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

bool differ(double a, double b) {  // either may be an infinite depth
  return a != b && !(std::abs(a - b) <= 1e-6 * std::min(std::abs(a), std::abs(b)));
}

/// The caller's word, or what the .out file states; a contradiction is noted, and the file is believed.
double stated(const char* what, std::optional<double> asked, std::optional<double> found, double otherwise,
              std::vector<std::string>& notes) {
  if (!found) return asked.value_or(otherwise);
  if (asked && differ(*asked, *found))
    notes.push_back(
        fmt::format("{} {} was asked for, but the .out file states {}, which is used", what, *asked, *found));
  return *found;
}

void require_sound(const ReadOptions& options) {
  require(!options.density || *options.density > 0, "density must be positive, got {} kg/m³",
          options.density.value_or(0));
  require(!options.gravity || *options.gravity > 0, "gravity must be positive, got {} m/s²",
          options.gravity.value_or(0));
  require(!options.ulen || (std::isfinite(*options.ulen) && *options.ulen > 0), "ULEN must be positive, got {} m",
          options.ulen.value_or(0));
  if (options.iperout)
    require(*options.iperout >= 1 && *options.iperout <= 4,
            "IPEROUT must be 1 (period), 2 (frequency), 3 (KL) or 4 (νL), got {}", *options.iperout);
}

void require_stated(const ReadOptions& options, const std::optional<WamitOut>& out, const WamitNeeds& needs,
                    const fs::path& file) {
  std::vector<std::string> missing;
  if (needs.density && !options.density && !(out && out->density)) missing.push_back("density");
  if (needs.gravity && !options.gravity && !out) missing.push_back("gravity");
  if (needs.depth && !options.depth && !out) missing.push_back("water depth");
  if (!missing.empty())
    throw InputError(
        fmt::format("WAMIT's numeric files do not hold the {}", fmt::join(missing, ", ")), {.file = file.string()},
        "state density, gravity and depth: in the [water] table of a scene, or as options of `froude bem`");
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

void take_bodies(Coefficients& c, const std::optional<WamitOut>& out, const fs::path& file) {
  if (!out) {
    c.notes.push_back("WAMIT's numeric files do not say where the reference points of the bodies (XBODY) are");
    return;
  }
  if (out->body.size() != c.body.size())
    throw InputError(
        fmt::format("the file describes {} bodies, but the .1 file has {}", out->body.size(), c.body.size()),
        {.file = file.string()}, "the files must come from one run");
  c.body = out->body;
  c.notes.insert(c.notes.end(), out->notes.begin(), out->notes.end());
  c.source += ", .out";
}

/// Results that have tables of their own (responses.hpp).
void note_other_files(Coefficients& c, const WamitFiles& files) {
  std::vector<std::string> others;
  for (const char* extension : {".4", ".7", ".8", ".9", ".10d", ".10s", ".11d", ".11s", ".12d", ".12s"})
    if (fs::exists(files.member(extension))) others.emplace_back(extension);
  if (!others.empty())
    c.notes.push_back(fmt::format("{}: motions and second-order loads are no coefficients; read them by themselves",
                                  fmt::join(others, ", ")));
}

}  // namespace

WamitRun run_of(const ReadOptions& options, const std::optional<WamitOut>& out, const WamitNeeds& needs,
                const fs::path& file, std::vector<std::string>& notes) {
  require_sound(options);
  require_stated(options, out, needs, file);
  const auto found = [&](auto value) { return out ? std::optional<double>(value(*out)) : std::nullopt; };
  const auto depth = options.depth ? std::optional(options.depth->metres()) : std::nullopt;
  const Water usual;
  const double h =
      stated("depth", depth, found([](const WamitOut& o) { return o.depth.metres(); }), usual.depth.metres(), notes);
  WamitRun run;
  run.water = {
      stated("density", options.density, out ? out->density : std::nullopt, usual.density, notes),
      stated("gravity", options.gravity, found([](const WamitOut& o) { return o.gravity; }), usual.gravity, notes),
      std::isinf(h) ? WaterDepth::infinite() : WaterDepth::from_metres(h)};
  run.column = static_cast<FirstColumn>(options.iperout.value_or(1));
  if (out) run.bodies = static_cast<int>(out->body.size());
  run.ulen = stated("ULEN", options.ulen, found([](const WamitOut& o) { return o.ulen; }), 1, notes);
  return run;
}

namespace {

Coefficients read_wamit(const fs::path& path, const ReadOptions& options) {
  const WamitFiles files = find_wamit_files(path);
  std::optional<WamitOut> out;
  if (fs::exists(files.member(".out"))) out = read_wamit_out(files.member(".out"));
  std::vector<std::string> notes;
  Coefficients c = read_numeric_files(files, run_of(options, out, {}, files.radiation, notes));
  c.source = "WAMIT numeric files " + c.source;
  c.notes.insert(c.notes.end(), notes.begin(), notes.end());
  examine_iperout(c, options, files.radiation);
  take_bodies(c, out, files.member(".out"));
  note_other_files(c, files);
  return c;
}

}  // namespace

const Format wamit_files{[](const Candidate& c) { return !c.is_folder && !c.hdf5; }, read_wamit};

}  // namespace hydro::potential
