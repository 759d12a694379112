#include "frontend/compost/Repair.h"

#include "frontend/compost/Summary.h"
#include "support/messages/ComPost.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <string>

namespace dotek::frontend::compost {

namespace {

using Ids = std::set<std::string>;

// The first IF on another cycle than `own` directly in `body`: as an inner branch it would never run.
const If* otherCycle(const std::vector<Statement>& body, const Ids& own) {
  for (const Statement& statement : body) {
    const auto* inner = std::get_if<std::unique_ptr<If>>(&statement);
    if (inner == nullptr) continue;
    const std::optional<Ids> ids = cyclesOf((*inner)->condition);
    if (!ids) continue;
    const bool shared =
        std::any_of(ids->begin(), ids->end(), [&](const std::string& id) { return own.contains(id); });
    if (!shared) return inner->get();
  }
  return nullptr;
}

// The IF before which the END may belong as well as at the end of the routine.
const If* rivalOf(const If& open) {
  const std::optional<Ids> own = cyclesOf(open.condition);
  if (!own) return nullptr;
  if (const If* inner = otherCycle(open.thenBody, *own)) return inner;
  const If* inner = otherCycle(open.elseBody, *own);
  // Last in ELSE, it runs for the same operations wherever the END is.
  if (inner != nullptr && std::get_if<std::unique_ptr<If>>(&open.elseBody.back()) != nullptr &&
      std::get<std::unique_ptr<If>>(open.elseBody.back()).get() == inner)
    return nullptr;
  return inner;
}

// Blanks before a word that begins its line; nothing where other words are before it.
std::optional<std::string_view> indentOf(SourceRange word, const SourceFile& source) {
  const std::uint32_t begin = source.lineStart(source.lineOf(word.begin));
  const std::string_view before = std::string_view(source.bytes()).substr(begin, word.begin - begin);
  if (before.find_first_not_of(" \t") != std::string_view::npos) return std::nullopt;
  return before;
}

// An inner IF whose END is laid out as that of the open IF: then the END of the inner one is missing, and
// what follows it would move from one branch to the other.
const If* borrowerOf(const std::vector<Statement>& body, std::string_view openIndent,
                     const SourceFile& source) {
  for (const Statement& statement : body) {
    const auto* inner = std::get_if<std::unique_ptr<If>>(&statement);
    if (inner == nullptr) continue;
    if ((*inner)->endRange) {
      const auto own = indentOf((*inner)->ifRange, source);
      const auto end = indentOf(*(*inner)->endRange, source);
      if (own && end && *own != openIndent && *end == openIndent) return inner->get();
    }
    for (const auto* part : {&(*inner)->thenBody, &(*inner)->elseBody}) {
      if (const If* found = borrowerOf(*part, openIndent, source)) return found;
    }
  }
  return nullptr;
}

const If* borrowerOf(const If& open, const SourceFile& source) {
  const auto indent = indentOf(open.ifRange, source);
  if (!indent) return nullptr;
  const If* found = borrowerOf(open.thenBody, *indent, source);
  return found != nullptr ? found : borrowerOf(open.elseBody, *indent, source);
}

std::string lineEndOf(const SourceFile& source) {
  const std::size_t at = source.bytes().find_first_of("\r\n");
  if (at == std::string::npos || source.bytes()[at] == '\n') return "\n";
  return source.bytes().compare(at, 2, "\r\n") == 0 ? "\r\n" : "\r";
}

Fix insertion(std::string_view keyword, const RoutineEnd& end, const SourceFile& source, FileId file) {
  const std::uint32_t at = end.insertionPoint;
  const std::uint32_t line = source.lineOf(at);
  const bool lineStart = source.lineStart(line) == at;
  std::string text(keyword);
  std::string title;
  if (at == source.bytes().size()) {
    text = (lineStart ? "" : lineEndOf(source)) + text + lineEndOf(source);
    title = fmt::format("insert {} at the end of the file", keyword);
  } else if (lineStart) {
    text += lineEndOf(source);
    title = fmt::format("insert {} before line {}", keyword, line);
  } else {
    text += ' ';
    title = fmt::format("insert {} in line {} before {}", keyword, line,
                        end.at == RoutineEnd::At::Return ? "RETURN" : "the label");
  }
  return {Fix::Applicability::Display, std::move(title), {Edit{{file, at, at}, std::move(text)}}};
}

} // namespace

std::vector<Diagnostic> reportMissingEnds(const Routine& routine, const std::vector<const If*>& openIfs,
                                          const RoutineEnd& end, std::optional<SourceRange> strayEnd,
                                          const SourceMap& sources) {
  const FileId file = routine.range.file;
  const SourceFile& source = sources.file(file);
  std::vector<Diagnostic> found;
  const std::uint32_t endLine = source.lineOf(end.range.begin);
  const std::string what =
      end.at == RoutineEnd::At::Return ? fmt::format("`RETURN` in line {}", endLine)
      : end.at == RoutineEnd::At::Label
          ? fmt::format("the label `{}` in line {}", sources.textUtf8(end.range), endLine)
          : std::string("the end of the file");
  for (const If* open : openIfs) {
    Diagnostic diagnostic = makeDiagnostic<diag::OpenIfAtReturn>(open->ifRange, what);
    diagnostic.note(end.range, end.at == RoutineEnd::At::Return  ? "the routine returns here"
                               : end.at == RoutineEnd::At::Label ? "the next routine begins here"
                                                                 : "the file ends here");
    if (strayEnd) {
      diagnostic.note(
          *strayEnd,
          "an `END` or `ELSE` follows the `RETURN`: the `RETURN` may be meant to leave the routine "
          "early, which is not known to work; no repair is offered");
    } else if (const If* rival = rivalOf(*open)) {
      const bool inThen = !open->elseRange || rival->ifRange.begin < open->elseRange->begin;
      diagnostic.note(
          rival->ifRange,
          fmt::format("with `END` at the end of the routine, this `IF` on another cycle {}; the `END` may "
                      "belong before line {}; no repair is offered",
                      inThen ? "is inside the open one and is never reached"
                             : "and all after it run in the `ELSE` part only",
                      source.lineOf(rival->ifRange.begin)));
    } else if (const If* borrower = borrowerOf(*open, source)) {
      diagnostic.note(
          *borrower->endRange,
          fmt::format("this `END` closes the `IF` in line {}, but is laid out as that of the open one; "
                      "the `END` of line {} may be missing instead; no repair is offered",
                      source.lineOf(borrower->ifRange.begin), source.lineOf(borrower->ifRange.begin)));
    } else if (end.at != RoutineEnd::At::EndOfFile) {
      diagnostic.fix = insertion("END", end, source, file);
    }
    found.push_back(std::move(diagnostic));
  }
  if (end.at != RoutineEnd::At::Return) {
    Diagnostic diagnostic =
        makeDiagnostic<diag::MissingReturn>(routine.nameRange, sources.textUtf8(routine.nameRange), what);
    // A file that ends inside a branch or a line may be a part of the file that was meant.
    const bool cutOff =
        end.at == RoutineEnd::At::EndOfFile &&
        (!openIfs.empty() || source.bytes().find_last_of("\r\n") + 1 != source.bytes().size());
    if (cutOff)
      diagnostic.note(end.range, "the file ends here and may be cut off; no repair is offered");
    else
      diagnostic.fix = insertion("RETURN", end, source, file);
    found.push_back(std::move(diagnostic));
  }
  return found;
}

} // namespace dotek::frontend::compost
