// Constructs that no source proves, and the reading that `--assume ID` stands for. Parsing keeps them with
// a note; running them needs the assumption.
#pragma once

#include <array>
#include <string_view>

namespace dotek::frontend::gibbs {

struct Assumption {
  std::string_view id;
  std::string_view construct; // how a message names it
  std::string_view reading;   // what Dotek takes it for
  bool runsOnly = false;      // no construct of the text, only a question that running raises
};

inline constexpr std::array<Assumption, 24> kAssumptions{{
    {"and-or", "AND or OR between comparisons", "AND: both hold; OR: one holds; AND binds tighter"},
    {"not", "NOT before a comparison", "the comparison does not hold"},
    {"condition-brackets", "brackets around a comparison", "they change nothing"},
    {"block-if", "IF with a block between `[` and `]`",
     "the lines of the block run where the condition holds"},
    {"else", "ELSE", "what follows it runs where the condition of its IF does not hold"},
    {"array-round", "an element written with round brackets", "`a(1)` is the first element of `a`"},
    {"array-square", "an element written with square brackets", "`a[1]` is the first element of `a`"},
    {"text-join", "`+` between texts", "the texts are joined"},
    {"text-comparison", "a comparison of texts", "texts are compared character by character, with case"},
    {"single-quotes", "a text in single quotes", "it is a text, as between double quotes"},
    {"doubled-quote", "a doubled quote inside a text", "it stands for one quote"},
    {"bare-fraction", "a number without a digit before or after its point", "`.5` is 0.5, `5.` is 5"},
    {"exponent", "a number with an exponent", "`1E3` is 1000"},
    {"next-without-name", "NEXT without a variable", "it ends the innermost FOR"},
    {"negative-step", "FOR with a negative STEP", "it goes on while the variable is at or above the end"},
    {"goto-into-for", "GOTO into a FOR from outside",
     "the loop goes on as if it had been entered at its head"},
    {"bare-file", "a file name without quotes", "it ends at a blank or a comma"},
    {"long-name", "a name of more than 32 characters", "all its characters count"},
    {"field-value", "a field of DefineData.txt that is no number", "the right side is computed once"},
    {"loose-caption", "a caption without quotes", "it is the text as it is"},
    {"unset-zero", "a variable that is read before it is set", "it is 0, or an empty text", true},
    {"for-end-at-entry", "a FOR whose end or step changes while it runs", "both are taken once, at the FOR",
     true},
    {"angle-radians", "the unit of angles", "radians, until DEGREES is", true},
    {"angle-degrees", "the unit of angles", "degrees, until RADIANS is", true},
}};

// nullptr: no such assumption.
constexpr const Assumption* findAssumption(std::string_view id) {
  for (const Assumption& each : kAssumptions)
    if (each.id == id) return &each;
  return nullptr;
}

} // namespace dotek::frontend::gibbs
