#include "froude/experiment_options.hpp"

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "froude/experiment.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

namespace dim = hydro::dim;

double positive_of(const std::string& option, const std::string& text, const hydro::Dimension& needed) {
  const auto value = parsed(option, text, needed);
  if (!value || !(*value > 0))
    throw hydro::InputError(fmt::format("{} must be positive, got {}", option, text), {.file = option},
                            fmt::format("write for example \"{}\"", needed.example()));
  return *value;
}
std::optional<double> positive_or_none(const std::string& option, const std::string& text,
                                       const hydro::Dimension& needed) {
  if (text.empty()) return std::nullopt;
  return positive_of(option, text, needed);
}

/// Of the record that a plan makes, as it was written: units are read when the command runs.
struct RecordTexts {
  std::string noise, memory, rate = "100 Hz", length, density;
};

void add_record(CLI::App& command, const std::shared_ptr<RecordTexts>& texts, std::optional<double>& width) {
  command.add_option("--width", width, "half of the interval that is wanted: how long must the record be?");
  command.add_option("--noise", texts->noise, "standard deviation of the force's noise");
  command.add_option("--memory", texts->memory, "of that noise: it forgets by 1/e; white if left out");
  command.add_option("--rate", texts->rate, "of sampling")->capture_default_str();
  command.add_option("--length", texts->length,
                     "of the cylinder in the water: with the density, tells the largest force");
  command.add_option("--density", texts->density, "of the water");
}

/// \throws hydro::InputError for what goes without the other
void check_record(const RecordTexts& texts, bool width) {
  const auto refuse = [](const std::string& what, const char* remedy) {
    throw hydro::InputError(what, {.file = "command line"}, remedy);
  };
  for (const auto& [option, text] :
       {std::pair{"--noise", &texts.noise}, {"--length", &texts.length}, {"--density", &texts.density}})
    if (width && text->empty()) refuse(fmt::format("--width needs {}", option), "add it");
  if (!width && !texts.noise.empty())
    refuse("--noise does not act without --width", "leave it out, or ask for a --width");
  if (texts.length.empty() != texts.density.empty())
    refuse("--length and --density belong together", "give both, or none");
}

/// Into a plan of libfit, and whether it knows the cylinder's length and water. \throws as check_record()
template <class Plan>
bool read_record(const RecordTexts& texts, const std::optional<double>& width, double viscosity, Plan& plan) {
  check_record(texts, width.has_value());
  if (texts.length.empty()) return false;
  plan.cylinder = {.diameter = 0,
                   .length = positive_of("--length", texts.length, dim::length),
                   .density = positive_of("--density", texts.density, dim::density),
                   .viscosity = viscosity,
                   .experiment = ::fit::Experiment::body_moves};
  if (!width) return true;
  plan.noise = positive_of("--noise", texts.noise, dim::force);
  plan.memory = parsed("--memory", texts.memory, dim::time).value_or(0);
  plan.step = 2 * std::numbers::pi / positive_of("--rate", texts.rate, dim::angular_velocity);
  return true;
}

struct OscillationTexts {
  std::string diameter, amplitude, period, speed, viscosity, mass = "0 kg", of = "cd";
};

void read(const OscillationTexts& texts, const RecordTexts& record, OscillationPlanArguments& a) {
  a.viscosity = positive_of("--viscosity", texts.viscosity, dim::kinematic_viscosity);
  a.known.diameter = positive_or_none("--diameter", texts.diameter, dim::length);
  a.known.amplitude = positive_or_none("--amplitude", texts.amplitude, dim::length);
  a.known.period = positive_or_none("--period", texts.period, dim::time);
  a.known.speed = positive_or_none("--speed", texts.speed, dim::velocity);
  a.loads = read_record(record, a.width, a.viscosity, a.record);
  if (!a.loads) return;
  a.record.cylinder.mass_beyond_load_cells = *parsed("--mass", texts.mass, dim::mass);
  a.wanted = texts.of == "cd" ? ::fit::Wanted::cd : ::fit::Wanted::inertia;
}

