#include "frontend/macrob/Forms.h"

#include "stdlib/Control.h"

namespace dotek::frontend::macrob {

Forms formsOf(const stdlib::Control& control) {
  const auto& takes = control.functions;
  return {takes.contains("abbreviated_words"), takes.contains("then_optional"),
          takes.contains("parameter_bits"), takes.contains("nested_comments"),
          takes.contains("small_letters")};
}

} // namespace dotek::frontend::macrob
