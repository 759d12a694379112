#include "verify/Compare.h"

namespace dotek::verify {

std::string_view aspectName(Aspect aspect) {
  switch (aspect) {
  case Aspect::Ending: return "ending";
  case Aspect::Path: return "path";
  case Aspect::State: return "state";
  case Aspect::Nominal: return "nominal contact";
  case Aspect::Contact: return "contact";
  case Aspect::Offset: return "work offset";
  case Aspect::Tool: return "tool offset";
  case Aspect::Variable: return "variable";
  case Aspect::End: return "end position";
  case Aspect::Modal: return "modal state";
  case Aspect::Printed: return "printed text";
  }
  return "";
}

} // namespace dotek::verify
