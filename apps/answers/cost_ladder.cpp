#include "answers/cost_ladder.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "compile/integrator.hpp"
#include "compile/members.hpp"
#include "scene/document.hpp"

namespace froude {
namespace {

using scene::Node, scene::Scene, scene::TextEdit;

std::string quoted(const std::string& text) { return '"' + text + '"'; }
std::string written(double number) { return fmt::format("{:.12g}", number); }

/// Which rung has the setting of another.
std::size_t own_of(const Ladder& ladder, const Rung& own) {
  const auto at = std::find_if(ladder.rungs.begin(), ladder.rungs.end(),
                               [&](const Rung& rung) { return rung.setting == own.setting; });
  return static_cast<std::size_t>(at - ladder.rungs.begin());
}

/// Tables of a list such as [[body]].
const std::vector<Node>& tables(const Node& root, const std::string& key) {
  static const std::vector<Node> none;
  const Node::Entry* entry = root.find(key);
  return entry == nullptr ? none : entry->value.items;
}

/// The table or value at the end of these keys; null if it is not there.
const Node* inner(const Node& from, const std::vector<std::string>& keys) {
  const Node* at = &from;
  for (const std::string& key : keys) {
    const Node::Entry* entry = at->find(key);
    if (entry == nullptr) return nullptr;
    at = &entry->value;
  }
  return at;
}

// Step and integrator

/// [solve.integrator], whole where it is not written yet.
std::vector<TextEdit> integrator(const Node& document, const std::string& name, const std::string& tolerance) {
  if (inner(document, {"solve", "integrator"}) == nullptr)
    return {{"solve.integrator",
             fmt::format("{{ name = {}{} }}", quoted(name), tolerance.empty() ? "" : ", tolerance = " + tolerance)}};
  return {{"solve.integrator.name", quoted(name)},
          {"solve.integrator.rho_infinity", ""},
          {"solve.integrator.tolerance", tolerance}};
}

/// How runs of one scene are stepped.
class Stepping {
 public:
  Stepping(const Scene& scene, const Node& document, double step)
      : scene_(scene), document_(document), parts_(std::lround(scene.run->every / step)) {
    for (const scene::Line& line : scene.lines) free_lines_ = free_lines_ || !line.fastened();
  }

  Ladder ladder() const {
    const bool by_tolerance = compile::has_steps_by_tolerance(scene_.solve);
    Ladder out = by_tolerance ? by_tolerances() : by_steps();
    if (!by_tolerance && !scene_.bodies.empty()) add_integrators(out);
    if (free_lines_) add_methods_of_lines(out);
    return out;
  }

 private:
  Rung step(double shorter) const {
    const auto parts = static_cast<double>(std::max(1L, std::lround(static_cast<double>(parts_) * shorter)));
    const std::string h = written(scene_.run->every / parts) + " s";
    return {"step", h, {{"solve.step", quoted(h)}}};
  }
  Rung with(Rung rung, const std::string& approximation, const std::string& setting,
            const std::vector<TextEdit>& edits) const {
    rung.setting = setting + ", " + rung.setting;
    rung.approximation = approximation;
    rung.edits.insert(rung.edits.end(), edits.begin(), edits.end());
    return rung;
  }
  Ladder by_steps() const {
    Ladder out;
    std::set<std::string> known;
    for (const double shorter : {0.25, 0.5, 1.0, 2.0, 4.0})
      if (const Rung rung = step(shorter); known.insert(rung.setting).second) out.rungs.push_back(rung);
    out.own = own_of(out, step(1));
    out.references = {{step(8), step(4)}};
    return out;
  }
  /// Steps that are cut by their own error: its tolerance is what is set.
  Ladder by_tolerances() const {
    const double own = scene_.solve.tolerance.value_or(compile::tolerance_of_pair);
    const auto at = [&](double times) {
      Rung out = step(1);
      out.approximation = "tolerance of steps";
      out.setting = written(own * times);
      out.edits.push_back({"solve.integrator.tolerance", out.setting});
      return out;
    };
    return {{at(100), at(10), at(1), at(0.1)}, 2, {{at(1e-3), at(1e-2)}, {at(1e-2), at(0.1)}}};
  }
  void add_integrators(Ladder& out) const {
    const auto pair = [&](const std::string& tolerance) {
      return with(step(1), "integrator", "explicit_pair " + tolerance,
                  integrator(document_, "explicit_pair", tolerance));
    };
    for (const char* name : {"generalized_alpha", "energy_momentum", "implicit_euler", "semi_implicit_euler"})
      if (scene_.solve.integrator != name)
        out.rungs.push_back(with(step(1), "integrator", name, integrator(document_, name, "")));
    for (const char* tolerance : {"1e-3", "1e-5"}) out.rungs.push_back(pair(tolerance));
    // Another method than the scene's own is the better witness, where it can step the scene.
    out.references.insert(out.references.begin(), {pair("1e-10"), pair("1e-8")});
  }
  /// Of lines that are stepped by themselves.
  void add_methods_of_lines(Ladder& out) const {
    for (const char* name : {"energy_momentum", "generalized_alpha"}) {
      if (scene_.solve.line_scheme == name) continue;
      const std::vector<TextEdit> edits =
          inner(document_, {"solve", "integrator"}) == nullptr
              ? std::vector<TextEdit>{{"solve.integrator", fmt::format("{{ lines = {} }}", quoted(name))}}
              : std::vector<TextEdit>{{"solve.integrator.lines", quoted(name)}};
      out.rungs.push_back(with(step(1), "lines stepped by", name, edits));
      out.references.insert(out.references.begin(), {step(8), with(step(8), "lines stepped by", name, edits)});
    }
  }

