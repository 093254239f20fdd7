// `froude track`: discs of a film, frame by frame.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "fit/camera/detect.hpp"
#include "fit/camera/shapes.hpp"
#include "fit/camera/track_file.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/markers.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "hydro/base/parallel.hpp"
#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
namespace dim = hydro::dim;
using hydro::InputError;

InputError wrong(const std::string& option, const std::string& rule, const std::string& remedy) {
  return InputError(rule, {.file = option}, remedy);
}

/// "8 px", or a plain number.
double pixels(const std::string& option, std::string_view text) {
  std::string_view number = hydro::trimmed(text);
  if (number.ends_with("px")) number = hydro::trimmed(number.substr(0, number.size() - 2));
  return scene::placed({.file = option}, [&] { return hydro::parse_number(number); });
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(at, from), text.size());
    const auto part = hydro::trimmed(std::string_view(text).substr(from, to - from));
    if (!part.empty()) out.emplace_back(part);
    from = to + 1;
  }
  return out;
}

/// Without numbers of tags.
std::vector<std::string> names_of(const std::string& markers) {
  std::vector<std::string> out = split(markers, ',');
  for (std::string& name : out) name = hydro::trimmed(std::string_view(name).substr(0, name.find('=')));
  if (out.size() == 1 && std::all_of(out[0].begin(), out[0].end(), [](unsigned char c) { return std::isdigit(c); })) {
    const int count = static_cast<int>(hydro::parse_number(out[0]));
    if (count < 1 || count > 1000) throw wrong("--markers", "a film has 1 to 1000 markers", "write --markers 8");
    out.clear();
    for (int k = 1; k <= count; ++k) out.push_back(fmt::format("m{}", k));
  }
  if (out.empty()) throw wrong("--markers", "names no marker", "write --markers \"pin0, pin1, bob\", or how many: 3");
  for (const std::string& name : out) {
    if (std::count(out.begin(), out.end(), name) > 1)
      throw wrong("--markers", fmt::format("names \"{}\" twice", name), "give each marker a name of its own");
    if (name.find_first_of(";[]()\"#%/\t ") != std::string::npos)
      throw wrong("--markers", fmt::format("\"{}\" is no name", name), "take letters, digits, _ and -");
  }
  return out;
}

/// Of tags, in the order of the markers.
std::vector<int> numbers_of(const std::string& markers, int count) {
  std::vector<int> out;
  for (const std::string& marker : split(markers, ',')) {
    const auto at = marker.find('=');
    if (at == std::string::npos)
      throw wrong("--markers", fmt::format("does not say which tag \"{}\" is", marker),
                  "write the number of each: \"pivot = 3, bob = 7\"");
    const double number = pixels("--markers", std::string_view(marker).substr(at + 1));
    if (!(number >= 0 && number < count) || number != std::floor(number))
      throw wrong("--markers", fmt::format("there is no tag {} in this family", number),
                  fmt::format("its tags are 0 to {}", count - 1));
    if (std::find(out.begin(), out.end(), static_cast<int>(number)) != out.end())
      throw wrong("--markers", fmt::format("names tag {} twice", number), "give each marker a tag of its own");
    out.push_back(static_cast<int>(number));
  }
  return out;
}

fc::DetectOptions discs_of(const TrackArguments& a) {
  const auto dots = a.radius.find("..");
  if (dots == std::string::npos) throw wrong("--radius", "is no range", "write --radius \"8 px .. 15 px\"");
  return {.smallest_px = pixels("--radius", std::string_view(a.radius).substr(0, dots)),
          .largest_px = pixels("--radius", std::string_view(a.radius).substr(dots + 2)),
          .contrast = a.contrast,
          .roundness = a.roundness,
          .dark = a.dark};
}

std::optional<film::Colour> colour_asked(const TrackArguments& a) {
  if (!a.colour) return {};
  unsigned red = 0, green = 0, blue = 0;
  if (a.colour->size() != 7 || std::sscanf(a.colour->c_str(), "#%2x%2x%2x", &red, &green, &blue) != 3)
    throw wrong("--colour", fmt::format("\"{}\" is no colour", *a.colour), "write red, green and blue: \"#e02020\"");
  return film::Colour{static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                      static_cast<std::uint8_t>(blue)};
}

