#pragma once
/// \file  Results as MATLAB files of version 7.3, which are HDF5.
#include <filesystem>
#include <set>
#include <string>

#include "interchange/content.hpp"

namespace froude::interchange {

/// A name that MATLAB takes, other than those `taken`, to which it is added: what is no letter, digit or underscore
/// becomes an underscore; before what does not begin with a letter, and before a word of the language, stands an x; 63
/// characters are kept; where that name is taken already a number follows, from _2.
std::string matlab_name(const std::string& name, std::set<std::string>& taken);

/// Each array is a struct with fields value, unit, name, meaning and along; a column vector along one axis; of several
/// the fastest axis is MATLAB's first, and `along` tells them in that order. `froude` is a struct of facts.
/// \throws hydro::InputError if the file cannot be written
void write_matlab(const std::filesystem::path& path, const Content& content);

}  // namespace froude::interchange
