// Findings that a folder has already: written once, and passed over from then on.
#pragma once

#include "support/Diagnostics.h"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace dotek::lint {

class Baseline {
public:
  // The text of a file that render() made; nullopt with the reason where it is none. `path`: that file, whose
  // folder its names of files count from; "" for the folder that the process is in.
  static std::optional<Baseline> read(std::string_view text, std::string& reason,
                                      const std::string& path = "");
  // Whether a run would have found the finding if it were there still: the file (absolute) was looked at, or
  // is no longer where the run looked, and the rule ran.
  using Judged = std::function<bool(const std::string& file, const std::string& code)>;

  // JSON: `schema` and `findings`, each with `file` (from the folder of `path`, however it was named), `code`
  // and `fingerprint`. The findings are sorted. Those of `before` that the run did not judge stay.
  static std::string render(const Diagnostics& findings, const SourceMap& sources, const std::string& path,
                            const Baseline& before, const Judged& judged);
  Baseline() = default; // empty

  // Takes out the findings that it holds; the findings are sorted. What remains of it is gone from the
  // inputs.
  void passOver(Diagnostics& findings, const SourceMap& sources);

  std::size_t passedOver() const { return passedOver_; }
  std::size_t gone(const Judged& judged) const;   // of what passOver() left
  std::size_t others(const Judged& judged) const; // not judged by the run
  // It is of files of which none is among `sources`.
  bool isOfOthers(const SourceMap& sources) const;

private:
  // File (absolute), code and fingerprint; how many there are.
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> held_;
  std::size_t passedOver_ = 0;
};

} // namespace dotek::lint