void add_oscillation_plan(CLI::App& experiment, Request& request) {
  auto* command =
      experiment.add_subcommand("oscillation", "KC, Re, beta, amplitude, period and speed of a cylinder that swings");
  command->footer(
      "Examples:\n  froude experiment oscillation --diameter \"0.12 m\" --kc 20 --period \"4 s\" --viscosity \"1.05e-6 "
      "m^2/s\"\n"
      "  froude experiment oscillation --diameter \"0.12 m\" --kc 20 --period \"4 s\" --viscosity \"1.05e-6 m^2/s\"\n"
      "    --width 0.05 --noise \"2 N\" --memory \"0.1 s\" --length \"0.5 m\" --density \"997 kg/m^3\" --mass \"5.9 "
      "kg\"");
  auto arguments = std::make_shared<OscillationPlanArguments>();
  auto texts = std::make_shared<OscillationTexts>();
  auto record = std::make_shared<RecordTexts>();
  command->add_option("--diameter", texts->diameter,
                      "of the cylinder; of all these numbers any three that tell the rest");
  command->add_option("--amplitude", texts->amplitude, "of the motion");
  command->add_option("--period", texts->period, "of the motion");
  command->add_option("--speed", texts->speed, "the largest");
  command->add_option("--kc", arguments->known.kc, "Keulegan-Carpenter number UT/D");
  command->add_option("--re", arguments->known.re, "Reynolds number UD/nu");
  command->add_option("--beta", arguments->known.beta, "Re/KC");
  command->add_option("--viscosity", texts->viscosity, "kinematic, of the water")->required();
  add_record(*command, record, arguments->width);
  command->add_option("--of", texts->of, "whose interval")->check(CLI::IsMember({"cd", "ca"}))->capture_default_str();
  command->add_option("--mass", texts->mass, "beyond the load cells")->capture_default_str();
  command->add_option("--cd", arguments->record.cd, "that is expected")->capture_default_str();
  command->add_option("--ca", arguments->record.inertia, "that is expected")->capture_default_str();
  command->add_option("--confidence", arguments->record.confidence, "level of the interval")->capture_default_str();
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      read(*texts, *record, *arguments);
      plan_oscillation(*arguments, console);
      return done;
    };
  });
}

void add_tow_plan(CLI::App& experiment, Request& request) {
  auto* command = experiment.add_subcommand("tow", "Re and speed of a cylinder that is towed, and how long it tows");
  command->footer(
      "Examples:\n  froude experiment tow --diameter \"0.12 m\" --re 8e4 --viscosity \"1.05e-6 m^2/s\" --tank \"60 "
      "m\"\n"
      "  froude experiment tow --diameter \"0.12 m\" --re 8e4 --viscosity \"1.05e-6 m^2/s\" --tank \"60 m\"\n"
      "    --width 0.01 --noise \"0.3 N\" --memory \"0.5 s\" --length \"0.5 m\" --density \"997 kg/m^3\"");
  struct Texts {
    std::string diameter, speed, viscosity, tank, acceleration = "1 m/s^2";
  };
  auto arguments = std::make_shared<TowPlanArguments>();
  auto texts = std::make_shared<Texts>();
  auto record = std::make_shared<RecordTexts>();
  command->add_option("--diameter", texts->diameter, "of the cylinder; of diameter, speed and Re any two");
  command->add_option("--speed", texts->speed, "of the carriage");
  command->add_option("--re", arguments->re, "Reynolds number UD/nu");
  command->add_option("--viscosity", texts->viscosity, "kinematic, of the water")->required();
  command->add_option("--tank", texts->tank, "length that the carriage may go")->required();
  command->add_option("--acceleration", texts->acceleration, "of the carriage at both ends")->capture_default_str();
  command->add_option("--strouhal", arguments->strouhal,
                      "Strouhal number, of a smooth cylinder about 0.2: tells how often vortices leave it");
  add_record(*command, record, arguments->width);
  command->add_option("--cd", arguments->record.cd, "that is expected")->capture_default_str();
  command->add_option("--confidence", arguments->record.confidence, "level of the interval")->capture_default_str();
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      arguments->diameter = positive_or_none("--diameter", texts->diameter, dim::length);
      arguments->speed = positive_or_none("--speed", texts->speed, dim::velocity);
      arguments->viscosity = positive_of("--viscosity", texts->viscosity, dim::kinematic_viscosity);
      arguments->length = positive_of("--tank", texts->tank, dim::length);
      arguments->acceleration = positive_of("--acceleration", texts->acceleration, dim::acceleration);
      arguments->loads = read_record(*record, arguments->width, arguments->viscosity, arguments->record);
      plan_tow(*arguments, console);
      return done;
    };
  });
}

