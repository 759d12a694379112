#include "project/CertainFindings.h"

#include "frontend/nc/Findings.h"
#include "support/messages/ComPost.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>
#include <utility>

namespace dotek::project {
namespace {

// What else a lowering refuses depends on the target, on values that nobody has given yet, or is a rule of
// lint.
constexpr std::array<std::string_view, 22> kCertain = {
    // macros of a cycle
    diag::DivisionByZero::code,
    diag::DomainError::code,
    diag::SystemNameWritten::code,
    diag::AngleUnitOpen::code,
    diag::GoesRoundForEver::code,
    diag::CallTooDeep::code,
    diag::MessagePaths::code,
    diag::ArgsMismatch::code,
    // routines of a Prog
    diag::BooleanAsStatement::code,
    diag::CallsTooDeep::code,
    // blocks that it prints
    diag::LowerCaseAddress::code,
    diag::BareWord::code,
    diag::AddressTwice::code,
    diag::DigitsBesideValue::code,
    diag::MixedBlock::code,
    diag::SyntaxError::code,
    diag::ValueOutOfRange::code,
    diag::TwoFunctions::code,
    diag::DwellForm::code,
    diag::UnexpectedCharacter::code,
    diag::LoopUnbalanced::code,
    frontend::nc::CallWithoutProgram::code,
};

constexpr std::array<std::string_view, 5> kOfForm = {
    diag::CommandNotInForm::code,        diag::NumericNotInForm::code, diag::NoPicture::code,
    diag::PicturePrefixUnverified::code, diag::FormatOfCommand::code,
};

// In the CAM such a macro may be right, or what surrounds the branch in a program makes it so; there is no
// target that it can become.
constexpr std::array<std::string_view, 5> kOfConvert = {
    diag::CamValue::code,        diag::ReadBeforeSet::code,
    diag::JumpOutOfBranch::code, diag::CallUnderIncremental::code,
    diag::ModeNotKnown::code,
};

template <class Codes> bool isIn(std::string_view code, const Codes& codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

} // namespace

void keepCertain(const Diagnostics& from, bool formNamed, Diagnostics& into) {
  for (const Diagnostic& one : from.all())
    if (isIn(one.code, kCertain) || (formNamed && isIn(one.code, kOfForm))) {
      into.add(one);
    } else if (isIn(one.code, kOfConvert)) {
      Diagnostic kept = one;
      kept.severity = std::min(kept.severity, Severity::Warning);
      into.add(std::move(kept));
    }
}

} // namespace dotek::project
