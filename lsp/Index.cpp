#include "lsp/Index.h"

#include "project/PostShape.h"
#include "project/Session.h"
#include "project/Settings.h"

#include <algorithm>

namespace dotek::lsp {
namespace {

Encoding encodingOf(project::InputKind kind) {
  switch (kind) {
  case project::InputKind::Suf: return Encoding::Cp852;
  case project::InputKind::Cycle: return Encoding::Utf8;
  default: return Encoding::Cp1250;
  }
}

void sortByPlace(Index& index) {
  const auto before = [](const auto& a, const auto& b) {
    return std::pair(a.range.begin, a.range.end) < std::pair(b.range.begin, b.range.end);
  };
  std::stable_sort(index.occurrences.begin(), index.occurrences.end(), before);
  std::stable_sort(index.facts.begin(), index.facts.end(), before);
}

void indexByKind(Index& index, project::Session& session, const std::string& path) {
  switch (*index.kind) {
  case project::InputKind::Nc: indexMacroB(index, session, path); break;
  case project::InputKind::Prog: indexComPost(index, session); break;
  case project::InputKind::Macro:
  case project::InputKind::Dialog:
  case project::InputKind::DefineData: indexGibbs(index, session, path); break;
  case project::InputKind::Cycle: indexCycle(index, session, path); break;
  case project::InputKind::Suf: indexMikroprog(index, session, path); break;
  }
}

} // namespace

const Occurrence* Index::at(std::uint32_t offset) const {
  const Occurrence* best = nullptr;
  for (const Occurrence& one : occurrences) {
    if (one.range.begin > offset) break;
    if (offset > one.range.end) continue;
    // Of two that meet the cursor lies in the one that it begins.
    if (best == nullptr || one.range.end - one.range.begin <= best->range.end - best->range.begin)
      best = &one;
  }
  return best;
}

std::size_t Index::programAt(std::uint32_t offset) const {
  const auto after = std::upper_bound(programs.begin(), programs.end(), offset);
  return after == programs.begin() ? 0 : static_cast<std::size_t>(after - programs.begin()) - 1;
}

Index makeIndex(const std::string& path, const project::CommonOptions& options) {
  Index out;
  project::Session session(options);
  Diagnostics unheard;
  const project::Recognition* const found = session.kindOf(path, unheard);
  if (found == nullptr || !(found->kind || project::isPost(*found))) return out;
  out.kind = found->kind;
  out.post = !found->kind;
  const std::optional<FileId> file =
      session.read(path, out.post ? Encoding::Cp1250 : encodingOf(*found->kind));
  if (!file) return out;
  out.file = *file;
  out.encoding = session.sources().file(*file).encoding();
  if (out.post)
    indexPost(out, session);
  else
    indexByKind(out, session, path);
  sortByPlace(out);
  out.sources = std::move(session.sources());
  return out;
}

} // namespace dotek::lsp