fc::AssignOptions assignment_of(const TrackArguments& a) {
  fc::AssignOptions out{.names = names_of(a.markers)};
  out.order =
      a.order == "top to bottom" ? fc::AssignOptions::Order::top_to_bottom : fc::AssignOptions::Order::left_to_right;
  if (a.first) {
    std::string numbers = *a.first;
    std::replace_if(
        numbers.begin(), numbers.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
    const auto all = split(numbers, ',');
    if (all.size() != 2 * out.names.size())
      throw wrong("--first", fmt::format("has {} numbers for {} markers", all.size(), out.names.size()),
                  "write x and y of each, px: \"(412, 220), (530, 310)\"");
    for (std::size_t k = 0; k < all.size(); k += 2)
      out.first.emplace_back(pixels("--first", all[k]), pixels("--first", all[k + 1]));
  }
  for (const std::string& length : a.lengths) {
    std::string plain = length;
    for (auto at = plain.find("px"); at != std::string::npos; at = plain.find("px")) plain.erase(at, 2);
    const auto words = split(plain, ' ');
    if (words.size() != 4)
      throw wrong("--length", fmt::format("\"{}\" is no distance between two markers", length),
                  "write both, their distance and its deviation: \"pin0 pin1 120 px 2 px\"");
    out.lengths.push_back({words[0], words[1], pixels("--length", words[2]), pixels("--length", words[3])});
    scene::placed({.file = "--length"}, [&] { fc::check(out.lengths.back()); });
  }
  return out;
}

/// What one picture shows.
struct Found {
  fc::Detection detection = {};
  std::vector<std::optional<fc::Sighting>> named = {};  ///< of tags, which say which marker they are
};

/// How markers are told from all else.
class Finder {
 public:
  explicit Finder(const TrackArguments& a) : discs_(discs_of(a)), likeness_(a.likeness) {
    if (a.pattern) pattern_ = film::read_picture(*a.pattern);
    if (a.pattern && !(likeness_ > 0 && likeness_ <= 1))
      throw wrong("--likeness", "must lie between 0 and 1", "0.8 passes what is hidden in part, too");
    if (!a.tags) return;
    tags_ = scene::placed({.file = "--tags"}, [&] { return std::make_shared<film::TagReader>(*a.tags); });
    numbers_ = numbers_of(a.markers, tags_->count());
  }

  Found in(const fc::Picture& picture) const {
    if (tags_) return tags_in(picture);
    if (pattern_) return {like_pattern(picture)};
    return {fc::detect(picture, discs_)};
  }
  bool tags() const { return tags_ != nullptr; }
  bool discs() const { return !tags_ && !pattern_; }

 private:
  Found tags_in(const fc::Picture& picture) const {
    Found out;
    out.named.resize(numbers_.size());
    for (const film::Tag& tag : tags_->read(picture)) {
      const auto middle = fc::middle_of_square(picture, tag.corners);
      if (!middle) {
        ++out.detection.small;
        continue;
      }
      out.detection.discs.push_back({.centre = *middle, .radius_px = 0, .contrast = 0, .axis_ratio = 1});
      const auto at = std::find(numbers_.begin(), numbers_.end(), tag.number);
      if (at != numbers_.end()) out.named[static_cast<std::size_t>(at - numbers_.begin())] = *middle;
    }
    return out;
  }

  fc::Detection like_pattern(const fc::Picture& picture) const {
    fc::Detection out;
    for (const Eigen::Vector2d& near : film::places_like(picture, *pattern_, likeness_)) {
      if (const auto middle = fc::middle_of_pattern(picture, *pattern_, near))
        out.discs.push_back({.centre = *middle, .radius_px = 0, .contrast = 0, .axis_ratio = 1});
      else
        ++out.at_edge;
    }
    return out;
  }

  fc::DetectOptions discs_;
  double likeness_;
  std::optional<fc::Picture> pattern_;
  std::shared_ptr<const film::TagReader> tags_;
  std::vector<int> numbers_;
};

/// What was found in the frames that are taken.
struct Seen {
  std::vector<fc::Frame> frames;
  std::vector<std::vector<std::optional<fc::Sighting>>> named;  ///< of tags, one a frame
  std::vector<std::size_t> number;                              ///< of each in the film
  std::vector<std::size_t> empty;                               ///< frames of the film in which nothing was found
  std::size_t read = 0;                                         ///< frames of the film, taken or not
  std::size_t repeated = 0;  ///< frames that are the one before once more, which cameras write for lost ones
  fc::Detection left_out;    ///< sums over the frames; no discs
  fc::Picture first;
  bool uneven = false;
  std::vector<std::size_t> unstamped;  ///< frames of the film whose time OpenCV does not tell
};

/// Reads frames in batches, of which threads look at one each.
class Watching {
 public:
  Watching(const TrackArguments& a, film::FilmReader& reader)
      : reader_(reader),
        finder_(a),
        colour_(colour_asked(a)),
        from_(time_of("--from", a.from, 0)),
        to_(time_of("--to", a.to, std::numeric_limits<double>::infinity())) {
    if (!a.frame_rate) return;
    rate_ = option_si("--frame-rate", *a.frame_rate, dim::angular_velocity) / (2 * std::numbers::pi);
    if (!(rate_ > 0))
      throw wrong("--frame-rate", fmt::format("\"{}\" must be positive", *a.frame_rate), "write it like \"25 Hz\"");
  }

  Seen all(Progress& progress) {
    const double frames = std::max<double>(1, static_cast<double>(reader_.frames()));
    bool more = true;
    while (more) {
      std::vector<fc::Picture> pictures;
      more = read_batch(pictures);
      look(pictures);
      progress.update(std::min(1.0, static_cast<double>(read_) / frames));
    }
    settle_times();
    out_.read = read_;
    return std::move(out_);
  }

 private:
  static double time_of(const char* option, const std::optional<std::string>& text, double otherwise) {
    if (!text) return otherwise;
    return scene::placed({.file = option}, [&] { return hydro::parse_si(*text, dim::time); });
  }

  bool read_batch(std::vector<fc::Picture>& pictures) {
    constexpr std::size_t batch = 32;
    while (pictures.size() < batch) {
      fc::Picture picture;
      double stamp = 0;
      if (!reader_.next(picture, stamp, colour_)) return false;
      const double time = time_of_frame(stamp);
      ++read_;
      if (time > to_) return false;
      if (time < from_) continue;
      if (picture.grey == before_.grey) {
        ++out_.repeated;
        continue;
      }
      before_ = picture;
      if (out_.frames.empty()) out_.first = picture;
      out_.frames.push_back({time, {}});
      out_.number.push_back(read_);
      pictures.push_back(std::move(picture));
    }
    return true;
  }

  /// By the rate that is given, else by the frame's own stamp. Of the last frames of films with B-frames OpenCV tells
  /// 0: these go on from the one before by the rate of the file.
  double time_of_frame(double stamp) {
    if (rate_ > 0) return static_cast<double>(read_) / rate_;
    if (read_ > 0 && !(stamp > last_) && reader_.frame_rate() > 0) {
      out_.unstamped.push_back(read_ + 1);
      return last_ += 1 / reader_.frame_rate();
    }
    return last_ = stamp;
  }

  void look(const std::vector<fc::Picture>& pictures) {
    std::vector<Found> found(pictures.size());
    hydro::in_parallel(pictures.size(), hydro::all_processors(),
                       [&](std::size_t i) { found[i] = finder_.in(pictures[i]); });
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const std::size_t k = out_.frames.size() - pictures.size() + i;
      const fc::Detection& here = found[i].detection;
      for (const fc::Disc& d : here.discs) out_.frames[k].found.push_back(d.centre);
      if (finder_.tags()) out_.named.push_back(std::move(found[i].named));
      if (here.discs.empty()) out_.empty.push_back(out_.number[k]);
      out_.left_out.small += here.small;
      out_.left_out.large += here.large;
      out_.left_out.drawn_out += here.drawn_out;
      out_.left_out.at_edge += here.at_edge;
    }
  }

  /// Containers round their stamps to milliseconds: where all are within one of the rate that the file states, frames
  /// are even.
  void settle_times() {
    const double rate = rate_ > 0 ? rate_ : reader_.frame_rate();
    bool even = rate > 0;
    for (std::size_t i = 0; i < out_.frames.size() && even; ++i)
      even = is_unstamped(out_.number[i]) ||
             std::abs(out_.frames[i].time - static_cast<double>(out_.number[i] - 1) / rate) < 1.1e-3;
    for (std::size_t i = 0; i < out_.frames.size() && even; ++i)
      out_.frames[i].time = static_cast<double>(out_.number[i] - 1) / rate;
    out_.uneven = !even;
    if (out_.uneven && !out_.unstamped.empty())
      throw InputError(fmt::format("the film tells no time of {} of its {} frames, the first of them frame {}, and the "
                                   "others are not even",
                                   out_.unstamped.size(), read_, out_.unstamped.front()),
                       {}, "end before it (--to), or convert the film: ffmpeg -i FILM -c:v ffv1 film.avi");
  }

  bool is_unstamped(std::size_t number) const {
    return std::binary_search(out_.unstamped.begin(), out_.unstamped.end(), number);
  }

  film::FilmReader& reader_;
  Finder finder_;
  std::optional<film::Colour> colour_;
  double from_, to_, rate_ = 0, last_ = 0;
  std::size_t read_ = 0;
  fc::Picture before_;
  Seen out_;
};

