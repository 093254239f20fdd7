#pragma once
/// \file  Force elements of one's own in scenes: froude::on_bodies() and froude::add_element().
#include "scene/element.hpp"
