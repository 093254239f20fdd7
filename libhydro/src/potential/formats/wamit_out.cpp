#include <algorithm>
#include <cmath>

#include "text_lines.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

/// The first word behind a label. \throws InputError if the line has no label, or nothing behind it
std::string word_behind(const TextLines& text, int line, std::string_view label) {
  const auto at = text.line(line).find(label);
  if (at == std::string::npos) text.refuse(line, fmt::format("\"{}\" is missing", label));
  const auto words = words_of(std::string_view(text.line(line)).substr(at + label.size()));
  if (words.empty()) text.refuse(line, fmt::format("there is nothing behind \"{}\"", label));
  return std::string(words.front());
}

double number_behind(const TextLines& text, int line, std::string_view label) {
  const auto value = fortran_number(word_behind(text, line, label));
  if (!value || !std::isfinite(*value)) text.refuse(line, fmt::format("\"{}\" is followed by no number", label));
  return *value;
}

/// The three numbers that end a line.
Eigen::Vector3d last_three(const TextLines& text, int line, const std::string& what) {
  const std::size_t words = text.words(line).size();
  if (words < 3) text.refuse(line, fmt::format("{} needs three numbers", what));
  return {text.number(line, words - 3, what), text.number(line, words - 2, what), text.number(line, words - 1, what)};
}

/// Of the numbers behind the label there are three, or the height alone: then the body floats at rest, so that its
/// weight is above its buoyancy.
Eigen::Vector3d read_centre_of_gravity(const TextLines& text, int line, const Eigen::Vector3d& buoyancy,
                                       bool& is_height_alone) {
  const auto behind = words_of(std::string_view(text.line(line)).substr(text.line(line).find(':') + 1));
  is_height_alone = behind.size() == 1;
  if (!is_height_alone) return last_three(text, line, "the centre of gravity");
  return {buoyancy.x(), buoyancy.y(), number_behind(text, line, ":")};
}

int line_of(const TextLines& text, std::string_view label, int from) {
  const int line = text.find(label, from);
  if (line == 0)
    throw InputError(fmt::format("there is no \"{}\"", label), {.file = text.path().string()},
                     "the file may be cut short, or be no .out file of WAMIT's second program");
  return line;
}

BodyData read_body(const TextLines& text, int line, double ulen, std::vector<std::string>& notes) {
  BodyData body;
  const Eigen::Vector3d origin(number_behind(text, line, "XBODY ="), number_behind(text, line, "YBODY ="),
                               number_behind(text, line, "ZBODY ="));
  body.reference_point = origin;
  if (const double phi = number_behind(text, line, "PHIBODY ="); phi != 0)
    text.refuse(line, fmt::format("the body's axes are turned by {} degrees", phi),
                "Froude reads data in the axes of the water: run WAMIT with PHIBODY = 0");
  if (ulen != 1) return body;
  const int volumes = line_of(text, "Volumes (VOLX,VOLY,VOLZ):", line);
  Eigen::Vector3d volume = last_three(text, volumes, "the volume");
  std::sort(volume.begin(), volume.end());
  body.displaced_volume = volume(1);  // WAMIT itself works with the median of the three
  // Both centres are written in the body's system, whose origin is XBODY.
  const Eigen::Vector3d buoyancy =
      last_three(text, line_of(text, "Center of Buoyancy (Xb,Yb,Zb):", line), "the centre of buoyancy");
  bool is_height_alone = false;
  body.centre_of_buoyancy = origin + buoyancy;
  body.centre_of_gravity =
      origin + read_centre_of_gravity(text, line_of(text, "Center of Gravity", line), buoyancy, is_height_alone);
  if (is_height_alone)
    notes.push_back(
        "the .out file tells the height alone of a centre of gravity; it is taken to be above the centre of buoyancy, "
        "as "
        "in a body that floats at rest");
  return body;
}

}  // namespace

WamitOut read_wamit_out(const std::filesystem::path& path) {
  const TextLines text = TextLines::read(path);
  const int gravity = line_of(text, "Gravity:", 1), depth = line_of(text, "Water depth:", gravity);
  WamitOut out{.gravity = number_behind(text, gravity, "Gravity:"),
               .ulen = number_behind(text, gravity, "Length scale:"),
               .body = {},
               .notes = {}};
  if (!(out.gravity > 0 && out.ulen > 0)) text.refuse(gravity, "gravity and length scale must be positive");
  if (word_behind(text, depth, "Water depth:") != "infinite")
    out.depth = WaterDepth::from_metres(number_behind(text, depth, "Water depth:"));
  if (text.contains(depth, "Water density:")) {
    out.density = number_behind(text, depth, "Water density:");
    if (!(*out.density > 0)) text.refuse(depth, "the density must be positive");
  }
  for (int line = text.find("XBODY =", depth); line != 0; line = text.find("XBODY =", line + 1)) {
    out.body.push_back(read_body(text, line, out.ulen, out.notes));
    out.body.back().name = fmt::format("body{}", out.body.size());
  }
  if (out.body.empty()) line_of(text, "XBODY =", depth);
  if (out.ulen != 1) out.notes.push_back("volumes and centres of the .out file are left out: ULEN is not 1");
  return out;
}

}  // namespace hydro::potential
