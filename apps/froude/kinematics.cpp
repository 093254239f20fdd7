// `froude kinematics`: what a track tells of motion, smoothed.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <span>

#include "answers/camera_track.hpp"
#include "answers/picture.hpp"
#include "fit/camera/instants.hpp"
#include "fit/camera/smooth.hpp"
#include "fit/offset.hpp"
#include "froude/commands.hpp"
#include "froude/kinematics_bodies.hpp"
#include "froude/kinematics_sightings.hpp"
#include "froude/kinematics_space.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
namespace dim = hydro::dim;
using hydro::InputError;

/// "pivot joint 0.5 m 0.5 mm"
fc::KnownLength known_length(const std::string& text) {
  const auto wrong = [&] {
    return InputError(fmt::format("\"{}\" is no distance between two markers", text), {.file = "--length"},
                      "write both, their distance and its deviation: \"pivot joint 0.5 m 0.5 mm\"");
  };
  std::vector<std::string> words;
  for (std::size_t from = 0; (from = text.find_first_not_of(' ', from)) != std::string::npos;) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    words.push_back(text.substr(from, to - from));
    from = to;
  }
  if (words.size() != 6) throw wrong();
  return scene::placed({.file = "--length"}, [&] {
    fc::KnownLength out{words[0], words[1], hydro::parse_si(words[2] + " " + words[3], dim::length),
                        hydro::parse_si(words[4] + " " + words[5], dim::length)};
    check(out);
    return out;
  });
}

std::vector<SmoothedColumn> marker_columns(const fc::SmoothTrack& track, std::size_t m, char along) {
  std::vector<SmoothedColumn> out;
  for (const char axis : {along, 'z'})
    for (const auto& [what, unit] :
         {std::pair{"", "m"}, std::pair{"_velocity", "m/s"}, std::pair{"_acceleration", "m/s^2"}})
      out.push_back({fmt::format("{}_{}{}", track.markers[m], axis, what), unit, {}, {}});
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    const fc::MarkerMotion now = track.marker(m, i);
    for (Eigen::Index c = 0; c < 2; ++c) {
      const double value[] = {now.place[c], now.velocity[c], now.acceleration[c]},
                   deviation[] = {now.place_sd[c], now.velocity_sd[c], now.acceleration_sd[c]};
      for (std::size_t d = 0; d < 3; ++d) {
        SmoothedColumn& column = out[static_cast<std::size_t>(3 * c) + d];
        column.value.push_back(value[d]);
        column.deviation.push_back(deviation[d]);
      }
    }
  }
  return out;
}

/// As the signal of the run counts it, without jumps.
std::vector<SmoothedColumn> angle_columns(const fc::SmoothTrack& track, const fc::Channel& channel,
                                          const std::string& of) {
  const auto number = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(track.markers.begin(), track.markers.end(), name) -
                                    track.markers.begin());
  };
  const double sign = channel.downwards ? -1 : 1, turn = 2 * std::numbers::pi;
  std::vector<SmoothedColumn> out{
      {of, "rad", {}, {}}, {of + "_velocity", "rad/s", {}, {}}, {of + "_acceleration", "rad/s^2", {}, {}}};
  double last = 0;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    const fc::AngleMotion now = track.angle(number(channel.marker), number(channel.to), i);
    last += std::remainder(sign * now.angle - channel.zero - last, turn);
    const double value[] = {last, sign * now.rate, sign * now.acceleration},
                 deviation[] = {now.angle_sd, now.rate_sd, now.acceleration_sd};
    for (std::size_t d = 0; d < 3; ++d) {
      out[d].value.push_back(value[d]);
      out[d].deviation.push_back(deviation[d]);
    }
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// What all columns of a unit are.
std::string quantity_in(const std::string& unit) {
  static const std::map<std::string, std::string> names{
      {"m", "place"},   {"m/s", "velocity"},           {"m/s^2", "acceleration"},
      {"rad", "angle"}, {"rad/s", "angular velocity"}, {"rad/s^2", "angular acceleration"}};
  return names.at(unit);
}

