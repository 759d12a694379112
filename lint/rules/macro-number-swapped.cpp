#include "lint/ProgBlocks.h"
#include "lint/Skips.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

struct Called {
  std::uint32_t number = 0;
  std::string letters; // of its arguments, sorted
  SourceRange range;
};

// One of the digits is another.
bool isOneDigitOff(std::uint32_t one, std::uint32_t other) {
  const std::string a = std::to_string(one), b = std::to_string(other);
  int differ = 0;
  for (std::size_t i = 0; i < a.size() && a.size() == b.size(); ++i)
    differ += a[i] != b[i] ? 1 : 0;
  return a.size() == b.size() && differ == 1;
}

// A program that is called at least twice with these letters, and whose number is one digit off; 0: none.
std::uint32_t likeOthers(const Called& call, const std::vector<Called>& calls) {
  for (const Called& other : calls)
    if (!call.letters.empty() && isOneDigitOff(call.number, other.number) &&
        std::count_if(calls.begin(), calls.end(), [&](const Called& one) {
          return one.number == other.number && one.letters == call.letters;
        }) > 1)
      return other.number;
  return 0;
}

// Two neighbouring digits of the number changed places.
std::set<std::uint32_t> swaps(std::uint32_t number) {
  std::set<std::uint32_t> out;
  const std::string digits = std::to_string(number);
  for (std::size_t i = 1; i < digits.size(); ++i) {
    std::string other = digits;
    std::swap(other[i], other[i - 1]);
    if (other != digits && other[0] != '0') out.insert(static_cast<std::uint32_t>(std::stoul(other)));
  }
  return out;
}

void compare(const std::vector<Called>& calls, const std::set<std::uint32_t>& defined, const Project& project,
             Report& report) {
  const auto known = [&](std::uint32_t number) {
    return defined.contains(number) || meaningOf(project, number).set != nullptr;
  };
  std::map<std::uint32_t, std::vector<Called>::const_iterator> first; // by number
  for (auto call = calls.begin(); call != calls.end(); ++call)
    first.try_emplace(call->number, call);
  for (const Called& call : calls) {
    if (known(call.number)) continue;
    // A misprint is made once; what is called again and again has that number.
    if (std::count_if(calls.begin(), calls.end(),
                      [&](const Called& one) { return one.number == call.number; }) > 1)
      continue;
    const std::set<std::uint32_t> others = swaps(call.number);
    auto meant = calls.end(); // the first call that may be
    for (const std::uint32_t other : others) {
      const auto place = first.find(other);
      if (place != first.end() && place->second < meant && known(other)) meant = place->second;
    }
    const auto there = std::find_if(others.begin(), others.end(),
                                    [&](std::uint32_t other) { return defined.contains(other); });
    if (meant == calls.end() && there == others.end()) {
      const std::uint32_t other = likeOthers(call, calls);
      if (other != 0 && known(other))
        report.at(
            call.range,
            "nothing is known of the program {0}, and {1}, which differs in one digit, is called with the "
            "same letters elsewhere; the control stops with an alarm, or runs something else; write P{1} "
            "if it is meant",
            call.number, other);
      continue;
    }
    report.at(
        call.range,
        "nothing is known of the program {0}, and {1} has the same digits in another order; the control "
        "stops with an alarm, or runs something else; write P{1} if it is meant",
        call.number, meant != calls.end() ? meant->number : *there);
  }
}

void check(const Project& project, Report& report) {
  std::set<std::uint32_t> defined;
  std::vector<Called> calls;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    defined.insert(static_cast<std::uint32_t>(program.number));
    for (const ir::ProgramStatement& statement : program.body) {
      const ir::Call* call = callOf(statement);
      const double* number = call == nullptr || !call->program ? nullptr : ir::constantValue(call->program);
      if (number == nullptr || *number <= 0 || *number >= 1e8) continue;
      std::string letters;
      for (const ir::CallArgument& one : call->arguments)
        letters += one.letter;
      std::sort(letters.begin(), letters.end());
      calls.push_back(
          {static_cast<std::uint32_t>(std::lround(*number)), std::move(letters), statement.origin.range()});
    }
  });
  compare(calls, defined, project, report);
  for (const compost::Program* prog : project.progs) {
    std::vector<Called> printed;
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      for (const ProgBlock& block : blocksOf(routine->body, *prog, project)) {
        const std::vector<ProgWord> words = wordsOf(block, nullptr, true);
        const ProgWord* word = findWord(words, 'P');
        const std::uint32_t number = macroCalled(words);
        if (number == 0 || word == nullptr || block.called) continue;
        std::string letters;
        for (const ProgWord& one : words)
          if (one.address != 'G' && one.address != 'P' && one.address != 'N') letters += one.address;
        std::sort(letters.begin(), letters.end());
        printed.push_back({number, std::move(letters), word->range});
      }
    }
    compare(printed, defined, project, report);
  }
}

} // namespace

DOTEK_LINT_RULE(macro_number_swapped){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
