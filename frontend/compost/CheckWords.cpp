// Words: keywords, their case, suffix and arguments, and constructs that no source confirms.
#include "frontend/compost/Check.h"
#include "frontend/compost/Slips.h"
#include "support/NearestName.h"
#include "support/Picture.h"
#include "support/WriteInstead.h"

#include <algorithm>

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

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
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

// In a Prog of more routines than a hint looks at, those that are nearest by the alphabet: mostly the
// beginning of a name is right.
void offerRoutines(const std::map<std::string, SourceRange, std::less<>>& routines, NearestName& nearest,
                   std::string_view name) {
  auto routine = routines.begin();
  if (routines.size() > NearestName::kMostOffers) {
    routine = routines.lower_bound(name);
    for (std::size_t i = 0; i < NearestName::kMostOffers / 2 && routine != routines.begin(); ++i)
      --routine;
  }
  for (; routine != routines.end() && !nearest.full(); ++routine)
    nearest.offer(routine->first);
}

} // namespace

std::string CheckedProg::slipOf(const Spelling& spelt) const {
  if (keywords.find(spelt.name) != nullptr || !caseVariant(spelt).empty()) return "";
  const std::string near = keywords.nearest(spelt.name);
  if (const ComPostKeyword* known = keywords.find(near))
    if (wordKindOf(*known) == spelt.kind && isSlip(spelt.name, near))
      return near + std::string(suffixOf(spelt.kind));
  if (spelt.kind != WordKind::Command) return "";
  NearestName nearest(spelt.name);
  offerRoutines(routines, nearest, spelt.name);
  return isSlip(spelt.name, nearest.result()) ? nearest.result() : "";
}

void keywordMisspelt(const CheckedProg& input, Report& report) {
  for (const CheckedProg::Spelling& spelt : input.spellings) {
    if (report.full(spelt.range.file)) continue;
    const std::string meant = input.slipOf(spelt);
    if (meant.empty()) continue;
    Diagnostic& found =
        report.at(spelt.range,
                  "`{}` is neither a routine of this Prog nor a keyword that Dotek knows; did you mean `{}`?",
                  input.text(spelt.range), meant);
    const std::string_view suffix = suffixOf(spelt.kind);
    const bool apart =
        !suffix.empty() && meant.ends_with(suffix) && !input.text(spelt.range).ends_with(suffix);
    found.fix = writeInstead(spelt.range, meant.substr(0, meant.size() - (apart ? suffix.size() : 0)));
  }
}

void unknownKeyword(const CheckedProg& input, Report& report) {
  for (const CheckedProg::Spelling& spelt : input.spellings) {
    if (input.keywords.find(spelt.name) != nullptr || report.full(spelt.range.file)) continue;
    if (!input.caseVariant(spelt).empty() || !input.slipOf(spelt).empty()) continue;
    const bool command = spelt.kind == WordKind::Command;
    std::string remedy(command ? foreignFlow(spelt.name) : std::string_view{});
    if (remedy.empty()) {
      NearestName nearest(spelt.name);
      nearest.offer(input.keywords.nearest(spelt.name));
      if (command) offerRoutines(input.routines, nearest, spelt.name);
      std::string hint = nearest.result();
      if (const ComPostKeyword* other = input.keywords.find(hint)) hint += suffixOf(wordKindOf(*other));
      if (!hint.empty()) remedy = fmt::format("; the nearest known name is `{}`", hint);
    }
    report.at(spelt.range,
              "`{}` is neither a routine of this Prog nor a keyword that Dotek knows; it is kept as a {}{}",
              input.text(spelt.range), kindName(spelt.kind), remedy);
  }
}

void keywordCase(const CheckedProg& input, Report& report) {
  for (const CheckedProg::Spelling& spelt : input.spellings) {
    if (input.keywords.find(spelt.name) != nullptr) continue;
    const std::string variant = input.caseVariant(spelt);
    if (variant.empty()) continue;
    report.at(
        spelt.range,
        "`{}` differs from `{}` in case only; whether the compiler takes it for that is not known, and Dotek "
        "does not; write it alike",
        input.text(spelt.range), variant);
  }
}

std::string CheckedProg::caseVariant(const Spelling& spelt) const {
  std::string variant = keywords.caseVariant(spelt.name);
  if (const ComPostKeyword* other = keywords.find(variant)) return variant += suffixOf(wordKindOf(*other));
  if (spelt.kind != WordKind::Command) return variant;
  const auto same = routineCases_.find(lowerCase(spelt.name));
  return same != routineCases_.end() ? same->second : variant;
}