/// Tags say themselves which marker they are. \throws hydro::InputError for one that is never seen
fc::Assigned by_their_tags(const Seen& seen, const std::vector<std::string>& names) {
  fc::Assigned out{.track = {},
                   .sightings = 0,
                   .left_over = 0,
                   .missing = std::vector<std::size_t>(names.size(), 0),
                   .acceleration = 0};
  for (const std::string& name : names) out.track.markers.push_back({name, {}});
  for (std::size_t i = 0; i < seen.frames.size(); ++i) {
    out.track.time.push_back(seen.frames[i].time);
    out.left_over += seen.frames[i].found.size();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto& at = out.track.markers[k].seen.emplace_back(seen.named[i][k]);
      ++(at ? out.sightings : out.missing[k]);
    }
  }
  out.left_over -= out.sightings;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (out.missing[k] == seen.frames.size())
      throw wrong("--markers", fmt::format("the tag of \"{}\" is in no frame", names[k]),
                  "look at a frame: is its number right, is it whole, flat and larger than 12 px?");
  return out;
}

/// Largest step between frames, px.
double fastest(const fc::Track& track) {
  double out = 0;
  for (const fc::Marker& m : track.markers)
    for (std::size_t i = 1; i < track.frames(); ++i)
      if (m.seen[i] && m.seen[i - 1]) out = std::max(out, (m.seen[i]->at - m.seen[i - 1]->at).norm());
  return out;
}

