// A program of Mikroprog as the control takes it, block by block: what a reader of text hands to the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::stdlib {

// A number, or a parameter: 31.199, P6, -P1.
struct MikroprogValue {
  bool negative = false; // of a parameter
  std::optional<std::uint32_t> parameter;
  double number = 0; // without a parameter
};

struct MikroprogWord {
  char address = 0; // A to Z
  MikroprogValue value;
};

// P90=P90+32.768: the first term has the operator '+'.
struct MikroprogTerm {
  char op = '+'; // + - * /
  MikroprogValue value;
};
struct MikroprogAssignment {
  std::uint32_t parameter = 0;
  std::vector<MikroprogTerm> terms; // never empty; worked off from the left
};

struct MikroprogBlock {
  std::optional<std::uint64_t> number; // N
  std::optional<MikroprogAssignment> assignment;
  std::vector<MikroprogWord> words; // N left out, in the order of the text
  std::string file;                 // behind @, "" for none
  std::string text;                 // behind ;
  std::uint32_t line = 0;           // of the text, from 1
};

using MikroprogProgram = std::vector<MikroprogBlock>;

} // namespace dotek::stdlib
