#include "answers/film.hpp"

#include "answers/fit_kind.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;

const Binding<FilmScene::Marker>& film_marker() {
  using Marker = FilmScene::Marker;
  static const auto table =
      Binding<Marker>("[[film.marker]]", "a reflecting disc on a sticker, or a tag, and on what it sits")
          .key(name_key("", "of the marker"), &Marker::name)
          .optional(text("node",
                         "of the run, whose signals NODE.x and so on it follows: "
                         "\"dropper.node3\""),
                    &Marker::node)
          .optional(vector("at", dim::length, "it stays there"), &Marker::at)
          .optional(integer("tag", "its number, where the film shows tags"), &Marker::tag)
          .exactly_one_of({"node", "at"})
          .place(&Marker::place);
  return table;
}

/// What the film's light and noise are.
Binding<FilmScene> light_keys() {
  return Binding<FilmScene>("", "")
      .key(number("blur", "standard deviation of the optics' blur, px")
               .within(Limit::not_negative)
               .or_default("0.5", "a lens in focus"),
           &FilmScene::blur)
      .key(number("noise", "standard deviation of each pixel, grey levels of 255")
               .within(Limit::not_negative)
               .or_default("0", "a clean film"),
           &FilmScene::noise)
      .key(number("fall_of_light", "share by which the right edge is darker than the left one")
               .within(Limit::fraction)
               .or_default("0", "even light"),
           &FilmScene::fall_of_light)
      .key(number("flicker", "standard deviation of the light from frame to frame, as a share")
               .within(Limit::fraction)
               .or_default("0", "steady light"),
           &FilmScene::flicker)
      .key(number("lost", "share of the frames that are lost").within(Limit::fraction).or_default("0", "all are kept"),
           &FilmScene::lost)
      .key(integer("seed", "another number is other noise").or_default("1", "any"), [](const Value& v, FilmScene& out) {
        if (v.integer < 0) throw v.wrong("must not be negative");
        out.seed = static_cast<std::uint64_t>(v.integer);
      });
}

/// Discs on stickers, or tags with numbers.
void check_what_markers_are(const Record& record, const FilmScene& film) {
  const bool tags = !film.tags.empty();
  for (const char* key : {"disc_radius", "sticker_radius"})
    if (record.has(key) == tags)
      throw tags ? record.wrong(key, "is of discs, and the film shows tags", "leave it out")
                 : record.refused(fmt::format("has no {}", key), "say how large discs and stickers are, or take tags");
  if ((film.tag_side > 0) != tags) throw record.refused("has only one of tags and tag_side", "say both, or neither");
  for (const auto& m : film.markers)
    if (m.tag.has_value() != tags)
      throw hydro::InputError(
          fmt::format("marker \"{}\" {}", m.name, tags ? "has no tag" : "has a tag, and the film shows discs"), m.place,
          tags ? "write the number of each: tag = 3" : "say which family: [film] tags");
  if (!tags && film.sticker_radius <= film.disc_radius)
    throw record.wrong("sticker_radius", "must be larger than disc_radius");
}

const Binding<FilmScene>& film_binding() {
  static const auto table =
      Binding<FilmScene>("[film]", "what is filmed, and how")
          .key(text("scene", "the scene of motion, relative to this one; its run is filmed"), &FilmScene::scene)
          .key(integer("width", "px").within(Limit::at_least_one), &FilmScene::width)
          .at_most(16384)
          .key(integer("height", "px").within(Limit::at_least_one), &FilmScene::height)
          .at_most(16384)
          .key(positive("frame_rate", dim::angular_velocity, "\"25 Hz\""), in_hertz(&FilmScene::frame_rate))
          .key(quantity("exposure", dim::time, "a frame shows the mean of this time").or_default("0 s", "an instant"),
               &FilmScene::exposure)
          .optional(positive("disc_radius", dim::length, "of the bright discs; needed without tags"),
                    &FilmScene::disc_radius)
          .optional(positive("sticker_radius", dim::length, "of the black stickers around them; needed without tags"),
                    &FilmScene::sticker_radius)
          .optional(text("tags",
                         "a family of tags, \"apriltag 36h11\", upright on a white rim, in place of discs: each marker "
                         "has the number of its `tag`"),
                    &FilmScene::tags)
          .optional(positive("tag_side", dim::length, "of the tags' black squares; needed with tags"),
                    &FilmScene::tag_side)
          .optional(positive("bar_width", dim::length, "of grey bars from each marker to the next; left out: none"),
                    &FilmScene::bar_width)
          .part(light_keys())
          .tables("marker", film_marker(), &FilmScene::markers)
          .place(&FilmScene::place)
          .then([](const Record& record, FilmScene& film) {
            if (film.exposure < 0 || film.exposure * film.frame_rate > 1)
              throw record.wrong("exposure", "must lie between nothing and the time between frames");
            check_what_markers_are(record, film);
          });
  return table;
}

}  // namespace

const Table& film_schema() {
  static const Table table{
      .title = "a film",
      .meaning = "a film of a run, made to try what films are tried on: its truth is known",
      .keys = {integer("schema", "version of this grammar, 1"), text("title", "for people").optional(),
               inner_table("film", film_binding().table()), inner_table("camera", camera_binding().table())}};
  return table;
}

FilmScene read_film(const std::filesystem::path& file) {
  const Node document = parse_document(hydro::io::read_text(file), file.string());
  check_version(document);
  std::vector<Echo> echo;
  const Record root = read_record(document, film_schema(), echo);
  FilmScene out = film_binding().read(root.table("film"));
  out.camera = camera_binding().read(root.table("camera"));
  if (root.has("title")) out.title = root.text("title");
  const Record& camera = root.table("camera");
  for (const char* key : {"distance", "deviation", "frame_rate", "offset", "from", "to", "marker"})
    if (camera.has(key)) throw camera.wrong(key, "is of a track, and does not apply to a film", "leave it out");
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(out.scene.value, unknown))
    throw hydro::InputError("[film] scene is no file", out.scene.place,
                            fmt::format("looked for {}", out.scene.value.string()));
  return out;
}

}  // namespace froude::scene