void draw(const Path& file, const std::vector<double>& time, const std::vector<SmoothedColumn>& columns) {
  plot::Figure figure{.title = "Smoothed motion", .panels = {}};
  for (const SmoothedColumn& c : columns) {
    auto panel = std::find_if(figure.panels.begin(), figure.panels.end(),
                              [&](const plot::Panel& p) { return p.y.unit == c.unit; });
    if (panel == figure.panels.end()) {
      figure.panels.push_back({.x = {"time", "s"}, .y = {quantity_in(c.unit), c.unit}, .series = {}});
      panel = std::prev(figure.panels.end());
    }
    panel->series.push_back({c.name, time, c.value});
  }
  plot::write_picture(file, figure);
}

}  // namespace

namespace {

/// What is known of an offset before it is looked for, as [camera] offset.
::fit::OffsetOptions offset_options(const KinematicsArguments& a) {
  using enum ::fit::OffsetOptions::Sign;
  ::fit::OffsetOptions out;
  const auto seconds = [](const char* option, const std::string& text) {
    return scene::placed({.file = option}, [&] { return hydro::parse_si(text, dim::time); });
  };
  if (!a.around.empty()) out.around = seconds("--around", a.around);
  if (!a.longest.empty()) out.longest = seconds("--longest", a.longest);
  if (!(out.longest > 0))
    throw InputError(fmt::format("\"{}\" must be positive", a.longest), {.file = "--longest"},
                     "write how far off the offset may be, either way: \"0.4 s\"");
  if (!a.sign.empty()) out.sign = a.sign == "same" ? same : opposite;
  out.remedy +=
      "; or say what is known: the offset to less than half of that (--around, --longest), and whether the record goes "
      "as the film does (--sign)";
  return out;
}

/// How late the record's clock is behind the track's own. \throws hydro::InputError at the option or the file that is
/// wrong
::fit::Offset offset_of(const KinematicsArguments& a, const ::fit::OffsetOptions& options, const FilmAsked& film,
                        const TrackInPlane& track, const std::vector<fc::Channel>& channels) {
  const auto& signals = film.model.signals;
  if (signals.empty())
    throw InputError("the scene has no signal that a record could show, too", film.model.data_place,
                     "add signal = [{ between = [\"pivot\", \"bob\"], of = \"chain.link1.polar\" }]");
  const auto equals = a.match.find('=');
  const std::string of(hydro::trimmed(std::string_view(a.match).substr(0, equals)));
  const auto signal = std::find_if(signals.begin(), signals.end(), [&](const auto& s) { return s.of == of; });
  if (equals == std::string::npos || signal == signals.end())
    throw InputError(fmt::format("\"{}\" names no signal of the scene and a column", a.match), {.file = "--match"},
                     fmt::format("write --match \"{} = name of a column\"", signals.front().of));
  const auto table = hydro::io::CsvTable::read(*a.record);
  const std::vector<double> time = table.column(a.record_time, dim::time);
  const auto& column = table.column(std::string(hydro::trimmed(std::string_view(a.match).substr(equals + 1))));
  const Eigen::VectorXd value = fc::channels_of(track.places, channels).values.col(signal - signals.begin());
  std::vector<double> own = track.places.time;  // without the offset that [camera] has already: messages name the whole
  for (double& t : own) t += track.begin - film.camera.offset;
  return scene::placed({.file = a.record->string()}, [&] {
    return ::fit::offset_between(own, std::span(value.data(), static_cast<std::size_t>(value.size())), time, column,
                                 options);
  });
}

/// The frame that is nearest to --start-at, and how long before that instant it was taken.
NearFrame frame_at_start(const KinematicsArguments& a, const fc::SmoothTrack& track, double begin) {
  const double at = option_si("--start-at", a.start_at, dim::time) - begin;
  if (!(at >= track.time.front() && at <= track.time.back()))
    throw InputError(fmt::format("the track has no {}: it goes from {:.6g} s to {:.6g} s", a.start_at,
                                 track.time.front() + begin, track.time.back() + begin),
                     {.file = "--start-at"}, "name a time between");
  const auto nearest = std::min_element(track.time.begin(), track.time.end(),
                                        [&](double s, double t) { return std::abs(s - at) < std::abs(t - at); });
  return {static_cast<std::size_t>(nearest - track.time.begin()), at - *nearest};
}

/// Where the markers of a line's nodes are and how they move at an instant, as a scene of motion takes it.
std::string start_of_line(const KinematicsArguments& a, const scene::CameraTable& camera, const fc::SmoothTrack& track,
                          const NearFrame& at) {
  std::vector<std::string> places, velocities;
  double place_sd = 0, velocity_sd = 0;
  for (std::size_t from = 0; from <= a.nodes.size();) {
    const std::size_t to = std::min(a.nodes.find(',', from), a.nodes.size());
    const std::string name(hydro::trimmed(std::string_view(a.nodes).substr(from, to - from)));
    from = to + 1;
    const auto marker = std::find(track.markers.begin(), track.markers.end(), name);
    if (marker == track.markers.end())
      throw InputError(fmt::format("the track has no marker \"{}\"", name), {.file = "--nodes"},
                       fmt::format("its markers are {}", fmt::join(track.markers, ", ")));
    const fc::MarkerMotion m = track.marker(static_cast<std::size_t>(marker - track.markers.begin()), at.frame);
    const Eigen::Vector2d place = m.place + at.since * (m.velocity + at.since / 2 * m.acceleration),
                          velocity = m.velocity + at.since * m.acceleration;
    place_sd = std::max(place_sd, m.place_sd.maxCoeff());
    velocity_sd = std::max(velocity_sd, m.velocity_sd.maxCoeff());
    const auto vector = [&](const Eigen::Vector2d& v, double across, const char* unit) {
      Eigen::Vector3d all(across, across, v.y());
      all[camera.along()] = v.x();
      return fmt::format("\"({:.6g}, {:.6g}, {:.6g}) {}\"", all.x(), all.y(), all.z(), unit);
    };
    places.push_back(vector(place, camera.pivot_at[1 - camera.along()], "m"));
    velocities.push_back(vector(velocity, 0, "m/s"));
  }
  return fmt::format(
      "# {} at {}, smoothed by froude {}; standard deviations up to {:.2g} m and {:.2g} m/s\n"
      "[line.start]\nat = [{}]\nvelocity = [{}]\n",
      a.scene.filename().string(), a.start_at, FROUDE_VERSION, place_sd, velocity_sd, fmt::join(places, ", "),
      fmt::join(velocities, ", "));
}

/// What the film tells of clocks and of the model's release, in the track's own times, with what to write in [camera].
void say_instants(const KinematicsArguments& a, const FilmAsked& film, const TrackInPlane& track,
                  const std::vector<fc::Channel>& channels, Report& report) {
  if (a.record) {
    const ::fit::OffsetOptions options = offset_options(a);
    const ::fit::Offset o = offset_of(a, options, film, track, channels);
    report.say(
        "{}: [camera] offset = \"{:.6g} s\", standard deviation {:.2g} s, within {:.2g} s with 95 %; "
        "correlation {:.5g}, elsewhere {:.3g} at most",
        a.record->filename().string(), fact("offset_s", o.lag), fact("offset_deviation_s", o.deviation),
        fact("offset_half_width_s", o.half_width), fact("correlation", o.correlation),
        fact("correlation_elsewhere", o.runner_up));
    if (const std::string known = ::fit::supposed(options, "[camera] offset"); !known.empty())
      report.say("{}", fact("supposed", known));
  }
  if (!a.release) return;
  const fc::Release r = scene::placed({.file = "--release"}, [&] { return fc::release_of(track.places, *a.release); });
  report.say("{} is let go: [camera] from = \"{:.6g} s\", standard deviation {:.2g} s", *a.release,
             fact("release_s", r.at + track.begin), fact("release_deviation_s", r.deviation));
}

}  // namespace

