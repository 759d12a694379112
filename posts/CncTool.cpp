#include "posts/CncTool.h"

#include "posts/CncNames.h"
#include "posts/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace dotek::posts {

using namespace cnc;

namespace {

void jet(const Tool& tool, JsonObject& out) {
  if (tool.type != 29 && tool.type != 30 && tool.type != 36) return;
  out.add("jetTool", "true");
  if (tool.nozzleDiameter == 0) return; // a record without these
  out.add("kerfWidth", jsonNumber(tool.kerfWidth));
  out.add("nozzleDiameter", jsonNumber(tool.nozzleDiameter));
  out.add("cutHeight", jsonNumber(tool.cutHeight));
  out.add("pierceHeight", jsonNumber(tool.pierceHeight));
  out.add("pressure", jsonNumber(tool.pressure));
  out.add("cutPower", jsonNumber(tool.cutPower));
  out.add("piercePower", jsonNumber(tool.piercePower));
  out.add("assistGas", jsonText(tool.assistGas));
}

} // namespace

std::string CncTool::json(std::string& fault) const {
  JsonObject out;
  const auto real = [&](const char* name, double value) { out.add(name, jsonNumber(value)); };
  const auto whole = [&](const char* name, std::uint32_t value) { out.add(name, std::to_string(value)); };
  const std::string_view type = toolTypeName(tool.type, typeText);
  if (type.empty()) fault = (fmt::format("tool type {} (`{}`) is not known to Dotek", tool.type, typeText));
  const std::string_view coolant = coolantName(tool.coolant);
  if (coolant.empty()) fault = fmt::format("coolant {} is not known to Dotek", tool.coolant);
  out.add("type", jsonText(type));
  out.add("coolant", jsonText(coolant));
  whole("number", tool.number);
  whole("diameterOffset", tool.diameterOffset);
  whole("lengthOffset", tool.lengthOffset);
  whole("compensationOffset", tool.compensationOffset);
  whole("numberOfFlutes", tool.flutes);
  out.add("clockwise", tool.clockwise != 0 ? "true" : "false");
  real("diameter", tool.diameter);
  real("tipDiameter", tool.tipDiameter);
  real("cornerRadius", tool.cornerRadius);
  real("taperAngle",
       tool.taperAngle * (std::numbers::pi / 180)); // in this order, as the engine's trace has it
  real("fluteLength", tool.fluteLength);
  real("shoulderLength", tool.shoulderLength);
  real("shaftDiameter", tool.shaftDiameter);
  real("bodyLength", tool.bodyLength);
  real("spindleRPM", tool.spindleSpeed);
  real("rampingSpindleRPM", tool.rampSpindleSpeed);
  real("threadPitch", tool.threadPitch);
  real("maximumSpindleSpeed", tool.maximumSpindleSpeed);
  real("surfaceSpeed", tool.surfaceSpeed);
  real("noseRadius", tool.noseRadius);
  double height = 0, width = 0;
  for (const auto& [h, d] : tool.holder) {
    height += static_cast<double>(h);
    width = std::max(width, static_cast<double>(d));
  }
  real("holderLength", height);
  real("holderDiameter", width);
  real("holderTipDiameter", tool.holder.empty() ? 0 : static_cast<double>(tool.holder.front().second));
  jet(tool, out);
  for (const auto& [name, value] : members)
    out.add(name, value);
  return fault.empty() ? out.text() : "";
}

} // namespace dotek::posts
