#include "support/Diagnostics.h"

#include <algorithm>

namespace dotek {

std::span<const MessageInfo> messageTable() {
  // No std::array: clang bounds its deduction at 256 elements.
  static const std::vector<MessageInfo> kTable = [] {
    std::vector<MessageInfo> table = {
#define DOTEK_DIAGNOSTIC(Id, codeText, severityId, formatText, explanationText)                              \
  MessageInfo{codeText, Severity::severityId, explanationText},
#include "support/messages/CamFolder.def"
#include "support/messages/ComPost.def"
#include "support/messages/Commands.def"
#include "support/messages/Common.def"
#include "support/messages/Cycle.def"
#include "support/messages/Device.def"
#include "support/messages/Fanuc.def"
#include "support/messages/Fusion.def"
#include "support/messages/Gibbs.def"
#include "support/messages/Lint.def"
#include "support/messages/MacroB.def"
#include "support/messages/Mikroprog.def"
#include "support/messages/Nc.def"
#include "support/messages/Output.def"
#include "support/messages/Part.def"
#include "support/messages/Path.def"
#include "support/messages/Posts.def"
#include "support/messages/Sim.def"
#include "support/messages/Verify.def"
#undef DOTEK_DIAGNOSTIC
    };
    std::sort(table.begin(), table.end(),
              [](const MessageInfo& a, const MessageInfo& b) { return a.code < b.code; });
    return table;
  }();
  return kTable;
}

} // namespace dotek
