// Values that jobs of Autodesk hold, as a post sees them that keeps its codes in a list.
description = "Codes by number";
capabilities = CAPABILITY_MILLING | CAPABILITY_MACHINE_SIMULATION;
var coolants = [9, 8, 7, 88, 83, 84, 85, 86, 89];
function onOpen() {
  writeWords("coolant", COOLANT_OFF, COOLANT_FLOOD, COOLANT_MIST, COOLANT_THROUGH_TOOL, COOLANT_AIR,
    COOLANT_AIR_THROUGH_TOOL, COOLANT_SUCTION, COOLANT_FLOOD_MIST, COOLANT_FLOOD_THROUGH_TOOL);
  writeWords("other names", COOLANT_DISABLED == COOLANT_OFF, COOLANT_TOOL == COOLANT_THROUGH_TOOL, PLANE_XZ == PLANE_ZX);
  writeWords("tools", TOOL_UNSPECIFIED, TOOL_DRILL, TOOL_DRILL_SPOT, TOOL_MILLING_END_FLAT, TOOL_MILLING_END_BALL,
    TOOL_MILLING_CHAMFER, TOOL_MILLING_FACE, TOOL_TAP_RIGHT_HAND, TOOL_TAP_LEFT_HAND, TOOL_REAMER, TOOL_TURNING_GENERAL,
    TOOL_TURNING_THREADING, TOOL_TURNING_GROOVING, TOOL_PROBE);
  writeWords("capabilities", (capabilities & CAPABILITY_MILLING) != 0, (capabilities & CAPABILITY_TURNING) != 0,
    (capabilities & CAPABILITY_JET) != 0, (capabilities & CAPABILITY_MACHINE_SIMULATION) != 0);
  writeWords("planes", PLANE_XY, PLANE_ZX, PLANE_YZ);
}
function onSection() {
  writeWords("T" + tool.number, "M" + coolants[tool.coolant], getCoolantName(tool.coolant));
}
