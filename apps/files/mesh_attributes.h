#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "pdc/io/open_input.h"

namespace pdc {

/// \param taken the names that the mesh's vertices are going to have from elsewhere, besides places and normals.
/// \throws Error if two attributes of an input, or one and what is taken, would have one name in a file. Call it before
/// long work.
void checkAttributes(const Input& input, const std::vector<std::string>& taken);

/// Gives a mesh's vertices the attributes of its input. \throws Cancelled.
void addAttributes(const Input& input, Mesh& mesh, const Monitor& monitor);

/// What vertices have that a file by its suffix cannot hold: names, separated by commas. Empty if it can.
[[nodiscard]] std::string lostProperties(const Mesh& mesh, const std::filesystem::path& path);

/// For each property its name, its type and how many numbers a vertex has.
[[nodiscard]] nlohmann::ordered_json propertiesJson(const std::vector<VertexProperty>& properties);

}  // namespace pdc