void kinematics(const KinematicsArguments& a, const Console& console) {
  std::vector<NamedFile> inputs = files_of_scene(a.scene);
  if (a.record) inputs.push_back({"--record", *a.record});
  if (std::error_code unknown; a.second && std::filesystem::is_regular_file(*a.second, unknown))
    inputs.push_back({"--second", *a.second});
  require_outputs(named({{"-o", a.output}, {"--picture", a.picture}, {"--start", a.start}}), inputs);
  require_picture(a.picture);
  if (a.space || a.second) return kinematics_in_space(a, console);
  if (a.bandwidth.empty())
    throw InputError("places are smoothed by a bandwidth, and none is given", {.file = "--bandwidth"},
                     "write --bandwidth \"4 Hz\": motion that is slower keeps 99 % and more");
  const scene::FitScene scene = scene::read_fit(a.scene);
  const FilmAsked film = film_asked(scene, a.film);
  fc::SmoothOptions options{.bandwidth_hz =
                                option_si("--bandwidth", a.bandwidth, dim::angular_velocity) / (2 * std::numbers::pi)};
  for (const std::string& length : a.lengths) options.lengths.push_back(known_length(length));
  const TrackInPlane in_plane = track_in_plane(scene, film.model, film.record);
  std::vector<std::string> notes;
  const fc::SmoothTrack track = scene::placed({.file = film.record.file.value.string()}, [&] {
    FittingSightings fitting = fitting_sightings(in_plane, options.bandwidth_hz);
    notes = std::move(fitting.notes);
    return fc::smooth(fitting.places, options);
  });
  std::vector<SmoothedColumn> columns;
  const auto take = [&](std::vector<SmoothedColumn> more) {
    std::move(more.begin(), more.end(), std::back_inserter(columns));
  };
  for (std::size_t m = 0; m < track.markers.size(); ++m) take(marker_columns(track, m, film.camera.axis.back()));
  const auto channels = channels_asked(film.model, film.camera);
  const FilmedBodies bodies(film.scene_of_motion(), film.camera, track);
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (channels[c].kind == fc::Channel::Kind::angle && !bodies.tells(film.model.signals[c].of))
      take(angle_columns(track, channels[c], film.model.signals[c].of));
  take(bodies.columns());
  std::vector<hydro::io::CsvColumn> written{{"t", "s", &track.time}};
  for (const SmoothedColumn& c : columns) {
    written.push_back({c.name, c.unit, &c.value});
    written.push_back({c.name + "_deviation", c.unit, &c.deviation});
  }
  hydro::io::write_csv(a.output, written,
                       {fmt::format("smoothed by froude {}: gain 0.99 at {:g} Hz, half at {:.4g} Hz", FROUDE_VERSION,
                                    options.bandwidth_hz, track.cutoff_hz)});
  if (a.picture) draw(*a.picture, track.time, columns);
  Report report;
  if (a.start) {
    const NearFrame at = frame_at_start(a, track, in_plane.begin);
    if (a.nodes.empty()) {
      const FilmedStart start = bodies.start(at, *a.start, a.start_at);
      hydro::io::write_atomically(*a.start, start.text);
      report.say("bodies begin with standard deviations up to {:.2g} m and {:.2g} rad, {:.2g} m/s and {:.2g} rad/s{}",
                 fact("start_deviation_m", start.deviation[0]), fact("start_deviation_rad", start.deviation[1]),
                 fact("start_deviation_m_s", start.deviation[2]), fact("start_deviation_rad_s", start.deviation[3]),
                 start.opened.empty() ? "" : fmt::format("; as measured, {} at most", start.opened));
    } else {
      hydro::io::write_atomically(*a.start, start_of_line(a, film.camera, track, at));
    }
  }
  report.say("{} frames of {} markers, gain 0.99 at {:g} Hz and half at {:.4g} Hz; {} known lengths{}",
             fact("frames", track.time.size()), fact("markers", track.markers.size()),
             fact("bandwidth_hz", options.bandwidth_hz), fact("cutoff_hz", track.cutoff_hz),
             fact("lengths", options.lengths.size()),
             track.rounds > 0 ? fmt::format(", straight after {} rounds", track.rounds) : "");
  report.sentences("notes", "note: {}", notes);
  for (const SmoothedColumn& c : columns)
    report.row("column", "  {} [{}]: mean standard deviation {:.3g}", fact("name", c.name), fact("unit", c.unit),
               fact("mean_deviation", mean_of(c.deviation)));
  bodies.say(report);
  say_instants(a, film, in_plane, channels, report);
  report.wrote(a.output).wrote(a.picture).wrote(a.start);
  tell(report, console);
}

}  // namespace froude
