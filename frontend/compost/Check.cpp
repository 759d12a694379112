#include "frontend/compost/Check.h"

#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/Picture.h"
#include "support/messages/ComPost.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::frontend::compost {

namespace {

using stdlib::ComPostKeyword;
using stdlib::KeywordKind;

std::string_view suffixOf(WordKind kind) {
  switch (kind) {
  case WordKind::Numeric: return "#";
  case WordKind::Boolean: return "?";
  case WordKind::Command: break;
  }
  return "";
}

std::string_view kindName(WordKind kind) {
  switch (kind) {
  case WordKind::Numeric: return "numeric keyword";
  case WordKind::Boolean: return "boolean keyword";
  case WordKind::Command: break;
  }
  return "command or routine";
}

WordKind wordKindOf(const ComPostKeyword& keyword) {
  switch (keyword.kind) {
  case KeywordKind::Numeric: return WordKind::Numeric;
  case KeywordKind::Boolean: return WordKind::Boolean;
  default: return WordKind::Command;
  }
}

bool isAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// What ComPost writes instead of a flow word of other languages; "" for no such word.
std::string_view foreignFlow(std::string_view word) {
  const std::string folded = lowerCase(word);
  if (folded == "elseif" || folded == "elsif" || folded == "elif")
    return "; ComPost is not known to have it: write an IF with its own END inside ELSE";
  if (folded == "endif" || folded == "fi") return "; an IF ends with `END`";
  if (folded == "then") return "; a condition of ComPost has no THEN";
  return "";
}

class Checker {
public:
  Checker(const Program& program, const stdlib::ComPostKeywords& keywords, const SourceMap& sources,
          Diagnostics& diagnostics)
      : program_(program), keywords_(keywords), sources_(sources), diagnostics_(diagnostics) {}

  void run() {
    SourceRange lastRoutine;
    for (const Item& item : program_.items) {
      if (const auto* routine = std::get_if<Routine>(&item)) {
        routines_.try_emplace(routine->name, routine->nameRange);
        std::string& first = routineCases_.try_emplace(lowerCase(routine->name), routine->name).first->second;
        first = std::min(first, routine->name);
        lastRoutine = routine->range;
        if (!isAscii(routine->name)) unverified("a letter outside A to Z in a name", routine->nameRange);
      } else if (lastRoutine.hasPlace()) {
        const SourceRange range = std::visit([](const auto& node) { return node.range; }, item);
        if (range.begin < lastRoutine.end) unverified("a directive inside a routine", range);
      }
    }
    for (const Item& item : program_.items)
      if (const auto* routine = std::get_if<Routine>(&item)) statements(routine->body);
    pictures();
    flags();
    calls();
    reportUnverified();
  }

private:
  // ---- words ---------------------------------------------------------------------------------------------

  void statements(const std::vector<Statement>& body) {
    const Literal* before = nullptr;
    for (const Statement& statement : body) {
      const auto* literal = std::get_if<Literal>(&statement);
      if (literal != nullptr && before != nullptr && before->range.end == literal->range.begin &&
          !literal->text.empty() && !before->text.empty())
        unverified("an apostrophe doubled inside a text, read as two texts",
                   {literal->range.file, before->range.end - 1, literal->range.begin + 1});
      before = literal;
      if (const auto* used = std::get_if<Word>(&statement)) {
        word(*used);
        if (used->kind == WordKind::Boolean) unverified("a boolean keyword outside a condition", used->range);
      } else if (const auto* branch = std::get_if<std::unique_ptr<If>>(&statement)) {
        condition((*branch)->condition);
        statements((*branch)->thenBody);
        statements((*branch)->elseBody);
      }
    }
  }

