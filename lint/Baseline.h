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
#include <vector>

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

  // JSON: `schema` and `findings`, each with `file` (from the folder of `path`, however it was named),
  // `code`, `fingerprint` and `places`, the fingerprints of its notes in that file. The findings are sorted.
  // Those of `before` that the run did not judge stay.
  static std::string render(const Diagnostics& findings, const SourceMap& sources, const std::string& path,
                            const Baseline& before, const Judged& judged);
  Baseline() = default; // empty

  // Takes out the findings of which it holds each place, as often as they are there; the findings are sorted.
  // What remains of it is gone from the inputs.
  void passOver(Diagnostics& findings, const SourceMap& sources);

  std::size_t passedOver() const { return passedOver_; }
  // Of those, how many list further places that the baseline, which is of an older version, does not know.
  std::size_t passedBlindly() const { return passedBlindly_; }
  std::size_t gone(const Judged& judged) const;   // of what passOver() did not find
  std::size_t others(const Judged& judged) const; // not judged by the run
  // It is of files of which none is among `sources`.
  bool isOfOthers(const SourceMap& sources) const;

private:
  // File (absolute), code and fingerprint.
  using Key = std::tuple<std::string, std::string, std::string>;
  struct Held {
    // nullopt: of a list that was written before places were kept.
    std::optional<std::vector<std::string>> places;
    bool found = false;
  };

  static Key keyOf(const Diagnostic& one, const SourceMap& sources, std::string fingerprint);
  static std::vector<std::string> placesOf(const Diagnostic& one, const SourceMap& sources);
  bool holds(const Key& key, const std::vector<std::string>& places);

  std::multimap<Key, Held> held_;
  // By file, code and fingerprint without its number: how many places of the held findings are not taken yet.
  std::map<Key, std::size_t> places_;
  std::size_t passedOver_ = 0, passedBlindly_ = 0;
};

} // namespace dotek::lint
