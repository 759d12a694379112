// What the builder of a `.cnc` job and its parts write: JSON of records and values.
#pragma once

#include "posts/Cnc.h"
#include "posts/Json.h"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::posts::cnc {

template <std::size_t N, class T> std::string numbers(const std::array<T, N>& values) {
  std::vector<std::string> items;
  for (const T one : values)
    items.push_back(jsonNumber(static_cast<double>(one)));
  return jsonList(items);
}

std::string jsonOf(const Named& named);
// A record of a job.
std::string step(std::string_view record, std::string_view member = {}, const std::string& json = {});
std::string parameterStep(const std::string& name, const std::string& json);

// A list of values by name; a later one replaces an earlier.
class Values {
public:
  void set(const std::string& name, std::string json) {
    const auto [known, added] = at_.emplace(name, all_.size());
    if (added)
      all_.emplace_back(name, std::move(json));
    else
      all_[known->second].second = std::move(json);
  }
  const std::string* find(std::string_view name) const {
    const auto known = at_.find(name);
    return known == at_.end() ? nullptr : &all_[known->second].second;
  }
  const std::vector<std::pair<std::string, std::string>>& all() const { return all_; }
  void clear() {
    all_.clear();
    at_.clear();
  }

private:
  std::vector<std::pair<std::string, std::string>> all_; // in their order
  std::map<std::string, std::size_t, std::less<>> at_;
};

std::string objectOf(const Values& values);

} // namespace dotek::posts::cnc
