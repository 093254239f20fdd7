#include "froude/fit_report.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

using Json = FitJson;

/// A JSON value as TOML; a string of JSON is a basic string of TOML, and a float stays a float.
std::string toml_value(const Json& value) {
  if (value.is_array()) {
    std::vector<std::string> parts;
    for (const auto& part : value) parts.push_back(toml_value(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (!value.is_number_float()) return value.dump();
  const std::string text = fmt::format("{}", value.get<double>());
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

void append_toml(std::string& out, const std::string& path, const Json& table) {
  for (const auto& [key, value] : table.items())
    if (!value.is_object() && !(value.is_array() && !value.empty() && value[0].is_object()))
      out += key + " = " + toml_value(value) + "\n";
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      out += fmt::format("\n[{}{}]\n", prefix, key);
      append_toml(out, prefix + key, value);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& entry : value) {
        out += fmt::format("\n[[{}{}]]\n", prefix, key);
        append_toml(out, prefix + key, entry);
      }
    }
  }
}

void write_toml(const Path& path, const Json& results) {
  std::string out = fmt::format("# Estimates of `froude fit`, version {}. SI units.\n", FROUDE_VERSION);
  append_toml(out, "", results);
  hydro::io::write_atomically(path, out);
}

}  // namespace

void deliver(const FitArguments& arguments, const Console& console, const Json& results, const plot::Figure& picture) {
  if (arguments.output) write_toml(*arguments.output, results);
  if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(picture));
  if (console.json) {
    console.out << results.dump(1) << '\n';
    return;
  }
  if (arguments.output) console.out << "wrote " << arguments.output->string() << '\n';
  if (arguments.picture) console.out << "wrote " << arguments.picture->string() << '\n';
}

}  // namespace froude
