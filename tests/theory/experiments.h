#pragma once
// What theory says about the rates, and what our coder makes of it: one chapter of docs/theory.md each.

#include <filesystem>
#include <string>

namespace tutte::theory {

std::string regularMeshes();
std::string duals();
std::string uniformTriangulations();
std::string uniformPolyhedra();
std::string semiRegularMeshes();
std::string adaptiveTessellations();

/// Of all models in a folder: what contexts are worth, by size.
std::string gainOfContexts(const std::filesystem::path& corpus);

}  // namespace tutte::theory
