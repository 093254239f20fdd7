#pragma once
/// \file  Fits of the examples, or of what is wrong with one of them, in a folder of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/source_dir.hpp"

namespace fit_test {

/// A folder of its own, and what a fit says.
class FitFolder : public testing::Test {
 protected:
  FitFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~FitFolder() override { std::filesystem::remove_all(folder); }

  static std::string told(const froude::FitArguments& arguments, bool json = false) {
    std::ostringstream out, err;
    froude::fit(arguments, {out, err, json});
    return out.str();
  }

  /// The interval of a coefficient holds the truth.
  static bool holds(const nlohmann::json& coefficient, double truth) {
    return coefficient["interval"][0].get<double>() < truth && truth < coefficient["interval"][1].get<double>();
  }

  std::filesystem::path folder;
};

inline const std::filesystem::path examples = froude_test::source_dir() / "examples/fit";

/// Fits of the examples as they are, or with one text replaced.
class Fit : public FitFolder {
 protected:
  /// Its data beside it.
  std::filesystem::path changed(const std::string& scene, const std::string& from, const std::string& to) {
    std::string text = hydro::io::read_text(examples / scene);
    text.replace(text.find(from), from.size(), to);
    using Options = std::filesystem::copy_options;
    std::filesystem::copy(examples, folder, Options::recursive | Options::overwrite_existing);
    hydro::io::write_atomically(folder / "changed.toml", text);
    return folder / "changed.toml";
  }
};

/// The files of a folder of examples, copied where they may be spoilt.
class FitsOf : public FitFolder {
 protected:
  explicit FitsOf(const std::string& subject) {
    std::filesystem::copy(froude_test::source_dir() / "examples" / subject, folder);
  }

  nlohmann::json tree(const std::string& scene) const {
    return nlohmann::json::parse(told({.scene = folder / scene}, true));
  }

  std::string text_of(const std::string& file) const { return hydro::io::read_text(folder / file); }
  void write(const std::string& file, const std::string& text) const {
    hydro::io::write_atomically(folder / file, text);
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = text_of(file);
    ASSERT_NE(text.find(from), std::string::npos) << from << " is not in " << file;
    text.replace(text.find(from), from.size(), to);
    write(file, text);
  }
  /// The cells of one column of a data file, each made anew from its row, counted from 0, and what it was.
  void refill(const std::string& file, std::size_t column,
              const std::function<std::string(std::size_t, const std::string&)>& cell) const {
    std::istringstream in(text_of(file));
    std::string out, line;
    for (std::size_t row = 0, heads = 0; std::getline(in, line);) {
      if (line.starts_with('#') || heads++ == 0) {
        out += line + "\n";
        continue;
      }
      std::istringstream cells(line);
      std::string one, made;
      for (std::size_t i = 0; std::getline(cells, one, ','); ++i)
        made += (i > 0 ? "," : "") + (i == column ? cell(row, one) : one);
      out += made + "\n";
      ++row;
    }
    write(file, out);
  }
  /// The first rows of a data file alone.
  void keep(const std::string& file, std::size_t rows) const {
    std::istringstream in(text_of(file));
    std::string out, line;
    for (std::size_t data = 0; std::getline(in, line);)
      if (line.starts_with('#') || data++ <= rows) out += line + "\n";
    write(file, out);
  }
  /// What the fit says against it; "" where it has nothing to say. Numerics that gave up are told apart.
  std::string refusal(const std::string& scene) const {
    try {
      told({.scene = folder / scene});
    } catch (const hydro::InputError& e) {
      return e.where().str() + ": " + e.rule() + " -> " + e.remedy();
    } catch (const hydro::NumericsError& e) {
      return std::string("numerics: ") + e.what();
    }
    return {};
  }
  /// Of the scene with one text replaced.
  std::string refusal(const std::string& scene, const std::string& from, const std::string& to) const {
    const std::string before = text_of(scene);
    replace(scene, from, to);
    const std::string out = refusal(scene);
    write(scene, before);
    return out;
  }
};

/// The day at a tank, from volts on: what make_tank_day.py put in.
class TankDay : public FitsOf {
 protected:
  TankDay() : FitsOf("tank_day") {}
};

}  // namespace fit_test
