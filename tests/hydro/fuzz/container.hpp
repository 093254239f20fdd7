#pragma once
/// \file  Several files as one input of libFuzzer: each begins with a line "=== NAME ===", which mutations may spoil,
/// so that files go missing as well. Bytes before the first such line, or without any, are one file without a name.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace froude_fuzz {

inline constexpr std::string_view mark = "=== ";

/// Appends one file to an input.
inline void pack(std::string& input, const std::string& name, std::string_view bytes) {
  input += std::string(mark) + name + " ===\n";
  input += bytes;
}

/// The files of an input, in a folder of its own as long as this lives.
class Unpacked {
 public:
  explicit Unpacked(std::string_view input) {
    std::string pattern = (std::filesystem::temp_directory_path() / "froude_fuzz_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for files of an input");
    folder_ = pattern;
    while (!input.empty()) input.remove_prefix(write_one(input));
  }
  ~Unpacked() { std::filesystem::remove_all(folder_); }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;

  /// The file that the input names first; the folder where that lies in one (NEMOH).
  std::filesystem::path first() const { return first_.empty() ? folder_ / "x" : first_; }

 private:
  /// Writes the file at the front of `input`; its length there.
  std::size_t write_one(std::string_view input) {
    std::string name = "x";
    std::size_t from = 0;
    if (input.substr(0, mark.size()) == mark) {
      const std::size_t line = input.find('\n');
      const std::string_view head = input.substr(0, line);
      if (const std::size_t close = head.rfind(" ==="); close != head.npos && close > mark.size())
        name = safe(head.substr(mark.size(), close - mark.size()));
      from = line == input.npos ? input.size() : line + 1;
    }
    std::size_t to = input.find(mark, from);
    to = to == input.npos ? input.size() : to;
    write(name, input.substr(from, to - from));
    return to;
  }
  /// Letters, digits, dots and one folder, so that nothing is written elsewhere.
  static std::string safe(std::string_view name) {
    std::string out;
    for (const char c : name.substr(0, 40))
      out += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c
             : c == '/' || c == '.'                                                     ? c
                                                                                        : '_';
    while (out.find("..") != out.npos) out.erase(out.find(".."), 1);
    while (!out.empty() && (out.front() == '/' || out.front() == '.')) out.erase(0, 1);
    while (!out.empty() && (out.back() == '/' || out.back() == '.')) out.pop_back();
    return out.empty() ? "x" : out;
  }
  void write(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = folder_ / name;
    std::error_code exists;
    std::filesystem::create_directories(path.parent_path(), exists);
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (first_.empty()) first_ = name == "Nemoh.cal" ? folder_ : path;
  }

  std::filesystem::path folder_, first_;
};

}  // namespace froude_fuzz
