#include "report/page.hpp"

#include <string_view>

#include "answers/plot.hpp"
#include "hydro/base/error.hpp"

#ifdef FROUDE_REPORT_PAGE
// The assembler puts the file here as it is: no compiler has to read a megabyte of numbers.
asm(".section .rodata\n"
    ".balign 16\n"
    ".global froude_report_page_begin\n"
    "froude_report_page_begin:\n"
    ".incbin \"" FROUDE_REPORT_PAGE
    "\"\n"
    ".global froude_report_page_end\n"
    "froude_report_page_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" const char froude_report_page_begin[], froude_report_page_end[];
#endif

namespace froude::html {
namespace {

std::string_view bundled_page() {
#ifdef FROUDE_REPORT_PAGE
  return {froude_report_page_begin, static_cast<std::size_t>(froude_report_page_end - froude_report_page_begin)};
#else
  return {};
#endif
}

/// JSON that may stand in a <script>: no tag and no comment can begin in it.
std::string in_script(const Json& data) {
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

}  // namespace

bool has_page() { return !bundled_page().empty(); }

std::string page_with(const std::string& title, const Json& data) {
  if (!has_page())
    throw hydro::InputError(
        "this build of froude has no reports", {},
        "run `scripts/setup report`, configure with -DFROUDE_REPORTS=ON and build again: npm brings what "
        "draws them");
  constexpr std::string_view title_mark = "froude-title", data_mark = "froude-data";
  const std::string_view page = bundled_page();
  const std::size_t at_title = page.find(title_mark), at_data = page.find(data_mark);
  hydro::ensure(at_title < at_data && at_data != std::string_view::npos, "the page has a place for title and data");
  std::string out(page.substr(0, at_title));
  out += plot::escaped(title);
  out += page.substr(at_title + title_mark.size(), at_data - at_title - title_mark.size());
  out += in_script(data);
  out += page.substr(at_data + data_mark.size());
  return out;
}

}  // namespace froude::html