void add_markers(const fc::Assigned& assigned, Report& report) {
  for (std::size_t k = 0; k < assigned.track.markers.size(); ++k) {
    const fc::Marker& m = assigned.track.markers[k];
    double variance = 0;
    std::size_t seen = 0, gap = 0, longest = 0;
    for (const auto& s : m.seen) {
      gap = s ? 0 : gap + 1;
      longest = std::max(longest, gap);
      if (s) variance += s->covariance.trace() / 2, ++seen;
    }
    report.row("marker", "{}: in {} of {} frames, longest gap {} frames, standard deviation of a place {:.3g} px",
               fact("name", m.name), fact("seen", seen), fact("frames", m.seen.size()), fact("longest_gap", longest),
               fact("deviation_px", std::sqrt(variance / std::max<double>(1, static_cast<double>(seen)))));
  }
}

std::vector<std::string> cautions_of(const TrackArguments& a, std::size_t stated, const Seen& seen,
                                     const fc::Assigned& assigned, const std::string& lossy_codec) {
  std::vector<std::string> out;
  const std::size_t frames = assigned.track.frames();
  // Files that only tell how long they last state a frame or two more than there are.
  if (!a.to && static_cast<double>(stated) > 1.02 * static_cast<double>(seen.read) + 2)
    out.push_back(fmt::format("the file states {} frames, and {} can be decoded: was it cut off? The track ends there",
                              stated, seen.read));
  if (!seen.empty.empty())
    out.push_back(
        fmt::format("no marker in {} of {} frames, the first of them frame {}: is the light there even, are radii "
                    "(--radius) and contrast (--contrast) those of the discs?",
                    seen.empty.size(), frames, seen.empty.front()));
  for (std::size_t k = 0; k < assigned.missing.size(); ++k)
    if (2 * assigned.missing[k] > frames)
      out.push_back(fmt::format("{} is missing in {} of {} frames: was it lost at a crossing? {}",
                                assigned.track.markers[k].name, assigned.missing[k], frames,
                                a.lengths.empty() ? "Known lengths (--length) help"
                                                  : "Or is a known length (--length) not that of the picture?"));
  for (const fc::Exchangeable& e : assigned.alike)
    out.push_back(
        fmt::format("{0} and {1} cannot be told apart in {2} frame{3}, the first of them at {4:.6g} s: they "
                    "are left without both; a known length (--length) or tags (--tags) tell them apart, and "
                    "a film that begins later (--from) names them anew",
                    assigned.track.markers[e.first].name, assigned.track.markers[e.second].name, e.frames,
                    e.frames == 1 ? "" : "s", e.time));
  if (!lossy_codec.empty())
    out.push_back(
        fmt::format("the film is compressed with loss ({}), which displaces marks by 0.02 px to 0.06 px, alike "
                    "in neighbouring frames: deviations of places do not count it; film at the "
                    "highest rate of bits, or without loss",
                    lossy_codec));
  if (!seen.unstamped.empty())
    out.push_back(
        fmt::format("the film tells no time of {} of its frames, the first of them frame {}: they go on at "
                    "the rate of the others, which are even",
                    seen.unstamped.size(), seen.unstamped.front()));
  if (seen.repeated > 0)
    out.push_back(fmt::format("{} frames repeat the one before, pixel by pixel: they are lost frames, and left out",
                              seen.repeated));
  if (seen.uneven)
    out.push_back(
        "the frames are not even in time, or the file states no rate: their own times are written; where they are "
        "even, give --frame-rate");
  const double step = fastest(assigned.track);
  out.push_back(
      fmt::format("each frame is taken for one instant: a rolling shutter would displace the fastest marker, which "
                  "goes {:.3g} px a frame, by as much as that from the top of the picture to its bottom",
                  step));
  return out;
}

