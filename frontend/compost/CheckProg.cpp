// Pictures, flags, routines and comments.
#include "frontend/compost/Check.h"
#include "support/NearestName.h"
#include "support/Picture.h"

#include <algorithm>

namespace dotek::frontend::compost {

namespace {

template <class Kind, class Visit> void eachItem(const CheckedProg& input, const Visit& visit) {
  for (const Item& item : input.program.items)
    if (const auto* one = std::get_if<Kind>(&item)) visit(*one);
}

// The first definition of each number.
std::map<std::uint32_t, const PictureDefinition*> picturesOf(const CheckedProg& input) {
  std::map<std::uint32_t, const PictureDefinition*> out;
  eachItem<PictureDefinition>(input,
                              [&](const PictureDefinition& one) { out.try_emplace(one.number, &one); });
  return out;
}

} // namespace

void commentBrace(const CheckedProg& input, Report& report) {
  for (const Comment& comment : input.program.comments) {
    const std::string_view whole = input.sources.text(comment.range);
    const std::size_t brace = whole.find('{', 1);
    if (brace == std::string_view::npos || !whole.ends_with('}')) continue; // one without end is an error
    const auto at = static_cast<std::uint32_t>(comment.range.begin + brace);
    report
        .at({comment.range.file, at, at + 1}, "this comment contains a `{{`; it ends at the "
                                              "first `}}`, and what follows is compiled; "
                                              "take the brace out or close the comment before it")
        .note({comment.range.file, comment.range.begin, comment.range.begin + 1}, "the comment begins here");
  }
}

void duplicateRoutine(const CheckedProg& input, Report& report) {
  eachItem<Routine>(input, [&](const Routine& routine) {
    const SourceRange first = input.routines.at(routine.name);
    if (first == routine.nameRange) return;
    report
        .at(routine.nameRange,
            "there is a routine `{}` already; which of the two a call runs is not known; rename or remove "
            "one",
            input.text(routine.nameRange))
        .note(first, "the first one");
  });
}

// ---- pictures

void badPicture(const CheckedProg& input, Report& report) {
  eachItem<PictureDefinition>(input, [&](const PictureDefinition& definition) {
    const SourceRange range = definition.picture.range;
    const auto parsed = Picture::parse(definition.picture.text);
    const auto* error = std::get_if<PictureError>(&parsed);
    if (error == nullptr) return;
    const std::uint32_t begin = std::min(range.begin + 1 + error->offset, range.end - 1);
    const std::uint32_t end = std::clamp(begin + error->length, begin, range.end);
    report.at({range.file, begin, end}, "{}", error->message);
  });
}

void duplicatePicture(const CheckedProg& input, Report& report) {
  const auto defined = picturesOf(input);
  eachItem<PictureDefinition>(input, [&](const PictureDefinition& picture) {
    const PictureDefinition* first = defined.at(picture.number);
    if (first == &picture) return;
    report
        .at(picture.numberRange,
            "picture {} is defined already; which of the two the numbers are printed with is not known; give "
            "one "
            "another number",
            picture.number)
        .note(first->numberRange, "the first definition");
  });
}

void duplicateFormat(const CheckedProg& input, Report& report) {
  std::map<std::string_view, SourceRange> formatted;
  eachItem<FormatDirective>(input, [&](const FormatDirective& format) {
    const auto [first, added] = formatted.try_emplace(format.name, format.nameRange);
    if (added) return;
    report
        .at(format.nameRange,
            "`{}` has a `FORMAT` already; which of the two it is printed with is not known; remove one; "
            "one keyword has one picture in the whole post, and a word that takes no point needs a keyword "
            "of its own",
            input.text(format.nameRange))
        .note(first->second, "the first `FORMAT` of it");
  });
}

void formatWithoutPicture(const CheckedProg& input, Report& report) {
  const auto defined = picturesOf(input);
  eachItem<FormatDirective>(input, [&](const FormatDirective& format) {
    if (!defined.contains(format.number))
      report.at(format.numberRange,
                "there is no picture {}, so the keyword cannot be printed; define it, `#N = '###.##'`",
                format.number);
  });
}

void pictureUnused(const CheckedProg& input, Report& report) {
  if (input.program.hasErrorNodes) return; // a FORMAT may be among what could not be read
  std::set<std::uint32_t> used;
  eachItem<FormatDirective>(input, [&](const FormatDirective& format) { used.insert(format.number); });
  for (const auto& [number, picture] : picturesOf(input))
    if (!used.contains(number))
      report.at(picture->numberRange, "no `FORMAT` of this Prog uses picture {}", number);
}

// ---- flags and routines

void flagNeverSet(const CheckedProg& input, Report& report) {
  // By name, at the first use.
  std::map<std::string, SourceRange> read, set, cleared;
  for (const Word* word : input.words) {
    if (word->arguments.size() != 1) continue;
    const Literal& argument = word->arguments.front();
    if (word->kind == WordKind::Command && word->name == "SetFlag")
      set.try_emplace(argument.text, argument.range);
    if (word->kind == WordKind::Command && word->name == "SetFlagF")
      cleared.try_emplace(argument.text, argument.range);
    if (word->kind == WordKind::Boolean && word->name == "Flag")
      read.try_emplace(argument.text, argument.range);
  }
  for (const auto& [flag, range] : read) {
    if (set.contains(flag)) continue;
    if (report.full(range.file)) break;
    std::string hint = nearestName(flag, set);
    if (!hint.empty()) hint = fmt::format("; the nearest flag that is set is `{}`", hint);
    report.at(range,
              "the flag `{}` is read and {} in this Prog, so the condition is false unless a macro sets it{}",
              input.text({range.file, range.begin + 1, range.end - 1}),
              cleared.contains(flag) ? "only cleared" : "never set", hint);
  }
}

void routineHidesKeyword(const CheckedProg& input, Report& report) {
  for (const auto& [routine, range] : input.routines)
    if (input.keywords.find(routine) != nullptr)
      report.at(
          range,
          "the routine `{}` has the name of a built-in keyword; which of the two a call runs is not known; "
          "rename the routine",
          input.text(range));
}

void routineNeverCalled(const CheckedProg& input, Report& report) {
  std::set<std::string_view> called;
  for (const Word* word : input.words)
    if (input.calls(*word)) called.insert(word->name);
  for (const auto& [routine, range] : input.routines)
    if (!called.contains(routine) && !input.keywords.isEntryPoint(routine))
      report.at(range,
                "nothing in this Prog calls the routine `{}`; it runs only if the post engine calls it",
                input.text(range));
}

} // namespace dotek::frontend::compost
