// A sweep as a table of its cases; the page makes curves and maps of it.
#include <algorithm>
#include <string>
#include <string_view>

#include "hydro/base/error.hpp"
#include "report/contents.hpp"
#include "sweep/store.hpp"
#include "sweep/study.hpp"

namespace froude::html {
namespace {

Json cell_told(const sweep::Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

Json pictures_told(const sweep::Study& study) {
  Json out = Json::array();
  for (const sweep::Picture& p : study.pictures) {
    if (sweep::is_over_time(study, p)) continue;  // of runs, which are reports of their own
    for (const auto& of : p.of) {
      Json one{{"of", of.value}, {"x", p.x.value}};
      if (p.y) one["y"] = p.y->value;
      if (p.by) one["by"] = p.by->value;
      out.push_back(one);
    }
  }
  return out;
}

}  // namespace

std::string without_the_word(std::string warnings) {
  constexpr std::string_view word = "warning: ";
  for (std::size_t at = warnings.find(word); at != std::string::npos; at = warnings.find(word, at))
    warnings.erase(at, word.size());
  return warnings;
}

Json sweep_contents(const std::filesystem::path& folder) {
  const sweep::Store store(folder);
  const sweep::Identity& of = store.identity();
  const auto rows = store.rows();
  const sweep::Study study = sweep::parse_study(of.study, folder / of.name);
  Json out{{"kind", "sweep"}, {"name", folder.filename().string()}, {"title", study.title}, {"scene_text", of.scene}};
  out["study_text"] = of.study;
  const auto in_state = [&](sweep::State state) {
    return std::count_if(rows.begin(), rows.end(), [&](const sweep::Row& row) { return row.state == state; });
  };
  out["cases"] = {{"all", of.cases},
                  {"done", in_state(sweep::State::done)},
                  {"failed", in_state(sweep::State::failed)},
                  {"skipped", in_state(sweep::State::skipped)}};
  out["facts"] = Facts{{"Study", of.name}};
  Json axes = Json::array(), outputs = Json::array(), number = Json::array(), state = Json::array(),
       why = Json::array();
  for (const sweep::Row& row : rows) {
    number.push_back(row.number);
    state.push_back(sweep::name_of(row.state));
    if (!row.reason.empty()) why.push_back({row.number, sweep::name_of(row.state), row.reason});
    if (!row.warnings.empty()) why.push_back({row.number, "warning", without_the_word(row.warnings)});
  }
  for (std::size_t i = 0; i < of.axes.size(); ++i) {
    Json values = Json::array();
    for (const sweep::Row& row : rows) values.push_back(cell_told(row.axes[i]));
    axes.push_back({{"name", of.axes[i].name}, {"unit", of.axes[i].unit}, {"values", values}});
  }
  for (std::size_t i = 0; i < store.columns().size(); ++i) {
    Json values = Json::array();
    for (const sweep::Row& row : rows) values.push_back(row.numbers.empty() ? Json() : cell_told(row.numbers[i]));
    outputs.push_back({{"name", store.columns()[i].name}, {"unit", store.columns()[i].unit}, {"values", values}});
  }
  out.update({{"axes", axes}, {"outputs", outputs}, {"number", number}, {"state", state}, {"why", why}});
  out["pictures"] = pictures_told(study);
  return out;
}

}  // namespace froude::html
