#include "project/Inputs.h"

#include "project/Foreign.h"
#include "project/PostShape.h"
#include "support/Files.h"
#include "support/WholeName.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Cycle.h"
#include "support/messages/Posts.h"

#include <algorithm>

namespace dotek::project {

bool refusesStream(const std::string& path, SourceRange where, Session& session) {
  if (!isStream(path)) return false;
  session.diagnostics().report<diag::FileNotReadable>(where, path, "it is no regular file");
  return true;
}

namespace {

// As far as recognise() looks: what an editor holds, else what is in the file.
std::optional<std::string> beginningOf(const std::string& path, const Session& session) {
  if (isStream(path)) return std::nullopt;
  if (const auto& held = session.options().buffers)
    if (const auto at = held->find(wholeName(path)); at != held->end())
      return at->second.substr(0, kRecognisedBytes);
  Diagnostics ignored;
  return readBeginning(path, kRecognisedBytes, ignored);
}

// What concerns a file as a whole is reported at its beginning, so that reports for machines name the file;
// the text is left out, as it may be a picture.
SourceRange wholeFile(const std::string& path, Session& session) {
  return {session.sources().add(SourceFile(inputName(path), "", Encoding::Utf8)), 0, 0};
}

} // namespace

void reportNoInput(const std::string& path, const Recognition& found, Session& session) {
  if (isPost(found)) {
    session.diagnostics().report<diag::PostNotTaken>(wholeFile(path, session), inputName(path));
    return;
  }
  const std::optional<std::string> text = beginningOf(path, session);
  const std::optional<Foreign> foreign = text ? foreignLanguage(*text) : std::nullopt;
  if (!foreign)
    session.diagnostics().report<diag::UnknownKind>(wholeFile(path, session), inputName(path),
                                                    otherwise(found));
  else
    session.diagnostics().report<diag::OtherDialect>(wholeFile(path, session), inputName(path), foreign->name,
                                                     foreign->lines,
                                                     foreign->remedy.empty() ? "" : ": " + foreign->remedy);
}

std::optional<InputKind> kindAmong(const std::string& path, std::initializer_list<InputKind> kinds,
                                   std::string_view expected, Session& session) {
  const Recognition* const found = session.kindOf(path, session.diagnostics(), *kinds.begin());
  if (found == nullptr) return std::nullopt;
  if (!found->kind)
    reportNoInput(path, *found, session);
  else if (std::find(kinds.begin(), kinds.end(), *found->kind) != kinds.end())
    return found->kind;
  else if (found->kind == InputKind::Cycle)
    session.diagnostics().report<diag::CycleNotRun>(wholeFile(path, session), inputName(path));
  else
    session.diagnostics().report<diag::WrongKind>(wholeFile(path, session), inputName(path),
                                                  kindText(*found->kind), expected, kindName(*kinds.begin()));
  return std::nullopt;
}

} // namespace dotek::project
