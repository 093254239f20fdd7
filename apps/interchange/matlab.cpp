#include "interchange/matlab.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <memory>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "interchange/temporary.hpp"

namespace froude::interchange {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 63;
constexpr std::array words_of_the_language{
    "break",  "case", "catch",     "classdef", "continue",   "else",   "elseif", "end",    "for", "function",
    "global", "if",   "otherwise", "parfor",   "persistent", "return", "spmd",   "switch", "try", "while"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// MATLAB's characters are of 16 bits. The text is UTF-8; what is none stands as U+FFFD.
std::u16string in_utf16(const std::string& text) {
  constexpr char32_t replacement = 0xFFFD;
  std::u16string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const std::size_t more = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : 9;
    char32_t code = more == 9 ? replacement : more == 0 ? first : first & (0x3FU >> more);
    for (std::size_t k = 0; more != 9 && k < more; ++k) {
      const bool follows = i < text.size() && static_cast<unsigned char>(text[i]) >> 6 == 2;
      if (!follows) {
        code = replacement;
        break;
      }
      code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3F);
    }
    if (code < 0x10000) {
      out += static_cast<char16_t>(code);
    } else {
      out += static_cast<char16_t>(0xD800 + ((code - 0x10000) >> 10));
      out += static_cast<char16_t>(0xDC00 + ((code - 0x10000) & 0x3FF));
    }
  }
  return out;
}

struct Freed {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Freed>;

Variable made(matvar_t* variable) {
  if (variable == nullptr) throw std::bad_alloc();
  return Variable(variable);
}

Variable text_of(const std::string& text) {
  std::u16string wide = in_utf16(text);
  std::array<std::size_t, 2> size{wide.empty() ? 0U : 1U, wide.size()};
  return made(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, size.data(), wide.data(), 0));
}

/// MATLAB's first axis is the fastest, and a vector is a column.
std::vector<std::size_t> size_of(const Array& a) {
  std::vector<std::size_t> out(a.shape.rbegin(), a.shape.rend());
  while (out.size() < 2) out.push_back(1);
  return out;
}

Variable value_of(const Array& a) {
  std::vector<std::size_t> size = size_of(a);
  const auto rank = static_cast<int>(size.size());
  if (!a.texts.empty()) {
    Variable cells = made(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, rank, size.data(), nullptr, 0));
    for (std::size_t i = 0; i < a.texts.size(); ++i)
      Mat_VarSetCell(cells.get(), static_cast<int>(i), text_of(a.texts[i]).release());
    return cells;
  }
  if (a.amplitudes.empty())
    return made(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, rank, size.data(),
                              const_cast<double*>(a.values.data()), 0));  // copied
  std::vector<double> re, im;
  for (const auto& z : a.amplitudes) re.push_back(z.real()), im.push_back(z.imag());
  mat_complex_split_t parts{re.data(), im.data()};
  return made(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, rank, size.data(), &parts, MAT_F_COMPLEX));
}

Variable struct_of(const std::string& name, std::vector<std::pair<std::string, Variable>> fields) {
  std::vector<const char*> names;
  for (const auto& field : fields) names.push_back(field.first.c_str());
  names.push_back(nullptr);
  const std::array<std::size_t, 2> one{1, 1};
  Variable out = made(Mat_VarCreateStruct2(name.c_str(), 2, one.data(), names.data()));
  for (auto& field : fields) Mat_VarSetStructFieldByName(out.get(), field.first.c_str(), 0, field.second.release());
  return out;
}

Variable variable_of(const Array& a, const std::string& name) {
  std::vector<std::pair<std::string, Variable>> fields;
  fields.emplace_back("value", value_of(a));
  const std::vector<std::string> along(a.along.rbegin(), a.along.rend());
  for (const auto& [field, text] :
       {std::pair("unit", a.unit), std::pair("name", a.name), std::pair("meaning", a.meaning),
        std::pair("along", fmt::format("{}", fmt::join(along, ", ")))})
    fields.emplace_back(field, text_of(text));
  return struct_of(name, std::move(fields));
}

Variable variable_of(const Content& content, const std::string& name) {
  std::vector<std::pair<std::string, Variable>> fields;
  std::set<std::string> taken;
  if (!content.kind.empty()) fields.emplace_back("kind", text_of(content.kind)), taken.insert("kind");
  for (const auto& [fact, text] : content.facts) fields.emplace_back(matlab_name(fact, taken), text_of(text));
  return struct_of(name, std::move(fields));
}

/// matio tells of failures by what it returns; on standard error nobody waits for them.
void tell_nobody(int, char*) {}

void write_all(const fs::path& path, const std::vector<Variable>& variables) {
  const std::string header = fmt::format("MATLAB 7.3 MAT-file, written by froude {}", FROUDE_VERSION);
  const std::unique_ptr<mat_t, int (*)(mat_t*)> file(Mat_CreateVer(path.c_str(), header.c_str(), MAT_FT_MAT73),
                                                     &Mat_Close);
  bool written = file != nullptr;
  for (const Variable& variable : variables)
    written = written && Mat_VarWrite(file.get(), variable.get(), MAT_COMPRESSION_ZLIB) == 0;
  if (!written)
    throw hydro::InputError("cannot write the MATLAB file to the folder of temporary files",
                            {.file = path.parent_path().string()}, "is there room? TMPDIR names another folder");
}

}  // namespace

std::string matlab_name(const std::string& name, std::set<std::string>& taken) {
  std::string out;
  for (const char c : name) {
    if (static_cast<unsigned char>(c) >> 6 == 2) continue;  // the rest of a character of several bytes
    out += is_letter(c) || is_digit(c) ? c : '_';
  }
  const auto& words = words_of_the_language;
  if (out.empty() || !is_letter(out.front()) || std::find(words.begin(), words.end(), out) != words.end())
    out = 'x' + out;
  out.resize(std::min(out.size(), longest_name));
  std::string unique = out;
  for (int i = 2; !taken.insert(unique).second; ++i) {
    const std::string number = fmt::format("_{}", i);
    unique = out.substr(0, longest_name - number.size()) + number;
  }
  return unique;
}

void write_matlab(const fs::path& path, const Content& content) {
  Mat_LogInitFunc("froude", tell_nobody);
  std::set<std::string> taken;
  std::vector<Variable> variables;
  variables.push_back(variable_of(content, matlab_name("froude", taken)));
  for (const Array& a : content.arrays) variables.push_back(variable_of(a, matlab_name(a.name, taken)));
  const TemporaryFolder folder;
  const fs::path whole = folder.path() / "result.mat";
  write_all(whole, variables);
  variables.clear();
  hydro::io::write_atomically(path, hydro::io::read_text(whole));
}

}  // namespace froude::interchange
