// Cycles for features that the shipped examples do not have, with a post that calls Dotek's own macros:
// pocket, web, boss, inner corner, angle. Written into a folder when a test wants them.
#pragma once

#include "tests/unit/DataFolder.h"

#include <string>
#include <utility>
#include <vector>

namespace dotek::tests {

class FaultCycles {
public:
  FaultCycles() {
    const std::string down = "path feed_z, Z-plane\n", up = "path feed_z, R-plane\n";
    // From within along an axis, and back to the middle.
    const auto within = [](const std::string& axis) {
      return "path feed_" + axis + ", D/2-radius\npath feed_" + axis + ", radius-D/2\npath feed_" + axis +
             ", 0\n";
    };
    // Down beside the feature, inward, and up again; on both sides.
    const auto outside = [](const std::string& axis) {
      std::string out;
      for (const std::string sign : {"", "-1*"}) {
        const std::string beside = sign + "(D/2+radius+W)", touch = sign + "(D/2+radius)";
        out += "path feed_" + axis + ", " + beside + "\npath feed_z, Z-plane\npath feed_" + axis + ", " +
               touch + "\npath feed_" + axis + ", " + beside + "\npath feed_z, C-plane\n";
      }
      return out + "path feed_" + axis + ", 0\n";
    };
    const std::string inside = "D = 40\nZ = -8\nR = 40\n", around = "D = 30\nZ = -8\nC = 12\nW = 5\nR = 40\n";
    const std::string high = "if R <= Z then wrong = 1\n", wide = "if D < 2*radius+2 then wrong = 1\n";
    const std::string clear = "if W < 2 then wrong = 1\nif C < Z+2*radius+5 then wrong = 1\n"
                              "if R < C then wrong = 1\nif D < 5 then wrong = 1\n";
    write("fault-pocket", inside, high + wide, down + within("y") + up);
    write("fault-web", around, clear, "path feed_z, C-plane\n" + outside("x") + up);
    write("fault-boss", around, clear, "path feed_z, C-plane\n" + outside("x") + outside("y") + up);
    // The post moves to X10 Y20; the fields are coordinates.
    const std::string near =
        "if abs(X-10) < radius+1 then wrong = 1\nif abs(Y-20) < radius+1 then wrong = 1\n";
    write("fault-corner", "X = 30\nY = 45\nZ = -8\nR = 40\n", high + near,
          down + toFace("x", "X-10") + "path feed_x, 0\n" + toFace("y", "Y-20") + "path feed_y, 0\n" + up);
    write("fault-angle", "Y = 45\nD = 16\nZ = -8\nR = 40\n",
          high + "if abs(Y-20) < radius+1 then wrong = 1\nif D < 4*radius+12 then wrong = 1\n",
          down + "path feed_x, -D/2\n" + toFace("y", "Y-20") + "path feed_y, 0\npath feed_x, D/2\n" +
              toFace("y", "Y-20") + "path feed_y, 0\npath feed_x, 0\n" + up);
    writePost();
  }

  std::string folder(const std::string& name) const { return folder_.path() + "/" + name; }
  std::string post() const { return folder_.path() + "/post.txt"; }

private:
  static std::string toFace(const std::string& axis, const std::string& way) {
    return "if " + way + " > 0 then path feed_" + axis + ", " + way + "-radius\nif " + way +
           " < 0 then path feed_" + axis + ", " + way + "+radius\n";
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    return text;
  }

  void write(const std::string& name, const std::string& fields, const std::string& checks,
             const std::string& path) const {
    folder_.write(name + "/DefineData.txt", "! " + name + "\n" + fields);
    folder_.write(name + "/CycleData.mac",
                  "proc = callback_proc\ncallback_returncode = 0\nget_proc_data proc, TOOL_NUM, tool\n"
                  "get_tool_data tool, MTOOL_RADIUS, radius\n:ask\ndialog \"CycleData.dlg\"\nwrong = 0\n" +
                      checks +
                      "if wrong > 0 then message \"Not these values\"\nif wrong > 0 then goto ask\n");
    std::string inputs;
    for (std::size_t at = 0; at < fields.size(); at = fields.find('\n', at) + 1)
      inputs += "input 90, 50, 70, 24, " + fields.substr(at, 1) + ", " + fields.substr(at, 1) + "\n";
    folder_.write(name + "/CycleData.dlg", "dialog \"" + name + "\", 40, 40, 420, 290\n" + inputs +
                                               "cancel 230, 230,  80, 28\nok 130, 230,  80, 28\n");
    folder_.write(name + "/ToolPath.mac",
                  "op = callback_op\ncallback_returncode = 0\n"
                  "get_custom_drill_cycle_data retract_plane, plane\nget_op_data op, TOOL_NUM, tool\n"
                  "get_tool_data tool, MTOOL_RADIUS, radius\n" +
                      replaced(path, "path feed", "add_custom_drill_cycle_path feed"));
  }

  void writePost() const {
    const auto field = [](const std::string& name) { return name + "'OpFieldData#('" + name + "')'"; };
    const auto cycle = [&](const std::string& name, const std::string& first, const std::string& height,
                           const std::string& call) {
      return "IF CycleType?('" + name + "')\n" + first + " probeOn\n SeqC ' G65 P8810 Z'OpFieldData#('" +
             height + "')' F500' EOL\n SeqC ' " + call + "' EOL\n probeOff\nEND\n";
    };
    const std::string start = " SeqC ' G0 X10. Y20.' EOL\n";
    folder_.write(
        "post.txt",
        "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n\n"
        "probeOn:\n SeqC SpinOff EOL\n SeqC CoolOff EOL\n SeqC ' M31' EOL\nRETURN\n\n"
        "probeOff:\n SeqC ' G65 P8810 Z'OpFieldData#('R')' F3000' EOL\n SeqC ' M32' EOL\nRETURN\n\nprobe:\n" +
            cycle("fault-pocket", "", "Z", "G65 P8812 Y'OpFieldData#('D')' S2") +
            cycle("fault-web", "", "C",
                  "G65 P8812 X'OpFieldData#('D')' " + field("Z") + " R'OpFieldData#('W')' S3") +
            cycle("fault-boss", "", "C",
                  "G65 P8814 " + field("D") + " " + field("Z") + " R'OpFieldData#('W')' S4") +
            cycle("fault-corner", start, "Z", "G65 P8815 " + field("X") + " " + field("Y") + " S5") +
            cycle("fault-angle", start, "Z",
                  "G65 P8843 " + field("Y") + " D'OpFieldData#('D') EOL\n SeqC ' #550=#139") +
            "RETURN\n");
  }

  DataFolder folder_;
};

} // namespace dotek::tests