/// The film again, with what was found in it.
void annotate(const TrackArguments& a, const Seen& seen, const fc::Track& track, Progress& progress) {
  film::FilmReader reader(a.film);
  const double span = seen.frames.back().time - seen.frames.front().time;
  film::FilmWriter writer(*a.annotated, reader.size(), static_cast<double>(seen.frames.size() - 1) / span);
  fc::Picture picture;
  double stamp = 0;
  constexpr std::size_t trail = 25;
  for (std::size_t number = 1, i = 0; i < seen.frames.size() && reader.next(picture, stamp); ++number) {
    if (number != seen.number[i]) continue;
    film::Annotation drawn(picture);
    for (std::size_t k = 0; k < track.markers.size(); ++k) {
      const auto& all = track.markers[k].seen;
      std::vector<Eigen::Vector2d> path;
      for (std::size_t j = i > trail ? i - trail : 0; j <= i; ++j)
        if (all[j]) path.push_back(all[j]->at);
      drawn.path(path, film::colour_of(k));
      if (!all[i]) continue;
      drawn.cross(all[i]->at, 6, film::colour_of(k));
      drawn.label(all[i]->at + Eigen::Vector2d(8, -8), track.markers[k].name, film::colour_of(k));
    }
    drawn.add_to(writer);
    progress.update(static_cast<double>(++i) / static_cast<double>(seen.frames.size()));
  }
}

/// The first frame with the ways of all markers.
void draw(const Path& file, const Seen& seen, const fc::Track& track) {
  film::Annotation drawn(seen.first);
  for (std::size_t k = 0; k < track.markers.size(); ++k) {
    std::vector<Eigen::Vector2d> path;
    for (const auto& s : track.markers[k].seen)
      if (s) path.push_back(s->at);
    drawn.path(path, film::colour_of(k));
    const Eigen::Vector2d& first = path.front();  // each marker is seen somewhere
    drawn.cross(first, 8, film::colour_of(k));
    drawn.label(first + Eigen::Vector2d(10, -10), track.markers[k].name, film::colour_of(k));
  }
  drawn.write(file);
}