void keywordKind(const CheckedProg& input, Report& report) {
  for (const CheckedProg::Spelling& spelt : input.spellings) {
    const ComPostKeyword* keyword = input.keywords.find(spelt.name);
    if (keyword == nullptr || wordKindOf(*keyword) == spelt.kind) continue;
    report.at(
        spelt.range,
        "`{}` is known as a {}, written `{}{}`; with another suffix the compiler looks for another keyword",
        input.text(spelt.range), kindName(wordKindOf(*keyword)), spelt.name, suffixOf(wordKindOf(*keyword)));
  }
}

void keywordArgument(const CheckedProg& input, Report& report) {
  if (input.program.hasErrorNodes) return; // the argument may be among what was lost
  for (const Word* word : input.words) {
    if (input.calls(*word)) continue;
    const ComPostKeyword* keyword = input.keywords.find(word->name);
    if (keyword == nullptr || wordKindOf(*keyword) != word->kind ||
        keyword->argument != word->arguments.empty())
      continue;
    report.at(word->nameRange, "`{}` {}", input.text(word->nameRange),
              keyword->argument ? "takes an argument, `('NAME')`, and has none here"
                                : "is not known to take an argument");
  }
}

// ---- constructs that no source confirms

namespace {

// The first place of each construct.
class Unverified {
public:
  void add(std::string_view what, SourceRange range) {
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& one) { return one.first == what; });
    if (same == found.end())
      found.emplace_back(what, range);
    else if (range.begin < same->second.begin)
      same->second = range;
  }

  std::vector<std::pair<std::string_view, SourceRange>> found;
};

void inItems(const Program& program, Unverified& out) {
  SourceRange lastRoutine;
  for (const Item& item : program.items) {
    if (const auto* routine = std::get_if<Routine>(&item)) {
      lastRoutine = routine->range;
      if (!isAscii(routine->name)) out.add("a letter outside A to Z in a name", routine->nameRange);
    } else if (lastRoutine.hasPlace()) {
      const SourceRange range = std::visit([](const auto& node) { return node.range; }, item);
      if (range.begin < lastRoutine.end) out.add("a directive inside a routine", range);
    }
    const auto* definition = std::get_if<PictureDefinition>(&item);
    if (definition == nullptr) continue;
    const auto parsed = Picture::parse(definition->picture.text);
    const auto* picture = std::get_if<Picture>(&parsed);
    if (picture == nullptr) continue;
    if (!picture->prefix().empty())
      out.add("characters before the first place of a picture", definition->picture.range);
    if (picture->impliedPoint()) out.add("the implied point `^` of a picture", definition->picture.range);
  }
}

void inBody(const std::vector<Statement>& body, Unverified& out) {
  const Literal* before = nullptr;
  for (const Statement& statement : body) {
    const auto* literal = std::get_if<Literal>(&statement);
    if (literal != nullptr && before != nullptr && before->range.end == literal->range.begin &&
        !literal->text.empty() && !before->text.empty())
      out.add("an apostrophe doubled inside a text, read as two texts",
              {literal->range.file, before->range.end - 1, literal->range.begin + 1});
    before = literal;
    if (const auto* used = std::get_if<Word>(&statement); used != nullptr && used->kind == WordKind::Boolean)
      out.add("a boolean keyword outside a condition", used->range);
  }
}

void inCondition(const Condition& tested, Unverified& out) {
  for (std::size_t i = 0; i < tested.terms.size(); ++i) {
    const ConditionTerm& term = tested.terms[i];
    if (i > 0 && tested.connectives[i - 1] == Connective::Or)
      out.add("`OR`", {tested.range.file, tested.terms[i - 1].range.end, term.range.begin});
    for (const SourceRange negation : term.nots)
      out.add("`NOT`", negation);
    if (std::holds_alternative<std::unique_ptr<Condition>>(term.operand))
      out.add("brackets in a condition", term.range);
  }
}

} // namespace

void unverifiedInProg(const CheckedProg& input, Report& report) {
  Unverified all;
  inItems(input.program, all);
  for (const auto* body : input.bodies)
    inBody(*body, all);
  for (const Condition* condition : input.conditions)
    inCondition(*condition, all);
  for (const Word* word : input.words) {
    if (word->arguments.size() > 1) all.add("several arguments", word->range);
    if (input.calls(*word) && !word->arguments.empty()) all.add("arguments of a routine", word->range);
  }
  if (all.found.empty()) return;
  std::sort(all.found.begin(), all.found.end(),
            [](const auto& a, const auto& b) { return a.second.begin < b.second.begin; });
  Diagnostic& diagnostic = report.at(
      all.found.front().second, "{}: no source confirms that the compiler takes this; it is read as it looks",
      all.found.front().first);
  for (std::size_t i = 1; i < all.found.size(); ++i)
    diagnostic.note(all.found[i].second, fmt::format("likewise {}", all.found[i].first));
}

} // namespace dotek::frontend::compost
