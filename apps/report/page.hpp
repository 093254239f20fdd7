#pragma once
/// \file  The page that shows results: made of report/web when the program is built, a part of the program.
#include <string>

#include "report/arrays.hpp"

namespace froude::html {

/// False in a build without npm: there is no page then.
bool has_page();

/// The whole HTML file with these data. Text in it stays text: neither a title nor a name can end an element.
/// \throws hydro::InputError in a build without the page, with how to get one
std::string page_with(const std::string& title, const Json& data);

}  // namespace froude::html
