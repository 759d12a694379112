// Whether two runs of a program go the same way through it.
#pragma once

#include "verify/Record.h"

#include <set>

namespace dotek::verify {

// The same blocks, as far as they show; not where they lead to. `sameText`: it is one text that ran, so that
// places in it can be compared.
bool sameWay(const Record& a, const Record& b, bool sameText = true);

// Where runs go another way than a step before: the last step of each way, as far as they show between two
// steps. `at`: the run of a step, an optional that stays where it is; nothing: there is none.
template <class At> void findTurns(long from, long to, bool sameText, const At& at, std::set<long>& out) {
  const auto &one = at(from), &other = at(to);
  if (!one || !other || sameWay(*one, *other, sameText)) return;
  if (to - from <= 1) {
    out.insert(from);
    return;
  }
  const long middle = from + (to - from) / 2;
  findTurns(from, middle, sameText, at, out);
  findTurns(middle, to, sameText, at, out);
}

// Each of its measures has met a surface, and no macro has stopped it.
bool meetsEach(const Record& record);

} // namespace dotek::verify
