#include "support/NearestName.h"

#include <doctest/doctest.h>
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

TEST_CASE("nearest name within a third of the length") {
  const std::vector<std::string> names{"MESSAGE", "GET_TOOL_LIST", "INPUT"};
  CHECK(nearestName("mesage", names) == "MESSAGE");
  CHECK(nearestName("GET_TOLO_LIST", names) == "GET_TOOL_LIST");
  CHECK(nearestName("INUPT", names) == "INPUT");
  CHECK(nearestName("OUTPUT", names) == "");
  CHECK(nearestName("IN", names) == "");
  CHECK(nearestName("", names) == "");
  CHECK(nearestName(std::string(1000000, 'A'), names) == "");
}

TEST_CASE("of equally near names the first in byte order") {
  CHECK(nearestName("lane", std::vector<std::string>{"line", "lana", "lans"}) == "lana");
  CHECK(nearestName("lane", std::vector<std::string>{"lans", "lana", "line"}) == "lana");
  CHECK(nearestName("lane", std::vector<std::string>{"line", "LANE", "lana"}) == "LANE");
}
