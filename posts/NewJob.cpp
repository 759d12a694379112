#include "posts/Json.h"
#include "posts/PostJob.h"
#include "posts/PostRun.h"
#include "support/Printable.h"

#include <algorithm>
#include <array>

namespace dotek::posts {

bool namesProbing(std::string_view text) {
  constexpr std::array<std::string_view, 5> kMarks = {"probing-", "isProbing", "STRATEGY_PROBING",
                                                      "hasParameter(\"probe", "include("};
  return std::any_of(kMarks.begin(), kMarks.end(),
                     [&](std::string_view mark) { return text.find(mark) != std::string_view::npos; });
}

std::string newPostJob(const std::string& post, const std::vector<PostProperty>& properties,
                       const std::vector<std::string>& capabilities, bool probes) {
  std::string out =
      "# What `dotek run-post` hands to " + printable(post) +
      "\nschema = 1\nunit = \"mm\"\n\n[program]\nname = "
      "\"1001\"\ncomment = \"\"\n\n# The post's own properties, with their values.\n[properties]\n";
  for (const PostProperty& one : properties) {
    const bool plain = !one.value.empty() && one.value.front() != '{' && one.value.front() != '[' &&
                       one.value != "null" && one.value != "undefined";
    if (!one.title.empty())
      out += "# " + printable(one.title + (one.choices.empty() ? "" : ": " + one.choices)) + "\n";
    out += (plain ? "" : "# ") + jsonText(one.name) + " = " + one.value + "\n";
  }
  out += "\n# One operation after the other; the steps of an operation in their order.\n";
  const auto has = [&](std::string_view name) {
    return std::find(capabilities.begin(), capabilities.end(), name) != capabilities.end();
  };
  if (has("turning") && !has("milling")) {
    out += "# The post is one for turning: no mill's operation is written.\n";
    return out + R"([[section]]
type = "TYPE_TURNING"
strategy = "turningRoughing"
work_offset = 1
# feed_mode = "per-revolution": the feeds below are then mm/rev
tool = { number = 2, type = "TOOL_TURNING_GENERAL", diameter = 0.0, description = "turn", spindleRPM = 800, surfaceSpeed = 120000.0, maximumSpindleSpeed = 2000, noseRadius = 0.8, coolant = "COOLANT_FLOOD" }
# spindleMode = "SPINDLE_CONSTANT_SURFACE_SPEED": surfaceSpeed in mm/min counts instead of spindleRPM
parameters = { "operation-comment" = "Turn", "operation:tool_feedCutting" = 200.0, "operation:tool_feedCuttingRel" = 0.25 }
before = [{ manual = "STOP" }]

# X is a radius.
[[section.step]]
rapid = [30.0, 0.0, 5.0]

[[section.step]]
rapid = [20.0, 0.0, 5.0]

[[section.step]]
movement = "CUTTING"

[[section.step]]
linear = [20.0, 0.0, -15.0]
feed = 200.0

[[section.step]]
arc = [25.0, 0.0, -20.0]
center = [25.0, 0.0, -15.0]
plane = "ZX"
clockwise = true
feed = 200.0

[[section.step]]
movement = "RAPID"

[[section.step]]
rapid = [30.0, 0.0, 5.0]

[[section]]
type = "TYPE_TURNING"
strategy = "turningThread"
work_offset = 1
tool = { number = 5, type = "TOOL_TURNING_THREADING", diameter = 0.0, description = "thread", spindleRPM = 500, maximumSpindleSpeed = 2000, threadPitch = 1.5 }
parameters = { "operation-comment" = "Thread", "operation:threadPitch" = 1.5, "operation:threadDepth" = 0.92, "operation:tool_feedCutting" = 750.0 }

[[section.step]]
rapid = [23.0, 0.0, 5.0]

# A pass of a thread lies between these two commands. As a cycle: cycle = "thread-turning", points = the end of each
# pass, with = { clearance = 23.0, pitch = 1.5, incrementalX = 0.0, incrementalZ = -17.0 }
[[section.step]]
movement = "LEAD_IN"

[[section.step]]
linear = [19.08, 0.0, 5.0]
feed = 750.0

[[section.step]]
command = "ACTIVATE_SPEED_FEED_SYNCHRONIZATION"

[[section.step]]
linear = [19.08, 0.0, -12.0]
feed = 750.0

[[section.step]]
command = "DEACTIVATE_SPEED_FEED_SYNCHRONIZATION"

[[section.step]]
movement = "RAPID"

[[section.step]]
rapid = [23.0, 0.0, -12.0]
)";
  }
  if (!probes) out += "# The post names no probing cycle: a section of strategy \"probe\" is left out.\n";
  if (probes)
    out += R"([[section]]
strategy = "probe"
work_offset = 1
tool = { number = 7, type = "TOOL_PROBE", diameter = 6.0, description = "probe", spindleRPM = 50 }
parameters = { "operation-comment" = "Probe the bore" }

[[section.step]]
rapid = [100.0, 50.0, 20.0]

[[section.step]]
cycle = "probing-xy-circular-hole"
points = [[100.0, 50.0, 0.0]]
with = { clearance = 20.0, retract = 8.0, stock = 0.0, depth = 5.0, bottom = -5.0, feedrate = 1000.0, probeClearance = 4.0, probeOvertravel = 10.0, width1 = 40.0 }

)";
  out += R"([[section]]
strategy = "drill"
work_offset = 1
tool = { number = 3, type = "TOOL_DRILL", diameter = 8.0, description = "drill", spindleRPM = 1500, coolant = "COOLANT_FLOOD" }
parameters = { "operation-comment" = "Drill" }
before = [{ manual = "STOP" }]

[[section.step]]
rapid = [10.0, 10.0, 20.0]

[[section.step]]
cycle = "drilling"
points = [[10.0, 10.0, -12.0], [30.0, 10.0, -12.0]]
with = { clearance = 20.0, retract = 5.0, stock = 0.0, depth = 12.0, bottom = -12.0, feedrate = 200.0, retractFeedrate = 400.0, plungeFeedrate = 200.0, dwell = 0.0, incrementalDepth = 5.0, accumulatedDepth = 12.0, plungesPerRetract = 3 }

[[section.step]]
linear = [40.0, 10.0, 20.0]
feed = 500.0

[[section.step]]
arc = [50.0, 20.0, 20.0]
center = [40.0, 20.0, 20.0]
clockwise = false
feed = 500.0
)";
  return out;
}

} // namespace dotek::posts