  void condition(const Condition& tested) {
    for (std::size_t i = 0; i < tested.terms.size(); ++i) {
      if (i > 0 && tested.connectives[i - 1] == Connective::Or)
        unverified("`OR`", {tested.range.file, tested.terms[i - 1].range.end, tested.terms[i].range.begin});
      const ConditionTerm& term = tested.terms[i];
      for (const SourceRange negation : term.nots)
        unverified("`NOT`", negation);
      if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand)) {
        unverified("brackets in a condition", term.range);
        condition(**inner);
      } else if (const auto* operand = std::get_if<Word>(&term.operand)) {
        if (operand->kind == WordKind::Boolean) word(*operand); // else the parser has said it
      }
    }
  }

  void word(const Word& used) {
    if (used.arguments.size() > 1) unverified("several arguments", used.range);
    if (used.arguments.size() == 1) {
      const Literal& argument = used.arguments.front();
      if (used.kind == WordKind::Command && used.name == "SetFlag")
        flagsSet_.try_emplace(argument.text, argument.range);
      if (used.kind == WordKind::Command && used.name == "SetFlagF")
        flagsCleared_.try_emplace(argument.text, argument.range);
      if (used.kind == WordKind::Boolean && used.name == "Flag")
        flagsRead_.try_emplace(argument.text, argument.range);
    }
    if (used.kind == WordKind::Command && routines_.contains(used.name)) {
      called_.insert(used.name);
      if (!used.arguments.empty()) unverified("arguments of a routine", used.range);
      return;
    }
    const ComPostKeyword* keyword = name(used.name, used.kind, used.nameRange);
    if (keyword == nullptr || program_.hasErrorNodes) return; // the argument may be among what was lost
    if (keyword->argument == used.arguments.empty())
      diagnostics_.report<diag::KeywordArgument>(used.nameRange, text(used.nameRange),
                                                 keyword->argument
                                                     ? "takes an argument, `('NAME')`, and has none here"
                                                     : "is not known to take an argument");
  }

  // The keyword, where the name is one as spelt; else what is wrong with it is reported, once for each
  // spelling.
  const ComPostKeyword* name(std::string_view spelt, WordKind kind, SourceRange range) {
    const ComPostKeyword* keyword = keywords_.find(spelt);
    if (keyword != nullptr) {
      if (wordKindOf(*keyword) == kind) return keyword;
      diagnostics_.report<diag::KeywordKindMismatch>(range, text(range), kindName(wordKindOf(*keyword)),
                                                     std::string(spelt) +
                                                         std::string(suffixOf(wordKindOf(*keyword))));
      return nullptr;
    }
    if (!reported_.insert(std::string(spelt) + std::string(suffixOf(kind))).second) return nullptr;
    if (diagnostics_.full(diag::UnknownKeyword::code, range.file)) return nullptr;
    std::string variant = keywords_.caseVariant(spelt);
    if (const ComPostKeyword* other = keywords_.find(variant)) {
      variant += suffixOf(wordKindOf(*other));
    } else if (kind == WordKind::Command) {
      const auto same = routineCases_.find(lowerCase(spelt));
      if (same != routineCases_.end()) variant = same->second;
    }
    if (!variant.empty()) {
      diagnostics_.report<diag::KeywordCase>(range, text(range), variant);
      return nullptr;
    }
    NearestName nearest(spelt);
    nearest.offer(keywords_.nearest(spelt));
    if (kind == WordKind::Command)
      for (auto routine = routines_.begin(); routine != routines_.end() && !nearest.full(); ++routine)
        nearest.offer(routine->first);
    std::string hint = nearest.result();
    if (const std::string_view foreign = foreignFlow(spelt); !foreign.empty() && kind == WordKind::Command) {
      diagnostics_.report<diag::UnknownKeyword>(range, text(range), kindName(kind), foreign);
      return nullptr;
    }
    if (const ComPostKeyword* other = keywords_.find(hint)) hint += suffixOf(wordKindOf(*other));
    diagnostics_.report<diag::UnknownKeyword>(
        range, text(range), kindName(kind),
        hint.empty() ? std::string() : fmt::format("; the nearest known name is `{}`", hint));
    return nullptr;
  }

  // ---- pictures ------------------------------------------------------------------------------------------

  void pictures() {
    std::map<std::uint32_t, const PictureDefinition*> defined;
    std::map<std::string_view, SourceRange> formatted;
    std::set<std::uint32_t> used;
    for (const Item& item : program_.items) {
      const auto* picture = std::get_if<PictureDefinition>(&item);
      if (picture == nullptr) continue;
      const auto [first, added] = defined.try_emplace(picture->number, picture);
      if (!added)
        diagnostics_.report<diag::DuplicatePicture>(picture->numberRange, picture->number)
            .note(first->second->numberRange, "the first definition");
      pictureText(*picture);
    }
    for (const Item& item : program_.items) {
      const auto* format = std::get_if<FormatDirective>(&item);
      if (format == nullptr) continue;
      used.insert(format->number);
      if (format->kind != WordKind::Command || !routines_.contains(format->name))
        name(format->name, format->kind, format->nameRange);
      const auto [first, added] = formatted.try_emplace(format->name, format->nameRange);
      if (!added)
        diagnostics_.report<diag::DuplicateFormat>(format->nameRange, text(format->nameRange))
            .note(first->second, "the first `FORMAT` of it");
      if (!defined.contains(format->number))
        diagnostics_.report<diag::FormatWithoutPicture>(format->numberRange, format->number);
    }
    if (program_.hasErrorNodes) return; // a FORMAT may be among what could not be read
    for (const auto& [number, picture] : defined)
      if (!used.contains(number)) diagnostics_.report<diag::PictureUnused>(picture->numberRange, number);
  }

  void pictureText(const PictureDefinition& definition) {
    const SourceRange range = definition.picture.range;
    const auto parsed = Picture::parse(definition.picture.text);
    if (const auto* error = std::get_if<PictureError>(&parsed)) {
      const std::uint32_t begin = std::min(range.begin + 1 + error->offset, range.end - 1);
      const std::uint32_t end = std::clamp(begin + error->length, begin, range.end);
      diagnostics_.report<diag::BadPicture>({range.file, begin, end}, error->message);
      return;
    }
    const auto& picture = std::get<Picture>(parsed);
    if (!picture.prefix().empty()) unverified("characters before the first place of a picture", range);
    if (picture.impliedPoint()) unverified("the implied point `^` of a picture", range);
  }

  // ---- flags and calls -----------------------------------------------------------------------------------

  void flags() {
    for (const auto& [flag, range] : flagsRead_) {
      if (flagsSet_.contains(flag)) continue;
      if (diagnostics_.full(diag::FlagNeverSet::code, range.file)) break;
      std::string hint = nearestName(flag, flagsSet_);
      if (!hint.empty()) hint = fmt::format("; the nearest flag that is set is `{}`", hint);
      diagnostics_.report<diag::FlagNeverSet>(
          range, inner(range), flagsCleared_.contains(flag) ? "only cleared" : "never set", hint);
    }
  }

  void calls() {
    for (const auto& [routine, range] : routines_) {
      if (keywords_.find(routine) != nullptr)
        diagnostics_.report<diag::RoutineHidesKeyword>(range, text(range));
      if (!called_.contains(routine) && !keywords_.isEntryPoint(routine))
        diagnostics_.report<diag::RoutineNeverCalled>(range, text(range));
    }
  }

  // ---- constructs that no source confirms ----------------------------------------------------------------

  void unverified(std::string_view what, SourceRange range) {
    const auto same = std::find_if(unverified_.begin(), unverified_.end(),
                                   [&](const auto& one) { return one.first == what; });
    if (same == unverified_.end())
      unverified_.emplace_back(what, range);
    else if (range.begin < same->second.begin)
      same->second = range;
  }

  void reportUnverified() {
    if (unverified_.empty()) return;
    std::sort(unverified_.begin(), unverified_.end(),
              [](const auto& a, const auto& b) { return a.second.begin < b.second.begin; });
    Diagnostic& diagnostic =
        diagnostics_.report<diag::UnverifiedInProg>(unverified_.front().second, unverified_.front().first);
    for (std::size_t i = 1; i < unverified_.size(); ++i)
      diagnostic.note(unverified_[i].second, fmt::format("likewise {}", unverified_[i].first));
  }

  std::string text(SourceRange range) const { return sources_.textUtf8(range); }
  // Of a literal, without its apostrophes.
  std::string inner(SourceRange range) const { return text({range.file, range.begin + 1, range.end - 1}); }

  const Program& program_;
  const stdlib::ComPostKeywords& keywords_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;

  std::map<std::string, SourceRange, std::less<>> routines_; // first of each name
  std::map<std::string, std::string> routineCases_;          // lower case to the first spelling
  std::set<std::string, std::less<>> called_;
  std::set<std::string> reported_; // spellings
  // By name, at the first use.
  std::map<std::string, SourceRange> flagsRead_;
  std::map<std::string, SourceRange> flagsSet_;
  std::map<std::string, SourceRange> flagsCleared_;
  std::vector<std::pair<std::string_view, SourceRange>> unverified_; // first place of each
};

} // namespace

void check(const Program& program, const stdlib::ComPostKeywords& keywords, const SourceMap& sources,
           Diagnostics& diagnostics) {
  Checker(program, keywords, sources, diagnostics).run();
}

} // namespace dotek::frontend::compost
