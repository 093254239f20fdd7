#pragma once
/// \file  A kind of fit as a scene knows it: its keys, the problem of libfit that its measurements make, and what is
///        shown of a solution. Each kind is one file, fit_NAME.cpp, named in CMakeLists.txt, which defines
///
///          std::unique_ptr<const FitKind> NAME_fit();
///
///        Private to apps.
#include <fmt/format.h>

#include <any>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/camera.hpp"
#include "answers/fit_scene.hpp"
#include "answers/plot.hpp"
#include "fit/prepare.hpp"
#include "fit/report.hpp"
#include "scene/binding.hpp"
#include "scene/placed.hpp"

namespace froude::scene {

/// The tables of a fit scene as they were read.
struct FitTables {
  const Record& root;

  const Record& data() const { return root.table("data"); }
  const Record& channels() const { return data().table("channels"); }
  const Record& model() const { return root.table("model"); }
  const Record& ask() const { return root.table("ask"); }
};

/// What was measured, what was fitted to it and what is left. No panel: there is nothing to see.
using Panels = std::vector<plot::Panel>;

/// Where in a scene a refusal has its cause, and what to write there.
struct Remedy {
  hydro::Place place = {};
  std::string text = {};
};

/// All that comes of a fit.
struct FitAnswer {
  ::fit::Report report;
  Panels panels;
  std::string table;  ///< CSV with one row for each run; empty where values are refused
  Remedy remedy;      ///< where values are refused
};

/// What a kind adds to the tables of a scene. The same key of several kinds stands once in the grammar, with what it
/// means to each; in scenes of other kinds it is refused.
struct FitKeys {
  Table::Variant model;       ///< keys of [model], beside the word of the kind
  std::vector<Key> channels;  ///< roles of columns; of the force several, where it is `texts`
  std::vector<Key> data = {}, intervals = {}, ask = {};  ///< keys of [data], [ask.intervals] and [ask]
};

class FitKind {
 public:
  virtual ~FitKind() = default;
  virtual const FitKeys& keys() const = 0;
  /// As [model] writes it: "friction ramp".
  const std::string& word() const { return keys().model.word; }

  /// What the tables say of this kind. Files, channels and confidence are in `scene` already.
  /// \throws hydro::InputError, placed in the scene
  virtual std::any read(const FitTables& tables, const FitScene& scene) const = 0;
  /// Opens the data files and fits. \throws hydro::InputError, hydro::NumericsError
  virtual FitAnswer answer(const FitScene& scene) const = 0;
  /// Opens the data files and compares them with what the model tells, unfitted: at the values of an earlier fit's
  /// file, or where a fit would begin. \throws hydro::InputError, also for kinds whose model tells nothing by itself
  virtual FitAnswer predict(const FitScene& scene, const std::optional<std::filesystem::path>& fitted) const;
  virtual bool has_table() const { return false; }
  /// What becomes of the error of the slope of a column's [[data.line]], which is the same in all runs.
  virtual std::string said_of_line(const FitScene&, const std::string& /*column*/) const {
    return " and in the intervals";
  }
  /// Facts to be told beside the kind, by name.
  virtual std::vector<std::pair<std::string, std::string>> settings(const FitScene&) const { return {}; }
};

/// All kinds, in the order of the reference.
const std::vector<std::unique_ptr<const FitKind>>& fit_kinds();

/// [prepare]. \throws hydro::InputError where a kind has no such steps
const Binding<::fit::PrepareOptions>& prepare_binding();
[[nodiscard]] hydro::InputError prepares_nothing(const FitTables& tables);
/// Of kinds that know some of these `steps` alone; `remedy` for others, and why a window of full cycles is none of
/// them: "which has no cycles of full amplitude". \throws hydro::InputError
void only_prepares(const FitTables& tables, const std::vector<std::string>& steps, const char* remedy,
                   const char* no_cycles);

/// What the lines of a scene are, for its report: "gauge by gauge.csv: 25 ± 0.01 V/m, hysteresis …".
std::vector<std::string> told_lines(const FitScene& scene);

/// [camera], where a kind takes no tracks.
[[nodiscard]] hydro::InputError films_nothing(const FitTables& tables);

/// A kind by what [model] says, Model, and by the Problem of libfit, whose namespace has solve(). A Model with a member
/// `prepare` takes [prepare], one with a member `camera` takes [camera].
template <class Model, class Problem>
class FitKindOf : public FitKind {
 public:
  using Solution = decltype(solve(std::declval<const Problem&>()));