  const Scene& scene_;
  const Node& document_;
  long parts_;  ///< into which the scene cuts the distance of samples
  bool free_lines_ = false;
};

// Memory of radiated waves

/// The same keys in each table [body.hydrodynamics.radiation]; "" takes a key out.
Rung memory(const std::vector<std::string>& tables, const std::string& setting,
            const std::vector<std::pair<std::string, std::string>>& keys) {
  Rung out{"memory", setting, {}};
  for (const std::string& table : tables)
    for (const auto& [key, value] : keys) out.edits.push_back({table + "." + key, value});
  return out;
}

Ladder memory_by_length(const std::vector<std::string>& tables, double length) {
  const auto at = [&](double times) {
    const std::string text = written(length * times) + " s";
    return memory(tables, text, {{"memory", quoted(text)}});
  };
  return {{at(0.25), at(0.5), at(1), at(2)}, 2, {{at(8), at(4)}, {at(4), at(2)}}, true};
}

Ladder memory_by_tolerance(const std::vector<std::string>& tables, const scene::Memory& own) {
  using enum scene::Memory::Method;
  const std::vector<std::pair<scene::Memory::Method, std::string>> methods{
      {automatic, "automatic"}, {poles, "poles"}, {partitioned, "partitioned"}, {direct, "direct"}};
  const auto at = [&](const std::string& method, double times) {
    const std::string tolerance = fmt::format("{:.3g}", own.tolerance * times);
    return memory(tables, method + ", " + tolerance, {{"method", quoted(method)}, {"memory_tolerance", tolerance}});
  };
  std::string name;
  for (const auto& [method, text] : methods)
    if (method == own.method) name = text;
  Ladder out{.makes_coefficients = true};
  if (own.tolerance < 0.1) out.rungs.push_back(at(name, 10));
  out.own = out.rungs.size();
  for (const double times : {1.0, 0.1}) out.rungs.push_back(at(name, times));
  for (const auto& [method, text] : methods)
    if (method != own.method) out.rungs.push_back(at(text, 1));
  out.references = {{at("automatic", 0.1), at("automatic", 1)}, {at("automatic", 1), at("automatic", 10)}};
  return out;
}

/// One memory for all bodies that radiate; none where the scene gives them different ones.
void add_memory(const Scene& scene, const Node& document, Ladders& out) {
  std::vector<std::string> tables_of_radiation;
  const auto& bodies = tables(document, "body");
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (inner(bodies[i], {"hydrodynamics", "radiation"}) != nullptr)
      tables_of_radiation.push_back(fmt::format("body[{}].hydrodynamics.radiation", i + 1));
  std::vector<scene::Memory> asked;
  for (const scene::Body& body : scene.bodies)
    if (body.hydrodynamics && body.hydrodynamics->radiation) asked.push_back(body.hydrodynamics->memory);
  if (asked.empty() || asked.front().method == scene::Memory::Method::constant) return;
  const scene::Memory& own = asked.front();
  if (!std::all_of(asked.begin(), asked.end(), [&](const scene::Memory& m) {
        return m.method == own.method && m.tolerance == own.tolerance && m.length == own.length;
      }))
    return out.notes.push_back("memories stay as they are: bodies have different ones");
  out.all.push_back(own.length ? memory_by_length(tables_of_radiation, *own.length)
                               : memory_by_tolerance(tables_of_radiation, own));
}

// Pieces of members and lines

/// Whole numbers of pieces, all times the same.
struct Pieces {
  std::string path;
  long own;
};
Rung cut(const std::string& approximation, const std::vector<Pieces>& all, double times) {
  Rung out{approximation, {}, {}};
  long least = 0, most = 0;
  for (const Pieces& p : all) {
    const long pieces = std::max(1L, std::lround(static_cast<double>(p.own) * times));
    least = least == 0 ? pieces : std::min(least, pieces);
    most = std::max(most, pieces);
    out.edits.push_back({p.path, std::to_string(pieces)});
  }
  out.setting = least == most ? std::to_string(most) : fmt::format("{} to {}", least, most);
  return out;
}
/// Without those that come to the same.
Ladder cuts(const std::string& approximation, const std::vector<Pieces>& all) {
  Ladder out;
  std::set<std::string> known;
  for (const double times : {0.25, 0.5, 1.0, 2.0})
    if (const Rung rung = cut(approximation, all, times); known.insert(rung.setting).second) out.rungs.push_back(rung);
  out.own = own_of(out, cut(approximation, all, 1));
  out.references = {{cut(approximation, all, 8), cut(approximation, all, 4)},
                    {cut(approximation, all, 4), cut(approximation, all, 2)}};
  return out;
}

void add_members(const Scene& scene, const Node& document, Ladders& out) {
  std::vector<Pieces> all;
  const auto& members = tables(document, "member");
  for (std::size_t i = 0; i < members.size(); ++i)
    for (const char* load : {"morison", "slamming"}) {
      const Node* table = inner(members[i], {load});
      if (table == nullptr) continue;
      const auto one = std::find_if(scene.members.begin(), scene.members.end(),
                                    [&](const scene::Member& m) { return m.place.line == members[i].place.line; });
      if (one == scene.members.end()) continue;
      const Node* pieces = inner(*table, {"pieces"});
      const dynamics::SlenderMember& line =
          load == std::string_view("morison") ? one->morison->line : one->slamming->line;
      all.push_back({fmt::format("member[{}].{}.pieces", i + 1, load),
                     pieces != nullptr ? static_cast<long>(pieces->integer)
                                       : compile::needed_pieces(scene, *one, line.immersion)});
    }
  if (!all.empty()) out.all.push_back(cuts("pieces of members", all));
}

/// "link10.tension", "node3.*": what another number of segments would rename.
bool counts_nodes(const std::string& signal) {
  for (const char* word : {"link", "node"})
    for (std::size_t at = signal.find(word); at != std::string::npos; at = signal.find(word, at + 1))
      if (at + 4 < signal.size() && std::isdigit(static_cast<unsigned char>(signal[at + 4])) != 0) return true;
  return false;
}

void add_lines(const Scene& scene, const Node& document, Ladders& out) {
  if (scene.lines.empty()) return;
  const auto& of = scene.run->of;
  bool numbered = of.empty() || std::any_of(of.begin(), of.end(), counts_nodes);
  for (const scene::Line& line : scene.lines)
    for (const bool first : {true, false})
      numbered = numbered || line.release || !line.loads.empty() ||
                 (line.end(first).meets && !line.end(first).meets->junction);
  if (numbered)
    return out.notes.push_back(
        "segments of lines stay as they are: the scene names nodes or links by number, which would be others");
  std::vector<Pieces> all;
  const auto& lines = tables(document, "line");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string path = fmt::format("line[{}]", i + 1);
    if (const Node* segments = inner(lines[i], {"segments"}))
      all.push_back({path + ".segments", static_cast<long>(segments->integer)});
    const auto& parts = tables(lines[i], "part");
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (const Node* segments = inner(parts[k], {"segments"}))
        all.push_back({fmt::format("{}.part[{}].segments", path, k + 1), static_cast<long>(segments->integer)});
  }
  if (!all.empty()) out.all.push_back(cuts("segments of lines", all));
}

// Frequencies

/// "2 s .. 8 s, 61 values" with more values, those of before among them, or fewer.
std::string with_values(const std::string& range, double times, long& count) {
  const std::size_t comma = range.rfind(',');
  count = std::lround(times * static_cast<double>(std::stol(range.substr(comma + 1)) - 1)) + 1;
  return fmt::format("{}, {} values", range.substr(0, comma), count);
}
/// From a quarter to `most` times as many.
Ladder frequencies(const std::string& approximation, const std::vector<std::pair<std::string, std::string>>& ranges,
                   double most) {
  const auto at = [&](double times) {
    Rung out{approximation, {}, {}};
    long count = 0;
    for (const auto& [path, range] : ranges) out.edits.push_back({path, quoted(with_values(range, times, count))});
    out.setting = fmt::format("{} frequencies", count);
    return out;
  };
  Ladder out{.references = {{at(4 * most), at(2 * most)}}};
  for (double times = 0.25; times <= most; times *= 2) out.rungs.push_back(at(times));
  out.own = 2;
  return out;
}

/// Of the table that is computed of cylinders or of meshes.
void add_computed(const Node& document, Ladders& out) {
  const auto& bodies = tables(document, "body");
  const auto add = [&](const std::string& what, const std::vector<std::string>& keys) {
    std::vector<std::pair<std::string, std::string>> ranges;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (const Node* range = inner(bodies[i], keys))
        ranges.emplace_back(fmt::format("body[{}].{}", i + 1, fmt::join(keys, ".")), range->text);
    if (ranges.empty()) return;
    out.all.push_back(frequencies("frequencies of " + what, ranges, 2));
    out.all.back().makes_coefficients = true;
  };
  add("cylinders", {"hydrodynamics", "cylinders", "frequencies"});
  add("meshes", {"hydrodynamics", "frequencies"});
}

}  // namespace

