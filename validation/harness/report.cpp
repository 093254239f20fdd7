#include "harness/report.hpp"

#include <algorithm>

#include "hydro/io/atomic_file.hpp"

namespace froude::validation {
namespace {

const Number& find(const Outcome& outcome, const Check& check) {
  for (const Number& number : outcome.numbers)
    if (number.name == check.number) return number;
  std::vector<std::string> names;
  for (const Number& number : outcome.numbers) names.push_back(number.name);
  const std::string near = hydro::nearest(check.number, names);
  throw hydro::InputError(
      fmt::format("the case gives no number \"{}\"", check.number), check.place,
      near.empty() ? fmt::format("it gives {}", fmt::join(names, ", ")) : fmt::format("did you mean \"{}\"?", near));
}

std::vector<Line> judged(const Outcome& outcome, const std::vector<Check>& checks) {
  std::vector<Line> lines;
  for (const Number& number : outcome.numbers) lines.push_back({.number = number, .check = {}});
  for (const Check& check : checks) {
    const Number& number = find(outcome, check);
    Line& line = lines[static_cast<std::size_t>(&number - outcome.numbers.data())];
    line.check = check;
    line.verdict = judge(check, number);
  }
  return lines;
}

std::string uncertainty_text(const Line& line) {
  if (!line.check || !line.check->reference_uncertainty) return "";
  return fmt::format("± {:g}", *line.check->reference_uncertainty);
}

/// Width on a terminal: characters, not bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xC0') != '\x80'; }));
}

std::string padded(const std::string& text, std::size_t wanted) {
  return text + std::string(wanted - std::min(wanted, width(text)), ' ');
}

std::vector<std::string> cells(const Line& line) {
  return {line.number.name,       fmt::format("{:.6g}", line.number.value),
          line.number.unit,       line.check ? rule_text(*line.check) : "",
          uncertainty_text(line), line.check ? verdict_text(line.verdict) : "for information"};
}

const std::vector<std::string> header{"number", "value", "unit", "expected", "reference", "verdict"};

/// README without its title, deeper headings one level down, so that it fits below the heading of the case.
std::string body_of(const std::string& readme) {
  std::string body;
  std::size_t at = 0;
  while (at < readme.size()) {
    const std::size_t end = std::min(readme.find('\n', at), readme.size());
    const std::string_view line(readme.data() + at, end - at);
    if (line.starts_with("## ")) body += "#";
    if (!line.starts_with("# ")) body += std::string(line) + "\n";
    at = end + 1;
  }
  return body;
}

std::string title_of(const CaseReport& report) {
  if (!report.readme.starts_with("# ")) return report.name;
  return report.readme.substr(2, report.readme.find('\n') - 2);
}

bool is_wanted(const Picture& picture, ReferenceCurves curves) {
  return curves == ReferenceCurves::drawn || !picture.shows_reference_curves;
}

std::string markdown_of(const CaseReport& report, const std::string& picture_folder, ReferenceCurves curves) {
  std::string page = fmt::format("\n## {}\n{}\n", title_of(report), body_of(report.readme));
  if (report.skipped) return page + fmt::format("**Skipped, no data:** {}\n", *report.skipped);
  if (report.broken) return page + fmt::format("**Broken:** {}\n", *report.broken);
  page += fmt::format("| {} | because |\n|{}\n", fmt::join(header, " | "),
                      std::string(" --- |") + " --- | --- | --- | --- | --- | --- |");
  for (const Line& line : report.lines)
    page += fmt::format("| {} | {} |\n", fmt::join(cells(line), " | "), line.check ? line.check->because : "");
  for (const Line& line : report.lines)
    if (line.check && line.check->fails)
      page += fmt::format("\n**Known failure, {}:** {}\n", line.number.name, *line.check->fails);
  for (const Picture& picture : report.pictures)
    if (is_wanted(picture, curves))
      page +=
          fmt::format("\n![{0}]({1}/{2}-{3}.svg)\n\n{0}\n", picture.caption, picture_folder, report.name, picture.name);
  return page;
}

}  // namespace