void say_what_was_found(const TrackArguments& a, const Seen& seen, const fc::Assigned& assigned, Report& report) {
  const std::size_t markers = assigned.track.markers.size();
  if (a.tags) {
    report.say("tags of {}: {} of the {} markers, {} others", fact("tags", *a.tags), fact("given", assigned.sightings),
               markers, fact("left_over", assigned.left_over));
    report.say("tags whose edges could not be told: {}", fact("without_edges", seen.left_out.small));
    return;
  }
  if (a.pattern) {
    report.say("places like {}, correlation {:g} at least: {} given to {} markers, {} left over",
               fact("template", a.pattern->filename().string()), fact("likeness", a.likeness),
               fact("given", assigned.sightings), markers, fact("left_over", assigned.left_over));
    report.say("places that are like it and do not fit it, or lie at an edge: {}",
               fact("at_edge", seen.left_out.at_edge));
    return;
  }
  const fc::DetectOptions discs = discs_of(a);
  report.say(
      "discs of radius {:g} to {:g} px, {:g} levels above their surroundings at least, short over long axis {:g} at "
      "least: {} given to {} markers, {} left over",
      fact("smallest_px", discs.smallest_px), fact("largest_px", discs.largest_px), fact("contrast", discs.contrast),
      fact("roundness", discs.roundness), fact("given", assigned.sightings), assigned.track.markers.size(),
      fact("left_over", assigned.left_over));
  report.say(
      "bright places that are no such discs: {} small or faint, {} large, {} drawn out, {} at an edge or beside "
      "another",
      fact("small", seen.left_out.small), fact("large", seen.left_out.large),
      fact("drawn_out", seen.left_out.drawn_out), fact("at_edge", seen.left_out.at_edge));
}

Report told(const TrackArguments& a, const film::FilmReader& reader, const Seen& seen, const fc::Assigned& assigned) {
  Report report;
  const Eigen::Vector2i size = reader.size();
  report.keep("film", a.film.filename().string());
  report.say("{}: {} x {} px, {} frames from {:.6g} s to {:.6g} s", a.film.filename().string(), fact("width", size.x()),
             fact("height", size.y()), fact("frames", seen.frames.size()), fact("from_s", seen.frames.front().time),
             fact("to_s", seen.frames.back().time));
  say_what_was_found(a, seen, assigned, report);
  if (!a.tags)
    report.say("predictions allow for accelerations of {:.3g} px/s^2",
               fact("acceleration_px_s2", assigned.acceleration));
  add_markers(assigned, report);
  report.sentences("cautions", "note: {}", cautions_of(a, reader.frames(), seen, assigned, reader.lossy_codec()));
  return report;
}

}  // namespace

void track(const TrackArguments& a, const Console& console) {
  require_outputs(named({{"-o", a.output}, {"--annotated", a.annotated}, {"--picture", a.picture}}),
                  {{"the film", a.film}});
  const fc::AssignOptions options = assignment_of(a);
  film::FilmReader reader(a.film);
  Progress progress(console.err, "track", console.show_progress);
  const hydro::Place place{.file = a.film.string()};
  const Seen seen = scene::placed(place, [&] { return Watching(a, reader).all(progress); });
  if (seen.read < 2)
    throw InputError(fmt::format("{} of its frames can be decoded, two are needed", seen.read), place,
                     "is the file a film, and whole? " + film::how_to_convert(a.film));
  if (seen.frames.size() == 1 && seen.repeated > 0)
    throw InputError("all frames show the same picture: nothing moves in this film", place,
                     "take the film, or the part of it (--from, --to), in which the model moves");
  if (seen.frames.size() < 2)
    throw InputError(fmt::format("{} frames lie in the time that is asked for", seen.frames.size()), place,
                     "widen --from and --to");
  if (seen.empty.size() == seen.frames.size())
    throw InputError(a.tags      ? "no frame shows a tag of this family"
                     : a.pattern ? "no frame shows a place that is like the template"
                                 : "no frame shows a disc of this size and contrast",
                     place,
                     "look at a frame: family (--tags) or template, radii (--radius), contrast (--contrast), --dark or "
                     "--colour must "
                     "be those of the markers");
  fc::Assigned assigned = a.tags ? by_their_tags(seen, options.names)
                                 : scene::placed(place, [&] { return fc::assign(seen.frames, options); });
  assigned.track.size = reader.size();
  fc::write_track(
      a.output, assigned.track,
      {fmt::format("track of {} by froude {}: places in pixels from the centre of the upper left one, y down",
                   a.film.filename().string(), FROUDE_VERSION)});
  if (a.picture) draw(*a.picture, seen, assigned.track);
  if (a.annotated) annotate(a, seen, assigned.track, progress);
  Report report = told(a, reader, seen, assigned);
  report.wrote(a.output).wrote(a.annotated).wrote(a.picture);
  tell(report, console);
}

}  // namespace froude
