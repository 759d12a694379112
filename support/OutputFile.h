// A file that a command gives: its caller writes it.
#pragma once

#include <string>

namespace dotek {

struct OutputFile {
  std::string name; // "O8000.nc"; of a picture its kind
  std::string text;
  std::string mark =
      ""; // lines that say what it is of; a file without them is that of another input. "": none
};

} // namespace dotek