CaseReport run_case(const Case& the_case, const Folders& folders) {
  const std::vector<Check> checks = read_checks(folders.own() / "accept.toml");
  CaseReport report{.name = the_case.name, .readme = hydro::io::read_text(folders.own() / "README.md")};
  Outcome outcome;
  try {
    outcome = the_case.run(folders);
  } catch (const MissingData& missing) {
    report.skipped = missing.what();
    return report;
  } catch (const std::exception& error) {
    report.broken = error.what();
    return report;
  }
  report.lines = judged(outcome, checks);
  report.pictures = std::move(outcome.pictures);
  return report;
}

Tally tally(const std::vector<CaseReport>& reports) {
  Tally sum;
  for (const CaseReport& report : reports) {
    sum.cases_skipped += report.skipped.has_value();
    sum.cases_broken += report.broken.has_value();
    for (const Line& line : report.lines) {
      if (!line.check) continue;
      sum.passed += line.verdict == Verdict::pass;
      sum.known_failures += line.verdict == Verdict::known_failure;
      sum.failed += line.verdict == Verdict::fail || line.verdict == Verdict::unexpected_pass;
    }
  }
  return sum;
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "passed";
    case Verdict::fail:
      return "FAILED";
    case Verdict::known_failure:
      return "FAILED (known)";
    case Verdict::unexpected_pass:
      return "FAILED: passes, but is marked as failing";
  }
  return {};
}

std::string as_text(const CaseReport& report) {
  std::string text = fmt::format("{}: {}\n", report.name, title_of(report));
  if (report.skipped) return text + fmt::format("  skipped, no data: {}\n", *report.skipped);
  if (report.broken) return text + fmt::format("  BROKEN: {}\n", *report.broken);
  std::vector<std::vector<std::string>> table{header};
  for (const Line& line : report.lines) table.push_back(cells(line));
  std::vector<std::size_t> widths(header.size(), 0);
  for (const auto& row : table)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  for (const auto& row : table) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) line += " " + padded(row[c], widths[c] + 1);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const Line& line : report.lines)
    if (line.check && line.check->fails)
      text += fmt::format("  known failure, {}: {}\n", line.number.name, *line.check->fails);
  return text;
}

std::string summary(const Tally& sum) {
  const auto counted = [](int count, std::string_view one, std::string_view many) {
    return count == 0 ? "" : fmt::format(", {} {}", count, count == 1 ? one : many);
  };
  return fmt::format("{} passed, {} failed", sum.passed, sum.failed) +
         counted(sum.known_failures, "known failure", "known failures") +
         counted(sum.cases_broken, "case broken", "cases broken") +
         counted(sum.cases_skipped, "case skipped for want of data", "cases skipped for want of data");
}

void write_page(const std::vector<CaseReport>& reports, const std::filesystem::path& page, ReferenceCurves curves) {
  const std::filesystem::path folder = page.parent_path() / page.stem();
  std::string text = fmt::format(
      "# Validation\n\nWritten by `froude validate --page`; limits and their reasons stand in "
      "`validation/*/accept.toml`.{}\n\n{}.\n",
      curves == ReferenceCurves::drawn ? ""
                                       : " Pictures that show reference curves\nwhich are not ours are left out; "
                                         "`--reference-curves` draws them where the reference data are.",
      summary(tally(reports)));
  for (const CaseReport& report : reports) {
    text += markdown_of(report, page.stem().string(), curves);
    for (const Picture& picture : report.pictures) {
      if (!is_wanted(picture, curves)) continue;
      std::filesystem::create_directories(folder);
      hydro::io::write_atomically(folder / (report.name + "-" + picture.name + ".svg"), plot::svg(picture.figure));
    }
  }
  hydro::io::write_atomically(page, text);
}

}  // namespace froude::validation
