// A table as a control states it, and the controls that it extends; private to Control*.cpp.
#pragma once

#include "stdlib/Toml.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

// A key is taken from the nearest file that has it. All places are of the control's own file: what an
// inherited value contradicts is shown where the control begins to differ.
class ControlSection {
public:
  ControlSection() = default;
  // `start`: of the control's own file, for values that it inherits.
  explicit ControlSection(SourceRange start) : start_(start) {}
  void add(TomlTable table, bool own) {
    if (own) own_ = true;
    tables_.push_back(std::move(table));
  }

  explicit operator bool() const { return !tables_.empty(); }
  bool has(std::string_view key) const {
    return std::any_of(tables_.begin(), tables_.end(), [&](const TomlTable& one) { return one.has(key); });
  }
  // The control's own file has the key.
  bool owns(std::string_view key) const { return own_ && tables_.front().has(key); }
  TomlValue value(std::string_view key) const {
    TomlValue found;
    for (std::size_t i = 0; i < tables_.size() && !found; ++i)
      found = tables_[i].value(key);
    return found;
  }
  TomlValue require(std::string_view key, std::string_view what) const {
    const TomlValue found = value(key);
    return found || tables_.empty() ? found : tables_.front().require(key, what);
  }
  // Its header in the control's own file, else where that file begins.
  SourceRange range() const { return own_ ? tables_.front().range() : start_; }
  SourceRange range(std::string_view key) const {
    return owns(key) ? tables_.front().value(key).range() : range();
  }
  // The nearest table, whose grade and source hold for its keys.
  const TomlTable& nearest() const { return tables_.front(); }

private:
  SourceRange start_;
  bool own_ = false;
  std::vector<TomlTable> tables_;
};

} // namespace dotek::stdlib
