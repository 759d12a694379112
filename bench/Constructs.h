// What `./dev bench-growth` grows: for each construct of each language an input of any size.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bench {

// Files that a run needs, and its arguments after the program's name; paths are relative to the folder of the
// files.
struct Input {
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> arguments;
};

struct Construct {
  std::string name; // "macro B: labels"
  long size = 0;    // grown to twice, four and eight times as much
  std::function<Input(long)> make;
};

// "0: line 0\n" and so on: what `line` says of 0 to n - 1.
template <class Line> std::string repeated(long n, Line line) {
  std::string out;
  for (long i = 0; i < n; ++i)
    out += line(i);
  return out;
}
// `text`, n times.
std::string times(long n, std::string_view text);
// Macro text as shops have it: subprograms of some 40 lines with numbers, labels, variables and calls of
// their own; about `bytes` long.
std::string ordinaryMacros(std::size_t bytes);
// As ordinaryMacros, one program, its labels and variables running on.
std::string ordinaryProgram(std::size_t bytes);

void addMacroB(std::vector<Construct>& out);
void addGibbs(std::vector<Construct>& out);
void addComPost(std::vector<Construct>& out);
void addMikroprog(std::vector<Construct>& out);
void addFusion(std::vector<Construct>& out);
void addCycle(std::vector<Construct>& out);
void addData(std::vector<Construct>& out);
void addTargets(std::vector<Construct>& out);

} // namespace bench
