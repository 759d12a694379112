#include "stdlib/StoredTables.h"

#include "stdlib/StoredArchive.h"

#include <algorithm>

namespace dotek::stdlib {

template <class Archive> void fields(Archive& archive, ArgumentSpec& it) {
  // Nearly all arguments are plain: what is usual costs one field.
  unsigned bits = 0;
  if constexpr (!Archive::reads)
    bits = static_cast<unsigned>(it.kind) | static_cast<unsigned>(it.type) << 3U |
           (it.array ? 1U << 5U : 0U) | (it.optional ? 1U << 6U : 0U) | (it.geometry ? 1U << 7U : 0U) |
           (it.repeat != 1 ? 1U << 8U : 0U);
  archive(bits);
  if constexpr (Archive::reads) {
    it.kind = static_cast<ArgumentSpec::Kind>(bits & 7U);
    it.type = static_cast<ArgumentSpec::Type>(bits >> 3U & 3U);
    it.array = (bits & 1U << 5U) != 0;
    it.optional = (bits & 1U << 6U) != 0;
    it.geometry = (bits & 1U << 7U) != 0;
  }
  if ((bits & 1U << 8U) != 0) archive(it.repeat);
  archive(it.name);
  if (it.kind == ArgumentSpec::Kind::Choice) archive(it.keywords);
  if (it.kind == ArgumentSpec::Kind::Parameter) archive(it.family);
}

template <class Archive> void fields(Archive& archive, CommandSignature& it) {
  archive(it.name, it.arguments, it.grade, it.source, it.unsure, it.openKeywords);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables::Command& it) {
  archive(it.signatures, it.core, it.notes);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables::Control& it) {
  archive(it.signatures, it.unproved, it.notes);
}
template <class Archive> void fields(Archive& archive, FunctionSpec& it) {
  archive(it.name, it.types, it.result, it.grade, it.source, it.open, it.note);
}
template <class Archive> void fields(Archive& archive, ParameterFamily& it) {
  archive(it.open, it.parameters);
}
template <class Archive> void fields(Archive& archive, CallbackVariable& it) {
  archive(it.name, it.read, it.write, it.where, it.note, it.grade);
}
template <class Archive> void fields(Archive& archive, CursorNames& it) {
  archive(it.snapshot, it.after, it.names, it.advances);
}
template <class Archive> void fields(Archive& archive, SystemMacro& it) {
  archive(it.event, it.when, it.file);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables& it) {
  archive(it.commands, it.coreWords, it.renamed, it.commandPrefixes, it.controls, it.requiredControls,
          it.firstControl, it.imageSuffix, it.functions, it.families, it.hosts, it.variables, it.constants,
          it.variablePrefixes, it.callbacks, it.cursors, it.cursorOf, it.advances, it.removed, it.reserved,
          it.systemMacros);
}
template <class Archive> void fields(Archive& archive, ComPostKeyword& it) {
  archive(it.name, it.kind, it.argument, it.prints, it.grade, it.source, it.summary);
}

std::string TableStore::store(GibbsKeywords& keywords) {
  StoredWriter writer;
  writer(*keywords.tables_);
  return std::move(writer.out);
}

std::string TableStore::store(ComPostKeywords& keywords) {
  StoredWriter writer;
  writer(keywords.keywords_, keywords.entryPoints_);
  return std::move(writer.out);
}

GibbsKeywords TableStore::restoreGibbs(std::string_view text) {
  GibbsKeywords keywords;
  keywords.tables_ = std::make_unique<GibbsKeywords::Tables>();
  StoredReader reader(text);
  reader(*keywords.tables_);
  reader.end();
  return keywords;
}

ComPostKeywords TableStore::restoreComPost(std::string_view text) {
  ComPostKeywords keywords;
  StoredReader reader(text);
  reader(keywords.keywords_, keywords.entryPoints_);
  reader.end();
  return keywords;
}

GibbsKeywords GibbsKeywords::load(const DataFiles& files) {
  const std::vector<const DataFile*> keywords = files.list("keywords");
  const bool own = std::any_of(keywords.begin(), keywords.end(), [](const DataFile* file) {
    return file->name.starts_with("gibbs-") && !file->builtIn();
  });
  const std::string_view stored = embeddedTables().gibbs;
  return own || stored.empty() ? TableStore::readGibbs(files) : TableStore::restoreGibbs(stored);
}

ComPostKeywords ComPostKeywords::load(const DataFiles& files) {
  const DataFile* file = files.find("keywords", "compost");
  const std::string_view stored = embeddedTables().compost;
  return file == nullptr || !file->builtIn() || stored.empty() ? TableStore::readComPost(files)
                                                               : TableStore::restoreComPost(stored);
}

} // namespace dotek::stdlib
