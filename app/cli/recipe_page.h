#pragma once
// docs/recipe.md: every setting of a recipe, from the table that reads and checks them.

#include <string>

namespace prt::cli {

/// The page as Markdown; `prt bake --help-all` prints it and `./dev docs` keeps it in docs/.
std::string recipePage();

}  // namespace prt::cli
