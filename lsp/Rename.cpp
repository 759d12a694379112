// Renaming: which names, to what, and at which places.
#include "frontend/cycle/Kinds.h"
#include "frontend/cycle/Words.h"
#include "frontend/fusion/Tokens.h"
#include "lsp/Uses.h"
#include "project/Session.h"
#include "support/Ascii.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::lsp {

namespace {

Place renamePlace(Workspace& workspace, const Json& params) {
  const std::optional<Place> place = placeIn(workspace, params);
  if (!place) throw Refusal{kRequestFailed, "the text is in no language that Dotek reads"};
  return *place;
}

// What a name's occurrence holds beside the name itself: the N of a block, the # of a variable.
std::string prefixOf(const Index& index, const Occurrence& one) {
  const std::string text = index.sources.textUtf8(one.range);
  // Of Mikroprog the L of a jump.
  if (one.key.starts_with("N ") && !text.empty() && isLetter(text.front())) return text.substr(0, 1);
  return "";
}

const Occurrence& renamed(const Place& place) {
  const Occurrence* const one = place.index->at(place.offset);
  if (one == nullptr) throw Refusal{kRequestFailed, "no name is here"};
  const auto& may = place.index->renamable;
  if (std::find(may.begin(), may.end(), one->key) == may.end())
    throw Refusal{
        kRequestFailed,
        "this name is known outside of what is open: the control, the CAM or another program may use it"};
  if (one->key.starts_with("N ") && place.index->computedJumps)
    throw Refusal{kRequestFailed, "a jump of this file computes its block number, so no number is renamed"};
  return *one;
}

// A name that the language has another use for.
bool isWord(const Index& index, const std::string& name, const driver::CommonOptions& options) {
  using project::InputKind;
  if (!index.kind) return frontend::fusion::isReserved(name);
  project::Session session(options);
  switch (*index.kind) {
  case InputKind::Cycle: {
    frontend::cycle::Symbols hosts;
    frontend::cycle::addHosts(hosts);
    return frontend::cycle::isReserved(name) || hosts.contains(name);
  }
  case InputKind::Prog: {
    // Whether case matters is not known.
    const stdlib::ComPostKeywords& keywords = session.compostKeywords();
    return keywords.find(name) != nullptr || !keywords.caseVariant(name).empty() ||
           keywords.isEntryPoint(name);
  }
  case InputKind::Macro:
  case InputKind::Dialog:
  case InputKind::DefineData:
    return session.gibbsKeywords().isCore(name) || session.gibbsKeywords().isCommand(name);
  case InputKind::Nc:
  case InputKind::Suf: return false; // numbers alone are renamed
  }
  return false;
}

void checkNumber(const Occurrence& one, const std::string& name, const Index& index) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || name.size() > 9 || !std::all_of(name.begin(), name.end(), isDigit))
    throw Refusal{kRequestFailed, "a block number has digits only"};
  const std::uint32_t number = static_cast<std::uint32_t>(std::stoul(name));
  if (number == 0 || number > index.lastBlock)
    throw Refusal{kRequestFailed, fmt::format("a block number is 1 to {} here", index.lastBlock)};
  const std::string key = fmt::format("{}{}", one.key.substr(0, one.key.rfind(' ') + 1), number);
  for (const Occurrence& other : index.occurrences)
    if (other.key == key && key != one.key)
      throw Refusal{kRequestFailed, fmt::format("`{}` is in use", number)};
}

void checkName(const Occurrence& one, const std::string& name, const Index& index,
               const driver::CommonOptions& options) {
  if (one.key.starts_with("N ")) return checkNumber(one, name, index);
  const auto isPart = [](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || name.size() > 60 || !std::all_of(name.begin(), name.end(), isPart) ||
      (name.front() >= '0' && name.front() <= '9'))
    throw Refusal{kRequestFailed, "a name has letters, digits and `_`, and begins with no digit"};
  const bool cycle = index.kind == project::InputKind::Cycle;
  if (cycle && !frontend::cycle::isName(name))
    throw Refusal{kRequestFailed, "a name of a cycle has small letters, digits and `_`: `" +
                                      frontend::cycle::proposeName(name) + "`"};
  if (isWord(index, name, options)) throw Refusal{kRequestFailed, "`" + name + "` is a word of the language"};
  // The CAM reads names without case, and of a post nobody knows.
  const bool folds = index.kind && !cycle;
  const std::string key = one.key.substr(0, one.key.rfind(' ') + 1) + name;
  const auto isSame = [&](const std::string& a, const std::string& b) {
    return folds ? upperCase(a) == upperCase(b) : a == b;
  };
  bool taken = index.taken.contains(name);
  for (const Occurrence& other : index.occurrences)
    taken = taken || (isSame(other.key, key) && other.key != one.key);
  if (taken) throw Refusal{kRequestFailed, "`" + name + "` is in use"};
}

} // namespace

Json prepareRename(Workspace& workspace, const Json& params) {
  const Place place = renamePlace(workspace, params);
  const Occurrence& one = renamed(place);
  SourceRange range = one.range;
  range.begin += static_cast<std::uint32_t>(prefixOf(*place.index, one).size());
  return {{"range", rangeOf(place.index->text(), range, workspace.units)},
          {"placeholder", place.index->sources.textUtf8(range)}};
}

Json rename(Workspace& workspace, const Json& params) {
  const Place place = renamePlace(workspace, params);
  const Occurrence& one = renamed(place);
  const std::string name = params.value("newName", "");
  checkName(one, name, *place.index, workspace.options({place.document->path}));
  Json changes = Json::object();
  for (const Use& use : usesOf(workspace, *place.document, one))
    changes[use.uri].push_back({{"range", rangeOf(use.index->text(), use.occurrence->range, workspace.units)},
                                {"newText", prefixOf(*use.index, *use.occurrence) + name}});
  return {{"changes", changes}};
}

} // namespace dotek::lsp
