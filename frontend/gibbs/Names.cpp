#include "frontend/gibbs/Ast.h"

namespace dotek::frontend::gibbs {

std::string foldCase(const std::string& name) {
  std::string folded = name;
  for (char& c : folded)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return folded;
}

} // namespace dotek::frontend::gibbs