  const FitKeys& keys() const final { return keys_; }

  std::any read(const FitTables& tables, const FitScene& scene) const final {
    Model model = declared_.model.read(tables.model());
    if (tables.root.has("prepare")) {
      if constexpr (requires { model.prepare; })
        take_steps(tables, model.prepare);
      else
        throw prepares_nothing(tables);
    }
    if (tables.root.has("camera")) {
      if constexpr (requires { model.camera; })
        model.camera = camera_binding().read(tables.root.table("camera"));
      else
        throw films_nothing(tables);
    }
    declared_.data.read_into(tables.data(), model);
    declared_.intervals.read_into(tables.ask().table("intervals"), model);
    declared_.ask.read_into(tables.ask(), model);
    finish(tables, scene, model);
    return model;
  }

  FitAnswer answer(const FitScene& scene) const final {
    const Problem given = problem(scene, scene.model<Model>());
    const Solution found = placed(asked_at(scene), [&] { return solve(given); });
    FitAnswer out{.report = found.report, .panels = panels(given, found), .table = {}, .remedy = {}};
    for (std::string& line : told_lines(scene)) out.report.remarks.push_back(std::move(line));
    if (out.report.refused) {
      out.remedy = remedy(scene, given, found);
    } else {
      out.table = table(given, found);
      draw_upon(scene.overlays, out.panels);
    }
    return out;
  }

 protected:
  /// Keys bound to the members of Model.
  struct Declared {
    std::string word;
    Binding<Model> model;
    std::vector<Key> channels;
    Binding<Model> data{"", ""}, intervals{"", ""}, ask{"", ""};
  };
  explicit FitKindOf(Declared declared)
      : declared_(std::move(declared)),
        keys_{.model = {declared_.word, declared_.model.table().meaning, declared_.model.table().keys,
                        declared_.model.table().groups},
              .channels = declared_.channels,
              .data = declared_.data.table().keys,
              .intervals = declared_.intervals.table().keys,
              .ask = declared_.ask.table().keys} {}

  /// What the keys one by one cannot know, and what follows from several tables. \throws hydro::InputError, placed
  virtual void finish(const FitTables& tables, const FitScene& scene, Model& model) const = 0;
  /// A band about the waves then needs no frequency: that of each run's surface is taken.
  virtual bool finds_the_waves() const { return false; }
  /// What was measured, with what the scene knows and how it asks to fit it. \throws hydro::InputError naming the file
  virtual Problem problem(const FitScene& scene, const Model& model) const = 0;
  virtual Panels panels(const Problem& problem, const Solution& solution) const = 0;
  virtual Remedy remedy(const FitScene&, const Problem&, const Solution&) const { return {}; }
  /// Where the scene asks for what its runs cannot tell together: errors of one run name its file.
  virtual Place asked_at(const FitScene& scene) const { return scene.model_place; }
  /// Of kinds that have one; asked where no value is refused.
  virtual std::string table(const Problem&, const Solution&) const { return {}; }

 private:
  void take_steps(const FitTables& tables, ::fit::PrepareOptions& out) const {
    const Record& prepare = tables.root.table("prepare");
    prepare_binding().read_into(prepare, out);
    if (out.band_about_waves && !finds_the_waves())
      throw prepare.table("band_pass")
          .refused("needs the frequency of the waves, which no surface tells in this fit",
                   "add frequency = \"0.625 Hz\", or the one of your waves");
  }

  Declared declared_;
  FitKeys keys_;
};

/// "does not apply to a fit of kind "towing"".
std::string not_of_kind(std::string_view kind);

/// Takes an angular frequency into a member that is in Hz.
template <class T>
auto in_hertz(double T::*member) {
  return [member](const Value& value, T& out) { out.*member = value.number / (2 * std::numbers::pi); };
}
/// A list of checks whose failure shall not keep values back. All that there is so far is "residuals".
Key accept_key(const std::string& meaning);

/// The coefficients that are asked for. \throws hydro::InputError where none are, with an `example`, or one is not
/// among those `known`
const std::vector<Located<std::string>>& wanted(const FitTables& tables, const std::vector<std::string>& known,
                                                const char* example, const char* remedy);

}  // namespace froude::scene
