#include "frontend/gibbs/Ast.h"
#include "support/Ascii.h"

namespace dotek::frontend::gibbs {

std::string foldCase(const std::string& name) {
  return upperCase(std::string_view(name));
}

} // namespace dotek::frontend::gibbs
