// A form: what the Form file of a GibbsCAM post decides (text of commands, pictures of numbers). Its file
// format is not known, so it is data: stdlib/forms/<name>.toml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;
class ComPostKeywords;

struct FormEntry {
  std::string text;      // printed as it is, leading blank included
  std::string value;     // host input printed after the text ("clearance"), "" for none
  std::string picture;   // of the value
  bool observed = false; // seen in real output; else assumed
  std::string source;
};

struct FormBoolean {
  bool value = false;
  bool observed = false;
  std::string source;
};

struct Form {
  std::string name;
  std::string origin;  // "built in", or the file: what messages tell to extend
  std::string control; // profile of the machine that the post writes for (stdlib/controls); "" where not said
  std::map<std::string, FormEntry, std::less<>> commands; // SpinOff, ZCP1, ...
  std::map<std::string, FormEntry, std::less<>>
      numerics; // keyword without `#`: its picture, and the host input it prints
  std::map<std::string, FormBoolean, std::less<>>
      booleans; // keyword without `?`: what holds for a probe operation
  std::map<std::string, FormEntry, std::less<>> sequences; // SeqC, SeqLabC: the text before the digits

  // Throws DataError where the file has a defect. nullopt: no such form.
  static std::optional<Form> load(const DataFiles& files, std::string_view name,
                                  const ComPostKeywords& keywords);
  static std::optional<Form> load(const DataFiles& files, std::string_view name);
};

} // namespace dotek::stdlib
