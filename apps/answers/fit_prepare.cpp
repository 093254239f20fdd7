/// \file  [prepare]: the steps between a measurement and its fit.
#include <algorithm>

#include "answers/fit_kind.hpp"
#include "answers/record_step_words.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
using ::fit::FilterChoice;
using ::fit::PrepareOptions;
using ::fit::WindowChoice;
constexpr double full_circle = 2 * std::numbers::pi;

Binding<PrepareOptions> outliers() {
  return Binding<PrepareOptions>("[prepare.outliers]", "single samples far off their neighbours, which are bridged")
      .key(positive("window", dim::time, "neighbours asked, half before and half after"),
           &PrepareOptions::outlier_window_s)
      .key(number("deviations", "how far off, in deviations of the neighbours (from their medians), 3 at least")
               .positive()
               .or_default(fmt::format("{:g}", usual_outlier_deviations),
                           "noise alone comes so far once in 1e15 samples"),
           [](const Value& v, PrepareOptions& out) {
             out.outlier_deviations = v.number;
             if (v.number < least_outlier_deviations)
               throw v.wrong(fmt::format("must be {:g} at least: noise itself comes so far", least_outlier_deviations));
           });
}

/// \p least: the lowest order that there is.
template <int least>
void take_order(const Value& v, FilterChoice& out) {
  constexpr int most = 10;
  out.order = static_cast<int>(v.integer);
  if (v.integer < least || v.integer > most) throw v.wrong(fmt::format("must lie between {} and {}", least, most));
}

Binding<FilterChoice> chebyshev_low_pass() {
  return Binding<FilterChoice>("", "recursive too, forward and backward: falls off sooner, and wavers before")
      .key(integer("order", "of one pass, 2 to 10").or_default("4", "as steep as most need"), take_order<2>)
      .key(number("ripple", "share of the amplitude by which it wavers, 1e-6 to 0.1")
               .or_default(fmt::format("{:g}", usual_ripple), "as little as a load cell is wrong by"),
           [](const Value& v, FilterChoice& out) {
             out.ripple = v.number;
             if (!(v.number >= 1e-6 && v.number <= 0.1)) throw v.wrong("must lie between 1e-6 and 0.1");
           })
      .sets(&FilterChoice::kind, FilterChoice::Kind::chebyshev);
}

const Binding<FilterChoice>& low_pass() {
  using F = FilterChoice;
  using enum F::Kind;
  static const auto table =
      Binding<F>("[prepare.low_pass]", "low pass without delay, over force and model alike")
          .key(text("kind", "of filter"))
          .key(positive("cutoff", dim::angular_velocity, "frequency of half the amplitude"), in_hertz(&F::hz))
          .variant(
              word_of(butterworth),
              Binding<F>("", "recursive, forward and backward")
                  .key(integer("order", "of one pass, 1 to 10").or_default("4", "as steep as most need"), take_order<1>)
                  .sets(&F::kind, butterworth))
          .variant(word_of(chebyshev), chebyshev_low_pass())
          .variant(
              word_of(gaussian),
              Binding<F>("", "finite: weights on a bell; falls off early, and never wavers").sets(&F::kind, gaussian))
          .variant(word_of(finite),
                   Binding<F>("", "finite: sinc under a Kaiser window of 60 dB, from half the cutoff to one and a half")
                       .sets(&F::kind, finite));
  return table;
}

Binding<FilterChoice> notch() {
  return Binding<FilterChoice>("[[prepare.notch]]",
                               "takes one line out: hum of the mains, a vibration of the structure")
      .sets(&FilterChoice::kind, FilterChoice::Kind::notch)
      .key(positive("centre", dim::angular_velocity, "frequency of the line"), in_hertz(&FilterChoice::hz))
      .key(positive("width", dim::angular_velocity, "between the frequencies of half the amplitude"),
           in_hertz(&FilterChoice::width));
}

Binding<PrepareOptions> band_by_edges() {
  return Binding<PrepareOptions>("", "edges that are named")
      .key(positive("low", dim::angular_velocity, "lower frequency of half the amplitude"),
           [](const Value& v, PrepareOptions& out) {
             out.band_pass = {v.number / full_circle, 0};
           })
      .key(positive("high", dim::angular_velocity, "higher frequency of half the amplitude"),
           [](const Value& v, PrepareOptions& out) { out.band_pass->high_hz = v.number / full_circle; })
      .then([](const Record& band, PrepareOptions& out) {
        if (!(out.band_pass->low_hz < out.band_pass->high_hz)) throw band.wrong("high", "must be higher than low");
      });
}

Binding<PrepareOptions> band_about_waves() {
  return Binding<PrepareOptions>("", "from 0.2 to 4 times the frequency of waves: drift goes, three harmonics stay")
      .sets(&PrepareOptions::band_about_waves, true)
      .optional(positive("frequency", dim::angular_velocity,
                         "of the waves; left out, in a fit of kind \"regular waves\": of the surface of each run"),
                [](const Value& v, PrepareOptions& out) {
                  out.band_about_waves = false;
                  out.band_pass = ::fit::band_about_waves(v.number / full_circle);
                });
}

const Binding<PrepareOptions>& band_pass() {
  static const auto table = Binding<PrepareOptions>("[prepare.band_pass]",
                                                    "band-pass of order 4 without delay, after the other filters: "
                                                    "neither a mean nor a drift passes")
                                .key(text("kind", "of band"))
                                .variant("edges", band_by_edges())
                                .variant("about the waves", band_about_waves());
  return table;
}

