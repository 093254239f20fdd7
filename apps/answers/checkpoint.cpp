#include "answers/checkpoint.hpp"

#include <fmt/format.h>

#include <system_error>

#include "hydro/base/digest.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".checkpoint";
constexpr std::string_view first_line = "froude checkpoint, layout 1\n";

std::string line_of(const std::string& what, const std::string& bytes) {
  return fmt::format("{} {:016x}\n", what, hydro::digest(bytes));
}

/// Takes the text up to the end of its line away. Empty where there is none.
std::string_view take_line(std::string_view& text) {
  const auto end = text.find('\n');
  const std::string_view line = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  text.remove_prefix(line.size());
  return line;
}

[[noreturn]] void refuse_file(const fs::path& file, const std::string& why) {
  throw hydro::InputError(why, {.file = file.string()},
                          fmt::format("remove the folder {} to begin the run anew", file.parent_path().string()));
}

/// The first line in which two descriptions differ, without its digest, says what is another.
std::string_view what_differs(std::string_view mine, std::string_view other) {
  while (!mine.empty()) {
    const std::string_view line = take_line(mine);
    if (line != take_line(other)) return line.substr(0, line.rfind(' '));
  }
  return "data: a file more";
}

}  // namespace

Checkpoints::Checkpoints(fs::path folder, const scene::Scene& scene, const std::vector<fs::path>& data)
    : folder_(std::move(folder)) {
  made_by_ = fmt::format("version of froude: {}\n", FROUDE_VERSION) + line_of("scene:", scene.text);
  for (const fs::path& file : data)
    made_by_ += line_of(fmt::format("data: {}", file.filename().string()), hydro::io::read_text(file));
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (entry.path().extension() == extension) state_in(entry.path());
}

fs::path Checkpoints::file_of(const std::string& run) const { return folder_ / (run + std::string(extension)); }

std::string Checkpoints::state_in(const fs::path& file) const {
  const std::string whole = hydro::io::read_text(file);
  std::string_view rest = whole;
  if (take_line(rest) != first_line)
    refuse_file(file, "this is no checkpoint of this program, or its begin is damaged");
  const auto blank = rest.find("\n\n");
  if (blank == std::string_view::npos) refuse_file(file, "the checkpoint is damaged: its description has no end");
  const std::string_view made_by = rest.substr(0, blank + 1);
  rest.remove_prefix(blank + 2);
  if (made_by != made_by_)
    refuse_file(file, fmt::format("the checkpoint was made by another run: it differs in \"{}\"",
                                  what_differs(made_by_, made_by)));
  const std::string_view digest = take_line(rest);
  std::string state(rest);
  if (digest != line_of("state:", state))
    refuse_file(file, "the checkpoint is damaged: its bytes are not those written");
  return state;
}

std::optional<std::string> Checkpoints::find(const std::string& run) const {
  const fs::path file = file_of(run);
  if (std::error_code none; !fs::exists(file, none)) return std::nullopt;
  return state_in(file);
}

void Checkpoints::keep(const std::string& run, const std::string& state) const {
  std::error_code why;
  fs::create_directories(folder_, why);
  if (why)
    throw hydro::InputError(fmt::format("no folder for checkpoints can be made here: {}", why.message()),
                            {.file = folder_.string()}, "give the result (-o) a folder that can be written");
  hydro::io::write_atomically(file_of(run),
                              std::string(first_line) + made_by_ + "\n" + line_of("state:", state) + state);
}

void Checkpoints::refuse(const std::string& run) const {
  refuse_file(file_of(run), "the checkpoint is of a run of another shape");
}

void Checkpoints::remove() const {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (entry.path().extension() == extension) fs::remove(entry.path(), none);
  fs::remove(folder_, none);  // with anything else in it, it stays
}

void Checkpoints::went_on(const std::string& run, double time_s) {
  const std::lock_guard lock(mutex_);
  sentences_.push_back(fmt::format("{} went on from its checkpoint at {:.6g} s", run, time_s));
}

std::vector<std::string> Checkpoints::sentences() const {
  const std::lock_guard lock(mutex_);
  return sentences_;
}

}  // namespace froude
