// A value that is computed when it is first asked for, by whichever thread asks.
#pragma once

#include <mutex>
#include <optional>

namespace dotek::lint {

template <class Value> class Lazy {
public:
  // `make(into)` fills the empty optional. Others that ask at that time wait for it.
  template <class Make> const Value& get(const Make& make) const {
    std::call_once(once_, [&] { make(value_); });
    return *value_;
  }

private:
  mutable std::once_flag once_;
  mutable std::optional<Value> value_;
};

} // namespace dotek::lint
