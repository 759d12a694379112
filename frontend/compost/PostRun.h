// Private to Post*.cpp: the sink that prints, with numbers for the values.
#pragma once

#include "frontend/compost/FormWalk.h"
#include "frontend/compost/Post.h"

namespace dotek::frontend::compost {

struct PostRun::Impl : FormWalk {
  Impl(const Program& program, const PostSettings& settingsIn, Diagnostics& diagnosticsIn);

  void run(const Routine& routine, const Operation& given);
  std::size_t lineCount() const { return lines.size() + (line.empty() ? 0 : 1); }
  std::vector<PostedLine> finish();

private:
  void text(std::string_view bytes, SourceRange range) override;
  void sequenceNumber(const std::string& address, SourceRange range) override;
  void value(const PrintedValue& value, const std::function<const Picture*()>& picture) override;
  void literal(const Literal& literal) override;
  void endLine(SourceRange where) override;
  void branch(const If& branch) override;
  std::optional<double> host(const std::string& name, SourceRange where);
  void printValue(double value, const Picture& picture, std::string_view what, SourceRange where);

  const Operation* operation = nullptr;
  std::uint64_t sequence = 0;
  std::uint64_t sequenceStep = 0;
  bool printsRests = false;
  std::string line;
  bool numberOnly = false; // nothing but a block number is in `line`
  SourceRange lineRange;
  std::vector<PostedLine> lines;
};

} // namespace dotek::frontend::compost
