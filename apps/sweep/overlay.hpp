#pragma once
/// \file  Tables drawn upon a picture of a study: points of another source, or boundaries.
#include <vector>

#include "answers/plot.hpp"
#include "sweep/cases.hpp"
#include "sweep/study.hpp"

namespace froude::sweep {

/// Before the first case, so that no sweep ends at its picture: the tables are there, with their columns.
/// \throws hydro::InputError at the key of a file that is not there, and in the table at a column that is not there or
/// no number
void check_overlays(const Picture& picture);

/// What a picture has upon it, in the units of its axes. Rows of a table are points in their order; where the text or
/// number under `by` is another than in the row before, a new curve begins, and only the first of a name stands in the
/// legend. Upon a map they are red, the second and every other name dashed.
/// \throws hydro::InputError where a column is of another dimension than its axis
std::vector<plot::Series> overlays_of(const Picture& picture, const Column& x, const Column& y);

}  // namespace froude::sweep