void add_wave_plan(CLI::App& experiment, Request& request) {
  auto* command = experiment.add_subcommand(
      "waves", "steepness and depth of regular waves, and how long they are steady in a tank");
  command->footer(
      "Example:\n  froude experiment waves --period \"1.6 s\" --height \"0.06 m\" --depth \"1.25 m\" --gauge \"20 m\" "
      "--body \"23 m\"\n"
      "    --end \"60 m\" --ramp \"2 s\"");
  struct Texts {
    std::string period, height, depth, gauge, body, end, ramp = "0 s", diameter, level;
  };
  auto arguments = std::make_shared<WavePlanArguments>();
  auto texts = std::make_shared<Texts>();
  command->add_option("--period", texts->period, "of the waves")->required();
  command->add_option("--height", texts->height, "crest to trough")->required();
  command->add_option("--depth", texts->depth, "of the water, or infinite")->required();
  command->add_option("--gauge", texts->gauge, "distance of the gauge from the wavemaker")->required();
  command->add_option("--body", texts->body, "distance of the body from the wavemaker")->required();
  command->add_option("--end", texts->end, "distance of the beach or wall that sends waves back");
  command->add_option("--ramp", texts->ramp, "until the wavemaker moves fully")->capture_default_str();
  command->add_option("--settle", arguments->settle_periods, "periods given to the body's own motion")
      ->capture_default_str();
  command->add_option("--diameter", texts->diameter, "of a cylinder in the waves: tells its KC");
  command->add_option("--level", texts->level, "of its axis below still water");
  command->add_option("--cd", arguments->cd, "that is expected of it")->capture_default_str();
  command->add_option("--cm", arguments->cm, "that is expected of it")->capture_default_str();
  command->add_option("--picture", arguments->picture,
                      "which load leads on the cylinder, by KC and thickness (.svg, .png, .pdf)");
  command->callback([=, &request] {
    request.call = [=](const Console& console) {
      auto& a = *arguments;
      a.period = positive_of("--period", texts->period, dim::time);
      a.height = positive_of("--height", texts->height, dim::length);
      a.tank.water.depth = texts->depth == "infinite"
                               ? hydro::WaterDepth::infinite()
                               : hydro::WaterDepth::from_metres(positive_of("--depth", texts->depth, dim::length));
      a.tank.gauge = *parsed("--gauge", texts->gauge, dim::length);
      a.tank.body = *parsed("--body", texts->body, dim::length);
      if (const auto end = positive_or_none("--end", texts->end, dim::length)) a.tank.end = *end;
      a.ramp = *parsed("--ramp", texts->ramp, dim::time);
      for (const auto& [option, value] : {std::pair{"--ramp", a.ramp}, {"--settle", a.settle_periods}})
        if (!(value >= 0 && value < 1e6))
          throw hydro::InputError(fmt::format("{} must lie between 0 and 1e6, got {:g}", option, value),
                                  {.file = "command line"}, "leave it out, or write a time that passes");
      a.diameter = positive_or_none("--diameter", texts->diameter, dim::length);
      a.level = parsed("--level", texts->level, dim::length);
      plan_waves(a, console);
      return done;
    };
  });
}

}  // namespace

void add_experiment(CLI::App& app, Request& request) {
  auto* experiment =
      app.add_subcommand("experiment", "plans of experiments in a tank: numbers, times, lengths of records");
  experiment->require_subcommand(1);
  add_oscillation_plan(*experiment, request);
  add_tow_plan(*experiment, request);
  add_wave_plan(*experiment, request);
}

}  // namespace froude