Ladders ladders_of_run(const Scene& scene, double step) {
  const Node document = scene::parse_document(scene.text, scene.file.string());
  Ladders out;
  if (!scene.run->steady) {
    out.all.push_back(Stepping(scene, document, step).ladder());
    add_memory(scene, document, out);
    add_members(scene, document, out);
    add_lines(scene, document, out);
  }
  add_computed(document, out);
  return out;
}

Ladders ladders_of_rao(const Scene& scene) {
  const Node document = scene::parse_document(scene.text, scene.file.string());
  Ladders out;
  for (const char* key : {"periods", "omega"})
    if (const Node* range = inner(document, {"ask", "rao", key}); range != nullptr && scene.rao->omega.size() > 1)
      out.all.push_back(frequencies("frequencies", {{fmt::format("ask.rao.{}", key), range->text}}, 16));
  // A scene with both answers has one set of coefficients: that of the run.
  if (!scene.run) add_computed(document, out);
  return out;
}

std::optional<ComponentsLadder> components_of_run(const Scene& scene) {
  if (!scene.waves) return {};
  const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind);
  if (sea == nullptr) return {};
  const auto at = [&](double times) {
    Rung out{"components", {}, {}};
    if (const auto* grid = std::get_if<hydro::waves::FftGrid>(&sea->bins)) {
      out.setting = fmt::format("repeating after {:.6g} s", grid->repetition_s * times);
      out.edits = {{"waves.components.repetition", quoted(written(grid->repetition_s * times) + " s")}};
      return out;
    }
    const auto* equal = std::get_if<hydro::waves::EqualEnergy>(&sea->bins);
    const auto count = std::max<long>(
        1, std::lround(times * static_cast<double>(equal ? equal->count
                                                         : std::get<hydro::waves::RandomInBin>(sea->bins).count)));
    out.setting = fmt::format("{} {}", count, equal ? "of equal energy" : "at random");
    out.edits = {{equal ? "waves.components.equal_energy" : "waves.components.random", std::to_string(count)}};
    return out;
  };
  return ComponentsLadder{{at(0.5), at(1), at(2)}, at(4)};
}

TextEdit with_seed(const Scene& scene, int number) {
  const auto& sea = std::get<scene::RandomSea>(scene.waves->kind);
  return {"waves.seed", std::to_string(sea.seed + static_cast<std::uint64_t>(number))};
}

}  // namespace froude