Binding<WindowChoice> full_cycles_window() {
  return Binding<WindowChoice>("", "cycles of full amplitude, found in the motion; build-up and run-down fall out")
      .optional(integer("last", "so many of them; left out: all"),
                [](const Value& v, WindowChoice& out) {
                  out.cycles = static_cast<int>(v.integer);
                  if (v.integer < 1) throw v.wrong("must be 1 at least");
                })
      .key(number("tolerance", "of amplitude and period, relative")
               .within(Limit::open_fraction)
               .or_default("0.03", "a build-up over three cycles takes a quarter each"),
           &WindowChoice::tolerance)
      .sets(&WindowChoice::kind, WindowChoice::Kind::full_cycles);
}

Binding<WindowChoice> span_window() {
  return Binding<WindowChoice>("", "from one time to another")
      .key(quantity("from", dim::time, "first instant"), &WindowChoice::from)
      .key(quantity("to", dim::time, "last instant"), &WindowChoice::to)
      .sets(&WindowChoice::kind, WindowChoice::Kind::span)
      .then([](const Record& window, WindowChoice& out) {
        if (!(out.from < out.to)) throw window.wrong("to", "must be later than from");
      });
}

Binding<WindowChoice> window() {
  return Binding<WindowChoice>("[prepare.window]", "the part of the record that is fitted")
      .key(text("kind", "of window"))
      .variant("full cycles", full_cycles_window())
      .variant("span", span_window());
}

/// Steps of a force alone.
Binding<PrepareOptions> steps_of_forces() {
  using enum ::fit::Derivative;
  return Binding<PrepareOptions>("", "")
      .optional(
          positive("derivative_bandwidth", dim::angular_velocity,
                   "of velocity and acceleration where they are derived; left out: five times the main frequency"),
          in_hertz(&PrepareOptions::derivative_bandwidth_hz))
      .words(text("derivative_method",
                  "how they are derived: a spline has less noise for the same bandwidth and gives up more at the ends; "
                  "a Fourier series is for a motion that repeats from one end of the record to the other")
                 .or_default("local polynomial", "gives up the least where a motion does not repeat"),
             {{"local polynomial", local_polynomial},
              {"smoothing spline", smoothing_spline},
              {"fourier series", fourier_series}},
             &PrepareOptions::derivative)
      .optional(inner_table("low_pass", low_pass().table()))
      .tables("notch", notch(), &PrepareOptions::filters)
      .optional()
      .optional(positive("moving_average", dim::time, "length of a mean over neighbours; a low pass does it better"),
                [](const Value& v, PrepareOptions& out) {
                  out.filters.push_back({.kind = FilterChoice::Kind::moving_average, .seconds = v.number});
                })
      .then([](const Record& prepare, PrepareOptions& out) {  // the last of all filters
        if (prepare.has("low_pass")) out.filters.push_back(low_pass().read(prepare.table("low_pass")));
      });
}

}  // namespace

const Binding<PrepareOptions>& prepare_binding() {
  static const auto table =
      Binding<PrepareOptions>("[prepare]",
                              "steps between the measurement and a fit of kind \"morison\"; each is told in the "
                              "report. A decay has longest_gap, outliers and a window of kind \"span\", records of "
                              "towing these, a rate and filters of the force, runs in waves these, trend and band-pass")
          .optional(positive("longest_gap", dim::time, "rows missing no longer than this are bridged"),
                    &PrepareOptions::longest_gap_s)
          .table("outliers", outliers())
          .key(effect(
                   "through_levels",
                   "channels that know few levels, of coarse potentiometers, become the spline through the middles of "
                   "their flat parts and of the jumps between them"),
               &PrepareOptions::through_levels)
          .optional(
              positive("resample", dim::angular_velocity,
                       "\"50 Hz\": all channels are brought to this sampling rate, without delay; kept is what lies "
                       "below 0.3 of the lower rate"),
              in_hertz(&PrepareOptions::resample_hz))
          .optional(quantity("delay", dim::time, "of the force behind the motion: taken off, or estimated with the fit")
                        .one_of({"estimate"}))
          .optional(
              positive("delay_error", dim::time, "standard uncertainty of a delay that is given").only_beside("delay"))
          .optional(positive("longest_delay", dim::time, "where it is estimated: searched so far either way")
                        .only_beside("delay"))
          .key(effect("detrend",
                      "the slope of the straight line of least squares through the window is taken off, through all of "
                      "the record where that is no span; the mean stays"),
               &PrepareOptions::detrend)
          .table("band_pass", band_pass())
          .part(steps_of_forces())
          .table("window", window(), &PrepareOptions::window)
          .optional()
          .key(effect("mean_cycle",
                      "the window's cycles are laid over each other: the mean force is fitted to the mean motion; "
                      "needs window = full cycles"),
               &PrepareOptions::average_cycles);
  return table;
}

void only_prepares(const FitTables& t, const std::vector<std::string>& steps, const char* remedy,
                   const char* no_cycles) {
  if (!t.root.has("prepare")) return;
  const std::string& kind = t.model().text("kind");
  const Record& prepare = t.root.table("prepare");
  for (const Key& key : prepare_binding().table().keys)
    if (std::find(steps.begin(), steps.end(), key.name) == steps.end() && prepare.has(key.name) &&
        !prepare[key.name].defaulted)
      throw prepare.wrong(key.name, not_of_kind(kind), remedy);
  if (prepare.has("window") && prepare.table("window").text("kind") != "span")
    throw prepare.table("window").wrong("kind",
                                        fmt::format("must be \"span\" for a fit of kind \"{}\", {}", kind, no_cycles));
}

}  // namespace froude::scene
