#pragma once
/// \file  A validation case: a question that has an answer outside this code, and the numbers that answer it.
///
/// A case is a folder validation/<name>/ with README.md (question, physics, what agreement would not show), accept.toml
/// (the limits, accept.hpp), case.cpp (a function in a namespace of its own) and, where the data are ours, reference/
/// with SOURCE.md.
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "answers/plot.hpp"

namespace froude::validation {

/// One answer. The unit is for people and must be the one that accept.toml states.
struct Number {
  std::string name;
  double value;
  std::string unit;  ///< "s"; "" for a number without dimension
};

struct Picture {
  std::string name;     ///< of the file, without ending: lower case, digits and dashes
  std::string caption;  ///< one sentence
  plot::Figure figure;
  bool shows_reference_curves = false;  ///< curves that are not ours: drawn on request only, never into the repository
};

struct Outcome {
  std::vector<Number> numbers;
  std::vector<Picture> pictures = {};
};

/// The case needs data that may be absent; it is then reported as skipped, never as passed.
class MissingData : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder of the cases in the source tree that this build was made from.
std::filesystem::path source_folder();

/// Where a case finds its files.
class Folders {
 public:
  /// `cases` holds one folder a case; `data` holds the reference data that are not ours, and need not exist.
  Folders(std::filesystem::path cases, std::filesystem::path data, std::string name)
      : cases_(std::move(cases)), data_(std::move(data)), name_(std::move(name)) {}

  std::filesystem::path own() const { return cases_ / name_; }
  std::filesystem::path reference(const std::string& file) const { return own() / "reference" / file; }
  /// A file of examples/data, which stands beside the folder of the cases. \throws hydro::InputError if it is absent
  std::filesystem::path example(const std::string& file) const;
  /// A file of the reference data, "iea_sphere/wamit/sphere.1". \throws MissingData if it is absent
  std::filesystem::path shared(const std::string& file) const;

 private:
  std::filesystem::path cases_, data_;
  std::string name_;
};

struct Case {
  std::string name;  ///< of the folder
  Outcome (*run)(const Folders&);
  std::vector<std::string> reference_data = {};  ///< folders from which it takes files by Folders::shared()
};

/// Every case, in the order of the report (cases.cpp); only in builds with FROUDE_VALIDATION_CASES.
const std::vector<Case>& cases();

}  // namespace froude::validation
