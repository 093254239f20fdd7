#pragma once
/// \file  Private: text files of numbers, read line by line, that know where everything stands.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydro/base/error.hpp"

namespace hydro::potential {

/// The words of a line between blanks, tabs and carriage returns.
std::vector<std::string_view> words_of(std::string_view line);

/// A number as Fortran writes it: a leading plus, and D for the exponent, are allowed; NaN and infinity come through.
std::optional<double> fortran_number(std::string_view word);

/// A text file in lines; lines count from 1, words from 0.
class TextLines {
 public:
  /// \throws InputError if the file cannot be read
  static TextLines read(const std::filesystem::path& path);

  int count() const { return static_cast<int>(lines_.size()); }
  const std::string& line(int number) const { return lines_[static_cast<std::size_t>(number - 1)]; }
  std::vector<std::string_view> words(int number) const { return words_of(line(number)); }
  const std::filesystem::path& path() const { return path_; }

  /// The first line from `from` on that contains `text`, or 0.
  int find(std::string_view text, int from = 1) const;
  bool contains(int number, std::string_view text) const { return line(number).find(text) != std::string::npos; }

  /// A finite number. \throws InputError saying that `what` is needed here, if there is none
  double number(int number, std::size_t word, const std::string& what) const;
  /// A whole number of at least `least`. \throws InputError
  int whole(int number, std::size_t word, const std::string& what, int least) const;
  /// The first `count` words as numbers. \throws InputError
  std::vector<double> numbers(int number, std::size_t count, const std::string& what) const;

  Place place(int number) const;
  Place place(int number, std::size_t word) const;  ///< with the word marked, if there is such a word
  [[noreturn]] void refuse(int number, const std::string& rule, const std::string& remedy = {}) const;
  [[noreturn]] void refuse_end(const std::string& what) const;  ///< the file ends before `what`

 private:
  std::filesystem::path path_;
  std::vector<std::string> lines_;
};

/// Numbers one after another, over the ends of lines.
class NumberStream {
 public:
  NumberStream(const TextLines& text, int first_line) : text_(text), line_(first_line) {}

  /// \throws InputError if the next word is no finite number, or the file ends
  double next(const std::string& what);
  int next_whole(const std::string& what, int least);
  /// True at the end of the file, and where the next word is no number.
  bool at_end_of_numbers();
  /// The line of the next word.
  int line();
  /// The place of the number read last.
  Place place_of_last() const { return text_.place(last_line_, last_word_); }

 private:
  void skip_to_word();
  const TextLines& text_;
  int line_;
  std::size_t word_ = 0;
  int last_line_ = 1;
  std::size_t last_word_ = 0;
};

}  // namespace hydro::potential
