// The names that `--assume` takes: readings of what no source documents.
#pragma once

#include "support/Diagnostics.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::project {

// Name and reading of every assumption, sorted by name. `Word?=yes` and `Word?=no` stand for all words.
std::vector<std::pair<std::string, std::string>> assumptionTable();

// Whether `--assume` takes this: a name of the table, `Word?=yes`, `touch=FILE:LINE`.
bool isAssumption(const std::string& name);

// A name outside the table is a usage error: a misspelt assumption would silently assume nothing.
void checkAssumptions(const std::set<std::string>& given, Diagnostics& diagnostics);

// The lines that `touch=FILE:LINE` names; FILE is a path as given, or its end.
std::vector<SourceRange> touchLines(const SourceMap& sources, const std::set<std::string>& given,
                                    Diagnostics& diagnostics);

} // namespace dotek::project
