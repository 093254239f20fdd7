#include "sweep/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "answers/fit_scene.hpp"
#include "answers/picture.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/placed.hpp"
#include "sweep/numbers.hpp"

namespace froude::sweep {
namespace {

namespace dim = hydro::dim;
using namespace scene;
using hydro::InputError;

template <class T>
auto put_texts(std::vector<Located<std::string>> T::*member) {
  return [member](const Value& value, T& out) { out.*member = value.texts; };
}
/// One value as TOML writes it.
template <class T>
auto put_scalar(std::optional<std::string> T::*member) {
  return [member](const Value& value, T& out) {
    if (value.texts.size() != 1) throw value.wrong("is a list; one value is needed");
    out.*member = value.texts.front().value;
  };
}

/// "2 GB"
void put_memory(const Value& value, Study& out) {
  const std::size_t space = value.text.find(' ');
  const std::string unit = space == std::string::npos ? "" : value.text.substr(space + 1);
  const char* remedy = "write \"500 MB\" or \"2 GB\"";
  if (unit != "MB" && unit != "GB") throw value.wrong("is no amount of memory", remedy);
  double number = 0;
  try {
    number = hydro::parse_number(value.text.substr(0, space));
  } catch (const InputError&) {
    throw value.wrong("is no amount of memory", remedy);
  }
  if (number <= 0) throw value.wrong("is not positive", remedy);
  out.memory_limit_bytes = number * (unit == "MB" ? 1e6 : 1e9);
}

Binding<Axis> axis_binding() {
  return Binding<Axis>("[[axis]]", "keys of the scene that take one value after the other")
      .optional(text("name", "of its column in the table; left out: the key"), &Axis::name)
      .key(texts("key",
                 "of the scene, as results echo it: \"waves.height\", \"body.buoy.mass\", \"line[2].at.x\"; of "
                 "several keys each takes the same value"),
           put_texts(&Axis::keys))
      .optional(scalars("values", "as the scene would write them: [\"1 m\", \"2 m\"], [1, 2]"), &Axis::values)
      .optional(text("range",
                     "\"4 s .. 12 s, 9 values\", \"4 s .. 12 s, every 1 s\", or where [sample] draws the values "
                     "\"4 s .. 12 s\""),
                &Axis::range)
      .exactly_one_of({"values", "range"})
      .words(text("spacing", "of a range: \"linear\", or equal ratios, \"logarithmic\"")
                 .or_default("linear", "as ranges of scenes are")
                 .only_beside("range"),
             Words<bool>{{"linear", false}, {"logarithmic", true}}, &Axis::logarithmic)
      .optional(text("along",
                     "an axis that it changes together with, value by value; left out: each of its values "
                     "meets each of every other axis"),
                &Axis::along)
      .place(&Axis::place);
}

Binding<Sample> sample_binding() {
  using enum Sample::Method;
  return Binding<Sample>("[sample]", "points that fill the space of all axes whose range names its ends alone")
      .words(text("method",
                  "\"latin hypercube\", or \"sobol\": the first points of Sobol's sequence, shifted by the "
                  "seed"),
             Words<Sample::Method>{{"latin hypercube", latin_hypercube}, {"sobol", sobol}}, &Sample::method)
      .key(integer("number", "of points").positive(), &Sample::number)
      .key(integer("seed", "another one gives other points").within(Limit::not_negative).or_default("1", "some seed"),
           &Sample::seed)
      .place(&Sample::place);
}

Binding<Skip> skip_binding() {
  return Binding<Skip>("[[skip]]", "cases that are not run")
      .key(text("of",
                "an axis, by its name, or \"steepness\": height over length of regular waves, significant height "
                "over length at the peak period of a sea"),
           &Skip::of)
      .optional(scalars("above", "cases above it are skipped"), put_scalar(&Skip::above))
      .optional(scalars("below", "cases below it are skipped"), put_scalar(&Skip::below))
      .at_least_one_of({"above", "below"})
      .place(&Skip::place);
}

Binding<Output> run_binding() {
  return Binding<Output>("", "statistics of signals of the run")
      .key(texts("of", "signals, of those that the scene gives; * stands for any characters"), put_texts(&Output::of))
      .key(texts("statistic",
                 "`significant`: mean height of the highest third of waves of the signal; `extreme`: the "
                 "largest size; columns are called signal.statistic")
               .one_of(statistics_of(Output::Kind::run)),
           &Output::statistics)
      .key(quantity("from", dim::time, "samples before it are left out").or_default("0 s", "the whole run"),
           &Output::from)
      .sets(&Output::kind, Output::Kind::run);
}
Binding<Output> rao_binding() {
  return Binding<Output>("", "of amplitudes over frequencies and headings, per metre of wave amplitude")
      .key(texts("of", "signals, of those that the scene gives; * stands for any characters"), put_texts(&Output::of))
      .key(texts("statistic",
                 "the largest amplitude and its period, of the frequencies that are asked; or the amplitude at the one "
                 "`period` that the scene asks for, in waves of one heading")
               .one_of(statistics_of(Output::Kind::rao)),
           &Output::statistics)
      .sets(&Output::kind, Output::Kind::rao);
}
Binding<Output> modes_binding() {
  return Binding<Output>("", "of the modes of free motion, the first having the longest period")
      .key(integer("count", "of modes").positive().or_default("1", "the slowest"), &Output::count)
      .key(texts("statistic", "columns are called mode1.period").one_of(statistics_of(Output::Kind::modes)),
           &Output::statistics)
      .sets(&Output::kind, Output::Kind::modes);
}
Binding<Output> fit_binding() {
  return Binding<Output>("", "numbers of a fit, of a scene with a [model]; a fit that may not tell them fails")
      .key(texts("of", "coefficients"), put_texts(&Output::of))
      .key(texts("statistic", "the value, and the ends of its interval").one_of(statistics_of(Output::Kind::fit)),
           &Output::statistics)
      .sets(&Output::kind, Output::Kind::fit);
}

Binding<Output> output_binding() {
  using enum Output::Kind;
  return Binding<Output>("[[output]]", "numbers that each case tells, one column each")
      .key(text("kind", "the answer that it takes them from"))
      .variant(name_of(run), run_binding())
      .variant(name_of(rao), rao_binding())
      .variant(name_of(modes), modes_binding())
      .variant(name_of(fit), fit_binding())
      .place(&Output::place);
}

Binding<Picture> picture_binding() {
  return Binding<Picture>("[[picture]]",
                          "curves over one axis or over the time of runs, or a map over two axes; the numbers stand in "
                          "a .csv beside "
                          "it, series in those of `series`. Where several cases share a point it tells their mean")
      .key(text("file", "its name in the folder of the sweep, .svg, .png or .pdf"), &Picture::file)
      .key(texts("of",
                 "columns of outputs, \"buoy.heave.maximum\", or over time signals, \"buoy.heave\"; of several each "
                 "has a panel"),
           put_texts(&Picture::of))
      .key(text("x", "axis; or \"time\", where series are kept: a curve for each case"), &Picture::x)
      .optional(text("y", "axis: a map with contours"), &Picture::y)
      .optional(text("by", "axis: a curve for each of its values"), &Picture::by)
      .optional(text("panel", "axis: panels of their own for each of its values"), &Picture::panel)
      .tables("upon", overlay_binding("[[picture.upon]]", "a table drawn upon the picture, as of another source"),
              &Picture::overlays)
      .optional()
      .at_most_one_of({"y", "by"});
}

const Binding<Study>& study_binding() {
  static const auto binding =
      Binding<Study>("a study", "a scene answered again and again, with other values in some of its keys")
          .key(integer("schema", "version of this grammar, 1"))
          .optional(text("title", "for people"), &Study::title)
          .key(text("scene", "file, of motion or of a fit, beside this one"), &Study::scene)
          .optional(effect("series", "the time series of each run is kept, in the folder `series`"), &Study::series)
          .optional(positive("time_limit", dim::time,
                             "of the work on a case; one that takes longer is ended wherever it is, and fails"),
                    &Study::time_limit_s)
          .optional(text("memory_limit",
                         "that a case may take beyond what all share, \"500 MB\" or \"2 GB\" (10^9 bytes); one that "
                         "needs more fails"),
                    put_memory)
          .tables("axis", axis_binding(), &Study::axes)
          .table("sample", sample_binding(), &Study::sample)
          .tables("skip", skip_binding(), &Study::skips)
          .optional()
          .tables("output", output_binding(), &Study::outputs)
          .tables("picture", picture_binding(), &Study::pictures)
          .optional();
  return binding;
}

// What the keys one by one cannot know

const Axis* axis_named(const Study& study, const std::string& name) {
  const auto at = std::find_if(study.axes.begin(), study.axes.end(), [&](const Axis& a) { return a.name == name; });
  return at == study.axes.end() ? nullptr : &*at;
}

std::vector<std::string> names_of_axes(const Study& study) {
  std::vector<std::string> out;
  for (const Axis& axis : study.axes) out.push_back(axis.name);
  return out;
}

void require_axis(const Study& study, const Located<std::string>& name) {
  if (axis_named(study, name.value) != nullptr) return;
  const auto known = names_of_axes(study);
  const std::string near = hydro::nearest(name.value, known);
  throw InputError(fmt::format("there is no axis \"{}\"", name.value), name.place,
                   near.empty() ? fmt::format("the axes are {}", fmt::join(known, ", "))
                                : fmt::format("did you mean \"{}\"?", near));
}

void check_axes(Study& study) {
  std::set<std::string> taken = {"case", "state", "reason", "warnings"};
  for (Axis& axis : study.axes) {
    if (axis.name.empty()) axis.name = axis.keys.front().value;
    if (!taken.insert(axis.name).second)
      throw InputError(fmt::format("there is a column \"{}\" already", axis.name), axis.place,
                       "give the axis another name");
  }
  for (const Axis& axis : study.axes) {
    if (!axis.along) continue;
    require_axis(study, *axis.along);
    if (axis_named(study, axis.along->value)->along || axis.along->value == axis.name)
      throw InputError(
          fmt::format("[[axis]] along = \"{}\" names an axis that itself goes along one, or itself", axis.along->value),
          axis.along->place, "name the axis that leads");
  }
}

void check_over_time(const Study& study, const Picture& picture) {
  if (!study.series)
    throw InputError("[[picture]] x = \"time\" draws series of runs, which this study does not keep", picture.x.place,
                     "add series = true to the study");
  if (picture.y) throw InputError("[[picture]] y has no meaning over time", picture.y->place, "leave it out");
}

void check_pictures(const Study& study) {
  for (const Picture& picture : study.pictures) {
    const std::filesystem::path name = picture.file.value;
    const bool is_picture = name.extension() == ".svg" || name.extension() == ".png" || name.extension() == ".pdf";
    if (name.filename() != name || !is_picture || name.stem() == "table")
      throw InputError(fmt::format("[[picture]] file = \"{}\" is no name of a picture in the folder of the sweep",
                                   picture.file.value),
                       picture.file.place, "write a name alone that ends in .svg, .png or .pdf, other than table.svg");
    scene::placed(picture.file.place, [&] { plot::require_picture(name); });
    for (const auto* axis : {&picture.y, &picture.by, &picture.panel})
      if (*axis) require_axis(study, **axis);
    if (is_over_time(study, picture))
      check_over_time(study, picture);
    else
      require_axis(study, picture.x);
    if (!picture.overlays.empty() && (picture.of.size() > 1 || picture.panel))
      throw InputError("[[picture]] upon draws a table upon one panel, and this picture has several",
                       picture.overlays.front().file.place, "draw a picture of each panel by itself");
    for (const Overlay& over : picture.overlays) check_overlay(over);
  }
}

void check_outputs(const Study& study) {
  const auto kind = [](Output::Kind wanted) { return [wanted](const Output& o) { return o.kind == wanted; }; };
  if (study.series && std::none_of(study.outputs.begin(), study.outputs.end(), kind(Output::Kind::run)))
    throw InputError("series = true keeps the series of runs, but no [[output]] of kind \"run\" asks for one",
                     {.file = study.file.string()}, "leave it out, or add such an output");
}

}  // namespace

bool is_over_time(const Study& study, const Picture& picture) {
  return picture.x.value == "time" && axis_named(study, "time") == nullptr;
}

const std::string& name_of(Output::Kind kind) {
  using enum Output::Kind;
  static const Words<Output::Kind> words{{"run", run}, {"rao", rao}, {"modes", modes}, {"fit", fit}};
  return word_for(words, kind);
}

const Table& study_schema() { return study_binding().table(); }

std::string key_reference() {
  return scene::key_reference() + "\n## Studies\n\n`froude sweep` answers them: `sweep.md`.\n" +
         reference_of(study_schema());
}

Study parse_study(std::string_view text, const std::filesystem::path& file) {
  const Node root = parse_document(text, file.string());
  check_version(root);
  std::vector<Echo> echo;
  Study out = study_binding().read(read_record(root, study_schema(), echo));
  out.file = file;
  out.text = text;
  check_axes(out);
  for (const Skip& skip : out.skips)
    if (skip.of.value != "steepness") require_axis(out, skip.of);
  check_pictures(out);
  check_outputs(out);
  return out;
}

Study read_study(const std::filesystem::path& file) { return parse_study(hydro::io::read_text(file), file); }

}  // namespace froude::sweep
