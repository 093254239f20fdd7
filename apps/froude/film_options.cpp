#include "froude/film_options.hpp"

#include <memory>

namespace froude {
namespace {

template <class Arguments>
void calls_with(CLI::App& command, Request& request, const std::shared_ptr<Arguments>& arguments,
                const std::function<void(const Arguments&, const Console&)>& function) {
  command.callback([=, &request] {
    request.call = [=](const Console& console) {
      function(*arguments, console);
      return done;
    };
  });
}

void add_track(CLI::App& app, Request& request, const FilmCommands& commands) {
  auto* command =
      app.add_subcommand("track", "bright discs of a film, frame by frame, with the covariance of each place");
  command->footer(
      "Example:\n  froude track film.avi --markers \"pivot, joint, bob\" --radius \"4 px .. 12 px\" -o track.csv\n"
      "    --annotated annotated.avi --picture ways.png");
  auto a = std::make_shared<TrackArguments>();
  command->add_option("film", a->film, "the film: whatever OpenCV's FFmpeg decodes")->required();
  command
      ->add_option("-m,--markers", a->markers,
                   "names of the markers, \"pivot, joint, bob\", or how many; of tags with their numbers, \"pivot = 3, "
                   "bob = 7\"")
      ->required();
  command->add_option("--radius", a->radius, "of the discs")->capture_default_str();
  command->add_option("--contrast", a->contrast, "grey levels of 255 above their surroundings, at least")
      ->capture_default_str();
  command->add_option("--roundness", a->roundness, "short over long axis, at least")->capture_default_str();
  command->add_flag("--dark", a->dark, "discs are darker than their surroundings");
  command->add_option("--colour", a->colour, "discs are of this colour: \"#e02020\"")->excludes("--dark");
  auto* pattern = command
                      ->add_option("--template", a->pattern,
                                   "a picture of the marker (.png), cut out of a frame, in place of discs")
                      ->excludes("--dark");
  command->add_option("--likeness", a->likeness, "to the template, at least: normalised correlation")
      ->needs(pattern)
      ->capture_default_str();
  command->add_option("--tags", a->tags, "family of tags, \"apriltag 36h11\", whose numbers --markers says")
      ->excludes("--dark", "--colour", "--template");
  command->add_option("--order", a->order, "of the markers in the first frame")
      ->check(CLI::IsMember({"left to right", "top to bottom"}))
      ->capture_default_str();
  command->add_option("--first", a->first, "where they are in the first frame, px: \"(412, 220), (530, 310)\"");
  command->add_option("--length", a->lengths, "a distance that stays, and its deviation: \"pivot joint 120 px 2 px\"");
  command->add_option("--frame-rate", a->frame_rate, "\"25 Hz\"; default: times as the file has them");
  command->add_option("--from", a->from, "leave out what comes before: \"1.2 s\"");
  command->add_option("--to", a->to, "leave out what comes after");
  command->add_option("-o,--output", a->output, "the track (.csv, or .h5)")->required();
  command->add_option("--annotated", a->annotated, "the film with what was found (.avi, .mkv or .mp4)");
  command->add_option("--picture", a->picture, "the first frame with the ways of all markers (.png)");
  calls_with(*command, request, a, commands.track);
}

void add_calibrate(CLI::App& app, Request& request, const FilmCommands& commands) {
  auto* command = app.add_subcommand("calibrate", "lens and plane of motion from pictures of a checkerboard");
  command->footer(
      "Example:\n  froude calibrate boards/*.png --corners \"9 x 6\" --square \"25 mm\" --plane plane.png -o "
      "lens.toml");
  auto a = std::make_shared<CalibrateArguments>();
  command->add_option("pictures", a->pictures, "of the board, or films of it")->required();
  command->add_option("--corners", a->corners, "between the squares of the board")->capture_default_str();
  command->add_option("--square", a->square, "side of a square: \"25 mm\"")->required();
  command->add_option("--plane", a->plane, "picture of the board in the plane of motion");
  command->add_option("--radial", a->radial, "coefficients of radial distortion, 0 to 3")->capture_default_str();
  command->add_flag("--tangential", a->tangential, "tangential distortion too");
  command->add_option("-o,--output", a->output, "the calibration (.toml)")->required();
  command->add_option("--annotated", a->annotated, "folder for the pictures with the corners found");
  calls_with(*command, request, a, commands.calibrate);
}

void add_film(CLI::App& app, Request& request, const FilmCommands& commands) {
  auto* command = app.add_subcommand("film", "a film of a run, whose truth is known");
  command->footer("Example:\n  froude film examples/film/film.toml -o film.avi --truth truth.csv");
  auto a = std::make_shared<FilmArguments>();
  command->add_option("scene", a->scene, "scene of a film (.toml)")->required();
  command->add_option("-o,--output", a->output, "the film: .avi or .mkv without loss, or .mp4")->required();
  command->add_option("--truth", a->truth, "where the markers are, without error (.csv)");
  calls_with(*command, request, a, commands.film);
}

}  // namespace

void add_films(CLI::App& app, Request& request, const FilmCommands& commands) {
  add_track(app, request, commands);
  add_calibrate(app, request, commands);
  add_film(app, request, commands);
}

}  // namespace froude
