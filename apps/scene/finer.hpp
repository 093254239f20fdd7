#pragma once
/// \file  Lines cut into segments: as the scene says, and into more, to see what the cut does to the answers. (E4)
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace froude::scene {

/// The segments of a line's even parts, with what grows on them.
std::vector<dynamics::line::Segment> cut(const Line& line);

/// True if segments stand for a line that is even: not where its links are listed, nor where every node has a bob,
/// which are what the scene says.
bool is_approximated(const Line& line);
bool approximates_lines(const Scene& scene);

/// Each segment of such lines cut into `times`, and what acts at each of their nodes spread over as many more. What its
/// run is asked for keeps the names of nodes and links: names_where_finer() has those that they get.
Scene with_finer_lines(Scene scene, int times);

/// The signals of that scene of which one of `scene` is the mean: that of node 4 is that of node 8, that of link 4 the
/// mean of those of links 7 and 8; all others have their names.
std::vector<std::string> names_where_finer(const Scene& scene, int times, const std::string& signal);

}  // namespace froude::scene
