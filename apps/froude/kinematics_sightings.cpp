#include "froude/kinematics_sightings.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "fit/camera/sightings.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

namespace fc = ::fit::camera;
using hydro::InputError;

/// Frames are counted from 1, the first that the scene takes.
std::string frames_of(const fc::Misfit& m, const TrackInPlane& track) {
  const auto at = [&](std::size_t frame) { return track.places.time[frame] + track.begin; };
  return m.first == m.last
             ? fmt::format("in frame {} ({:.6g} s)", m.first + 1, at(m.first))
             : fmt::format("in frames {} to {} ({:.6g} to {:.6g} s)", m.first + 1, m.last + 1, at(m.first), at(m.last));
}

std::string misfit_of(const fc::Misfit& m, const TrackInPlane& track) {
  if (!m.settles)
    return fmt::format("from frame {} ({:.6g} s) on \"{}\" does not go on as before", m.first + 1,
                       track.places.time[m.first] + track.begin, m.marker);
  return fmt::format("\"{}\" {} is {:.3g} m, {:.2g} of its deviations, from the path of its other sightings", m.marker,
                     frames_of(m, track), m.away, m.errors);
}

/// Two markers that do not fit in the same frames have perhaps each other's places.
bool perhaps_exchanged(const std::vector<fc::Misfit>& misfits) {
  return std::any_of(misfits.begin(), misfits.end(), [&](const fc::Misfit& a) {
    return std::any_of(misfits.begin(), misfits.end(), [&](const fc::Misfit& b) {
      return a.marker != b.marker && a.first <= b.last && b.first <= a.last;
    });
  });
}

/// As many as a screen takes.
std::string list_of(const std::vector<fc::Misfit>& misfits, const TrackInPlane& track) {
  constexpr std::size_t most = 8;
  std::vector<std::string> told;
  for (const fc::Misfit& m : misfits)
    if (told.size() < most) told.push_back(misfit_of(m, track));
  if (misfits.size() > most) told.push_back(fmt::format("{} more", misfits.size() - most));
  return fmt::format("{}", fmt::join(told, "; "));
}

/// Those that a wider band takes, or those that none does.
std::vector<fc::Misfit> misfits_of(const fc::SightingCheck& check, bool faster) {
  std::vector<fc::Misfit> out;
  std::copy_if(check.misfits.begin(), check.misfits.end(), std::back_inserter(out),
               [&](const fc::Misfit& m) { return m.faster == faster; });
  return out;
}

void refuse_misfits(const std::vector<fc::Misfit>& misfits, const TrackInPlane& track) {
  if (misfits.empty()) return;
  throw InputError(
      fmt::format("sightings do not fit: {}", list_of(misfits, track)), {},
      fmt::format("{}leave wrong sightings out (an empty cell each); where the motion itself is as fast as "
                  "that, take a larger --bandwidth",
                  perhaps_exchanged(misfits)
                      ? "exchange the names of markers that have each other's places in these frames; "
                      : ""));
}

void refuse_cut_motion(const fc::SightingCheck& check, double bandwidth_hz) {
  const auto worst = std::max_element(check.markers.begin(), check.markers.end(),
                                      [](const auto& a, const auto& b) { return a.lost < b.lost; });
  if (worst == check.markers.end() || !worst->cut()) return;
  throw InputError(
      fmt::format("the bandwidth, {:g} Hz, is too low for the motion of \"{}\": what it cuts off is {:.2g} of the "
                  "standard deviation of a smoothed place",
                  bandwidth_hz, worst->marker, worst->lost),
      {.file = "--bandwidth"}, fmt::format("take a larger one: \"{:.2g} Hz\"", 1.5 * bandwidth_hz));
}

std::vector<std::string> notes_of(const fc::SightingCheck& check, const TrackInPlane& track) {
  std::vector<std::string> out;
  for (const fc::Scatter& s : check.markers)
    if (s.factor > 1)
      out.push_back(
          fmt::format("sightings of \"{}\" lie {:.2g} times as far from the smoothed path as their stated "
                      "deviation says: deviations are wider by that",
                      s.marker, s.factor));
  if (const auto fast = misfits_of(check, true); !fast.empty())
    out.push_back(
        fmt::format("what is told of these frames may be wrong by more than its deviation, since the motion is "
                    "too fast for the bandwidth or a sighting is wrong: {}; take a larger --bandwidth, or leave "
                    "the sightings out",
                    list_of(fast, track)));
  return out;
}

}  // namespace

FittingSightings fitting_sightings(const TrackInPlane& track, double bandwidth_hz) {
  const fc::SightingCheck check = fc::check_sightings(track.places, bandwidth_hz);
  refuse_cut_motion(check, bandwidth_hz);
  refuse_misfits(misfits_of(check, false), track);
  return {fc::widened(track.places, check), notes_of(check, track)};
}

}  // namespace froude
