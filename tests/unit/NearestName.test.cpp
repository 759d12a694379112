#include "support/NearestName.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>
#include <string>
#include <vector>

using namespace dotek;

TEST_CASE("distance of names") {
  CHECK(nameDistance("abc", "ABC", 3) == 0);
  CHECK(nameDistance("abc", "acb", 3) == 1);
  CHECK(nameDistance("abc", "abd", 3) == 1);
  CHECK(nameDistance("abc", "ab", 3) == 1);
  CHECK(nameDistance("abc", "xabc", 3) == 1);
  CHECK(nameDistance("kitten", "sitting", 5) == 3);
  CHECK(nameDistance("kitten", "sitting", 2) == 3); // above the limit
  CHECK(nameDistance("", "abc", 9) == 3);
}

TEST_CASE("distance of names: any limit cuts the same distance off") {
  std::mt19937 random(3);
  const auto name = [&] {
    std::string out(random() % 9, ' ');
    for (char& c : out)
      c = "abAB-"[random() % 5];
    return out;
  };
  for (int i = 0; i < 5000; ++i) {
    const std::string a = name(), b = name();
    const std::size_t whole = nameDistance(a, b, 20);
    CHECK(whole == nameDistance(b, a, 20));
    CHECK(whole <= std::max(a.size(), b.size()));
    for (std::size_t limit = 0; limit < 9; ++limit)
      CHECK(nameDistance(a, b, limit) == std::min(whole, limit + 1));
    // What is offered alone is found where it is near enough, and nowhere else.
    const std::size_t most = a.size() < 2 ? 0 : std::max<std::size_t>(1, a.size() / 3);
    const bool rest = a.size() >= 5 && b.size() > a.size() && nameDistance(a, b.substr(0, a.size()), 0) == 0;
    if (!b.empty()) CHECK(nearestName(a, std::vector<std::string>{b}) == (whole <= most || rest ? b : ""));
  }
}

TEST_CASE("nearest name within a third of the length") {
  const std::vector<std::string> names{"MESSAGE", "GET_TOOL_LIST", "INPUT"};
  CHECK(nearestName("mesage", names) == "MESSAGE");
  CHECK(nearestName("GET_TOLO_LIST", names) == "GET_TOOL_LIST");
  CHECK(nearestName("INUPT", names) == "INPUT");
  CHECK(nearestName("OUTPUT", names) == "");
  CHECK(nearestName("MESSA", names) == "MESSAGE"); // the beginning of a name
  CHECK(nearestName("MESA", names) == "");
  CHECK(nearestName("lathe-2", std::vector<std::string>{"lathe-7", "lathe-2000-b"}) == "lathe-2000-b");
  CHECK(nearestName("IN", names) == "");
  CHECK(nearestName("", names) == "");
  CHECK(nearestName(std::string(1000000, 'A'), names) == "");
}

TEST_CASE("of equally near names the first in byte order") {
  CHECK(nearestName("lane", std::vector<std::string>{"line", "lana", "lans"}) == "lana");
  CHECK(nearestName("lane", std::vector<std::string>{"lans", "lana", "line"}) == "lana");
  CHECK(nearestName("lane", std::vector<std::string>{"line", "LANE", "lana"}) == "LANE");
}
